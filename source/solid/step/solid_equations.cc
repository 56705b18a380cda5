// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/solvers/mass_solve.h>
#include <undine/solid/step/balance_terms.h>
#include <undine/solid/step/solid_equations.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// Size by which a body's residual is measured, at least, in proportion to that of all forces:
    /// what linear solvers can resolve [1].
    constexpr double least_size = 1e-6;


    /// Of a vector of which the norms of parts are known.
    double
    norm_of(const std::vector<double> &parts)
    {
      if (parts.size() == 1)
        return parts[0];
      double sum = 0;
      for (const double part : parts)
        sum += part * part;
      return std::sqrt(sum);
    }


    /// sum += factor * more.
    void
    add(std::vector<double> &sum, const double factor, const std::vector<double> &more)
    {
      for (std::size_t k = 0; k < sum.size(); ++k)
        sum[k] += factor * more[k];
    }
  } // namespace


  template <int dim>
  SolidEquations<dim>::SolidEquations(const SolidModel<dim>       &model,
                                      const Matrix                &mass,
                                      const SolidState            &old_state,
                                      const SolidEnvironment<dim> &environment,
                                      const double                 time,
                                      const double                 dt,
                                      TimingTree                  &timing,
                                      const Vector                &nodal_forces,
                                      const ContactStart          &contact_start,
                                      const StageBegin            &begin)
    : model(model)
    , mass(mass)
    , old_state(old_state)
    , environment(environment)
    , time(time)
    , dt(dt)
    , timing(timing)
    , nodal_forces(nodal_forces)
    , coefficients(model.numerics().integrator->coefficients(dt))
    , motion(model, old_state, coefficients, time, dt)
    , rayleigh_damping(mass, environment, motion, begin, timing)
    , contact(environment.contact.get(), contact_start, model, old_state, time, dt, timing)
    , has_pressure(has_pressure_loads(model))
    , norms_by_body(model)
    , largest_known(model.bodies().size(), 0.)
    , largest_term(largest_known)
    , dead(model.vector())
    , known(model.vector())
  {
    const auto timed = timing.section("assemble forces");
    rounding_by_body = norms_by_body(rounding_of_forces(
      model, old_state.displacement.linfty_norm() + dt * old_state.velocity.linfty_norm()));
    timing.memory.hold("deformable bodies", mass.memory_consumption());
    find_known_forces();
  }


  template <int dim>
  void
  SolidEquations<dim>::note_size(const Vector &term, const double factor)
  {
    const auto norms = norms_by_body(term);
    for (std::size_t body = 0; body < norms.size(); ++body)
      largest_term[body] = std::max(largest_term[body], std::abs(factor) * norms[body]);
  }


  template <int dim>
  double
  SolidEquations<dim>::scale() const
  {
    return norm_of(largest_term);
  }


  /// What residuals of the bodies are measured by [N].
  template <int dim>
  std::vector<double>
  SolidEquations<dim>::sizes() const
  {
    const double        tolerance = model.numerics().newton.relative_tolerance;
    const double        least     = least_size * scale();
    std::vector<double> result    = largest_term;
    for (std::size_t body = 0; body < result.size(); ++body)
      result[body] = std::max({result[body], least, rounding_by_body[body] / tolerance});
    return result;
  }


  template <int dim>
  double
  SolidEquations<dim>::weighted_norm(const std::vector<double> &norms) const
  {
    if (norms.size() == 1)
      return norms[0];
    const auto size = sizes();
    double     sum  = 0;
    for (std::size_t body = 0; body < norms.size(); ++body)
      if (norms[body] > 0)
        sum += std::pow(norms[body] / size[body], 2) / norms.size();
    return scale() * std::sqrt(sum);
  }


  template <int dim>
  double
  SolidEquations<dim>::norm(const Vector &residual) const
  {
    return weighted_norm(norms_by_body(residual));
  }


  /// M (m u + m_u u^n + m_a a^n).
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::inertia(const Vector &velocity) const
  {
    Vector change = model.vector(), result = model.vector();
    change.add(coefficients.mass, velocity, coefficients.mass_old_velocity, old_state.velocity);
    if (coefficients.mass_old_acceleration != 0)
      change.add(coefficients.mass_old_acceleration, old_state.acceleration);
    mass.vmult(result, change);
    return result;
  }


  /// forces += w_e [K(d_e) - P(d_e, t_e)], P being the follower pressures.
  template <int dim>
  void
  SolidEquations<dim>::add_level_forces(Vector                             &forces,
                                        const StageCoefficients::TimeLevel &level,
                                        const Vector                       &displacement)
  {
    const Vector internal = internal_forces(model, displacement);
    note_size(internal, level.weight);
    forces.add(level.weight, internal);
    if (has_pressure)
      {
        const Vector pressure = pressure_loads(model, displacement, time + level.position * dt);
        note_size(pressure, level.weight);
        forces.add(-level.weight, pressure);
      }
  }


  template <int dim>
  void
  SolidEquations<dim>::find_known_forces()
  {
    if (coefficients.mass != 0)
      add(rounding_by_body,
          std::numeric_limits<double>::epsilon(),
          norms_by_body(inertia(model.vector())));
    own_rounding = norm_of(rounding_by_body);
    for (const auto &level : coefficients.levels)
      {
        const Vector loads = dead_loads(model, environment, time + level.position * dt, &timing);
        note_size(loads, level.weight);
        dead.add(level.weight, loads);
        if (level.position == 0)
          add_level_forces(known, level, old_state.displacement);
      }
    known.add(-1., dead);
    largest_known = largest_term;
    if (nodal_forces.size() > 0)
      {
        const Vector forces = nodal_forces;
        nodal_forces        = 0;
        add_forces(forces);
      }
  }


  template <int dim>
  void
  SolidEquations<dim>::add_forces(const Vector &more)
  {
    if (nodal_forces.size() == 0)
      nodal_forces = model.vector();
    nodal_forces.add(1., more);
    note_size(more, 1);
    const auto norms = norms_by_body(more);
    for (std::size_t body = 0; body < norms.size(); ++body)
      largest_known[body] = std::max(largest_known[body], norms[body]);
    dead.add(1., more);
    known.add(-1., more);
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::full_residual(const Vector &velocity)
  {
    const auto timed  = timing.section("assemble forces");
    Vector     result = known;
    largest_term      = largest_known;
    if (coefficients.mass != 0)
      {
        const Vector change = inertia(velocity);
        note_size(change, 1);
        result.add(1., change);
      }
    if (rayleigh_damping.is_on())
      {
        Vector damping = model.vector();
        rayleigh_damping.add_forces(damping, velocity);
        note_size(damping, 1);
        result.add(1., damping);
      }
    const Vector end = displacement(velocity);
    for (const auto &level : coefficients.levels)
      if (level.position > 0)
        add_level_forces(result, level, motion.level_displacement(end, level.position));
    const Vector repulsion = contact.forces(end);
    if (repulsion.size() > 0)
      {
        note_size(repulsion, 1);
        result.add(-1., repulsion);
      }
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::residual(const Vector &velocity)
  {
    Vector result = full_residual(velocity);
    clear_fixed(result, model);
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Matrix
  SolidEquations<dim>::jacobian(const Vector &velocity, const Tangent kind) const
  {
    const Vector end    = displacement(velocity);
    Matrix       result = full_jacobian(velocity, end, end, kind);
    fix_rows_and_columns(result, model.all_fixed());
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::LinearSystem
  SolidEquations<dim>::motion_predictor() const
  {
    Vector jump = motion.prescribed_increment();
    jump *= -1 / coefficients.displacement;
    LinearSystem system{
      full_jacobian(
        guess_at_rest(), old_state.displacement, contact.last_displacement(), Tangent::exact),
      model.vector()};
    system.matrix.vmult(system.right_side, jump);
    clear_fixed(system.right_side, model);
    fix_rows_and_columns(system.matrix, model.all_fixed());
    return system;
  }


  template <int dim>
  typename SolidEquations<dim>::Matrix
  SolidEquations<dim>::full_jacobian(const Vector &velocity,
                                     const Vector &end,
                                     const Vector &in_contact,
                                     const Tangent kind) const
  {
    const auto timed  = timing.section("assemble tangent");
    Matrix     result = model.matrix();
    for (const auto &level : coefficients.levels)
      if (level.position > 0)
        {
          const double factor = level.weight * level.position * coefficients.displacement;
          const Vector d      = motion.level_displacement(end, level.position);
          result.add(factor, internal_stiffness(model, d));
          if (has_pressure)
            result.add(-factor, pressure_stiffness(model, d, time + level.position * dt));
        }
    if (coefficients.mass != 0)
      result.add(coefficients.mass, mass);
    rayleigh_damping.add_jacobian(result, velocity, end);
    contact.add_stiffness(result, coefficients.displacement, in_contact, kind);
    timing.memory.hold_briefly("deformable bodies", result.memory_consumption());
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::reactions(const Vector &velocity)
  {
    const Vector forces = full_residual(velocity), given = not_averaged(velocity);
    Vector       result = model.vector();
    // Supports act against them as they do.
    const double weight = coefficients.sum_of_weights();
    for (const auto &fixed : model.fixed())
      result(fixed.dof) = (forces(fixed.dof) + given(fixed.dof)) / weight - given(fixed.dof);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  /// Forces that act un-averaged, at both ends of the step's levels alike [N].
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::not_averaged(const Vector &velocity) const
  {
    Vector result = nodal_forces.size() > 0 ? nodal_forces : model.vector();
    if (coefficients.sum_of_weights() == 1) // then averages make no difference
      return result;
    const Vector repulsion = contact.forces(displacement(velocity));
    if (repulsion.size() > 0)
      result.add(1., repulsion);
    return result;
  }


  /// The term of `reactions` in the balance of the step at fixed degrees of freedom [N].
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::weighted(const Vector &reactions, const Vector &velocity) const
  {
    const Vector given  = not_averaged(velocity);
    Vector       result = model.vector();
    const double weight = coefficients.sum_of_weights();
    for (const auto &fixed : model.fixed())
      result(fixed.dof) = weight * (reactions(fixed.dof) + given(fixed.dof)) - given(fixed.dof);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  template <int dim>
  std::vector<double>
  SolidEquations<dim>::momentum_residuals(const Vector &velocity, const Vector &reactions) const
  {
    Vector defect = inertia(velocity);
    rayleigh_damping.add_drag(defect, velocity);
    defect.add(-1., dead);
    defect.add(-1., weighted(reactions, velocity));
    if (has_pressure)
      for (const auto &level : coefficients.levels)
        defect.add(-level.weight,
                   pressure_loads(model,
                                  motion.level_displacement(displacement(velocity), level.position),
                                  time + level.position * dt));
    const Vector repulsion = contact.forces(displacement(velocity));
    if (repulsion.size() > 0)
      defect.add(-1., repulsion);
    // Where nothing acts, rounding is no lack of balance.
    const auto          size = sizes();
    std::vector<double> result;
    for (const auto &force : sums_by_body(model, defect))
      result.push_back(force.norm() > 0 ? force.norm() / size[result.size()] : 0);
    return result;
  }


  template <int dim>
  SolidBalance<dim>
  SolidEquations<dim>::balance(const Vector &velocity,
                               const Vector &reactions,
                               const Vector &by_contact) const
  {
    const Vector end                    = displacement(velocity);
    const Vector displacement_increment = increment(velocity);

    SolidBalance<dim> result;
    Vector            damping = model.vector();
    rayleigh_damping.add_forces(damping, velocity);
    for (const auto &level : coefficients.levels)
      for (const auto &[effect, force] :
           effect_loads(model, environment, time + level.position * dt))
        result.loads_by_effect[effect] +=
          level.weight / coefficients.sum_of_weights() * (force * displacement_increment);
    Vector loads = dead;
    if (nodal_forces.size() > 0)
      {
        result.nodal = nodal_forces * displacement_increment;
        loads.add(-1., nodal_forces);
      }
    if (has_pressure)
      for (const auto &level : coefficients.levels)
        loads.add(level.weight,
                  pressure_loads(model,
                                 motion.level_displacement(end, level.position),
                                 time + level.position * dt));
    // Those against given forces act un-averaged, as these do.
    const double weight   = coefficients.sum_of_weights();
    const Vector averaged = weighted(reactions, velocity);
    result.supports       = reactions * displacement_increment;
    result.supports_force = resultant(model, reactions);
    if (coefficients.mass != 0)
      balance_inertia(result, motion, mass, inertia(velocity), velocity, displacement_increment);
    balance_elasticity(result, motion, end, displacement_increment, own_rounding);
    contact.balance(result, end, displacement_increment);

    // What it takes is its own; that its path may differ from the bodies' is the integrator's.
    result.damping         = dt * rayleigh_damping.power(velocity);
    result.damping_on_path = damping * displacement_increment / weight - result.damping;
    result.inertia_loss += result.damping_on_path;
    result.loads         = loads * displacement_increment / weight;
    result.damping_force = -resultant(model, damping) / weight;
    result.loads_force   = resultant(model, loads) / weight;
    Vector rest          = reactions;
    rest.add(-1., averaged);
    rest.add(1 / weight - 1, loads);
    rest.add(1 - 1 / weight, damping);
    result.inertia_loss += rest * displacement_increment;
    result.inertia_gap += dt * resultant(model, rest);
    if (by_contact.size() > 0)
      {
        Vector impulse = model.vector();
        mass.vmult(impulse, by_contact);
        result.contact_handed_on = velocity * impulse;
        result.contact_impulse   = resultant(model, impulse);
      }
    result.force_rounding  = own_rounding;
    result.energy_rounding = own_rounding * displacement_increment.l2_norm();
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::change_of_contact(const Vector &velocity) const
  {
    Vector result = contact.change(displacement(velocity));
    if (result.size() > 0)
      clear_fixed(result, model);
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::contact_beside_rates(const Vector &velocity) const
  {
    Vector result = contact.beside_rates(displacement(velocity));
    if (result.size() > 0)
      clear_fixed(result, model);
    return result;
  }


  template <int dim>
  ContactResponse
  SolidEquations<dim>::contact_response(const Vector &velocity) const
  {
    ContactResponse result;
    const auto      give = [&](Vector &given, const Vector &forces) {
      if (forces.size() == 0)
        return;
      given = solve_mass(model, mass, forces, model.vector());
      given *= dt;
    };
    give(result.by_change, change_of_contact(velocity));
    give(result.velocity, contact_beside_rates(velocity));
    if (leaves_out_change() && result.by_change.size() > 0)
      {
        if (result.velocity.size() == 0)
          result.velocity = model.vector();
        result.velocity.add(1., result.by_change);
      }
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::reactions_at_end(const Vector          &reactions,
                                        const Vector          &velocity,
                                        const ContactResponse &by_contact) const
  {
    Vector result = reactions;
    if (by_contact.by_change.size() == 0)
      return result;
    Vector share = model.vector(); // M dv/dt less forces: what supports add to these
    mass.vmult(share, by_contact.by_change);
    share *= 1 / dt;
    share.add(-1., contact.change(displacement(velocity)));
    if (by_contact.pressures.size() > 0)
      share.add(-1., by_contact.pressures);
    for (const auto &fixed : model.fixed())
      result(fixed.dof) = reactions(fixed.dof) - share(fixed.dof);
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  template <int dim>
  SolidState
  SolidEquations<dim>::end_state(const Vector &velocity, const ContactResponse &by_contact) const
  {
    SolidState state;
    state.displacement = displacement(velocity);
    state.velocity     = velocity;
    state.acceleration = model.vector();
    state.acceleration.add(
      coefficients.acceleration, velocity, coefficients.acceleration_velocity, old_state.velocity);
    if (by_contact.velocity.size() > 0)
      state.acceleration.add(-coefficients.acceleration, by_contact.velocity);
    if (contact.is_part_of_rates() && contact.is_lasting(state.displacement))
      state.contact_forces = contact.rate(state.displacement);
    const auto &integrator = *model.numerics().integrator;
    if (integrator.uses_acceleration())
      {
        state.acceleration.add(coefficients.acceleration_acceleration, old_state.acceleration);
        if (nodal_forces.size() > 0)
          {
            Vector others = nodal_forces;
            if (by_contact.pressures.size() > 0)
              others.add(-1., by_contact.pressures);
            state.impulse_acceleration = solve_mass(model, mass, others, model.vector());
            state.acceleration.add(-coefficients.acceleration * dt, state.impulse_acceleration);
          }
        if (by_contact.velocity.size() > 0)
          {
            if (state.impulse_acceleration.size() == 0)
              state.impulse_acceleration = model.vector();
            state.impulse_acceleration.add(1 / dt, by_contact.velocity);
          }
        prescribe_acceleration(
          state.acceleration, model, time + (1 + integrator.acceleration_shift()) * dt, dt);
      }
    return state;
  }


  template class SolidEquations<2>;
  template class SolidEquations<3>;
} // namespace undine
