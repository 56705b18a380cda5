// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/step/solid_equations.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// The resultant on all bodies.
    template <int dim>
    dealii::Tensor<1, dim>
    sum(const SolidModel<dim> &model, const typename SolidModel<dim>::Vector &forces)
    {
      dealii::Tensor<1, dim> result;
      for (const auto &of_body : sums_by_body(model, forces))
        result += of_body;
      return result;
    }


    /// K(d) times `displacement_increment` [J].
    template <int dim>
    double
    internal_work(const SolidModel<dim>                  &model,
                  const typename SolidModel<dim>::Vector &displacement,
                  const typename SolidModel<dim>::Vector &displacement_increment)
    {
      return internal_forces(model, displacement) * displacement_increment;
    }
  } // namespace


  template <int dim>
  SolidBalance<dim>
  SolidEquations<dim>::balance(const Vector &velocity, const Vector &reactions) const
  {
    const Vector end                    = displacement(velocity);
    const Vector displacement_increment = increment(velocity);

    SolidBalance<dim> result;
    Vector            damping = model.vector();
    add_damping(damping, velocity, coefficients.damping);
    add_damping(damping, old_state.velocity, coefficients.damping_old_velocity);
    for (const auto &stage : coefficients.stages)
      for (const auto &[effect, force] :
           effect_loads(model, environment, time + stage.position * dt))
        result.loads_by_effect[effect] +=
          stage.weight / coefficients.sum_of_weights() * (force * displacement_increment);
    Vector loads = dead;
    if (nodal_forces.size() > 0)
      {
        result.nodal = nodal_forces * displacement_increment;
        loads.add(-1., nodal_forces);
      }
    if (has_pressure)
      for (const auto &stage : coefficients.stages)
        loads.add(stage.weight,
                  pressure_loads(
                    model, stage_displacement(end, stage.position), time + stage.position * dt));
    // Those against given forces act un-averaged, as these do.
    const double weight   = coefficients.sum_of_weights();
    const Vector averaged = weighted(reactions);
    result.supports       = reactions * displacement_increment;
    result.supports_force = sum(model, reactions);
    balance_inertia(result, velocity, displacement_increment);
    balance_elasticity(result, end, displacement_increment);
    balance_contact(result, end, displacement_increment);

    result.damping       = damping * displacement_increment / weight;
    result.loads         = loads * displacement_increment / weight;
    result.damping_force = -sum(model, damping) / weight;
    result.loads_force   = sum(model, loads) / weight;
    Vector rest          = reactions;
    rest.add(-1., averaged);
    rest.add(1 / weight - 1, loads);
    rest.add(1 - 1 / weight, damping);
    result.inertia_loss += rest * displacement_increment;
    result.inertia_gap += dt * sum(model, rest);
    return result;
  }


  template <int dim>
  void
  SolidEquations<dim>::balance_inertia(SolidBalance<dim> &result,
                                       const Vector      &velocity,
                                       const Vector      &displacement_increment) const
  {
    if (coefficients.mass == 0)
      return;
    const Vector force  = inertia(velocity);
    Vector       change = velocity, mean = velocity, gain = model.vector();
    change.add(-1., old_state.velocity);
    mean.sadd(0.5, 0.5, old_state.velocity);
    mass.vmult(gain, change);
    result.kinetic = gain * mean;
    // force.displacement_increment - gain.mean without the difference of nearly equal numbers.
    Vector further = displacement_increment, more = force;
    further.add(-dt, mean);
    more.add(-1 / dt, gain);
    result.inertia_loss = force * further + dt * (more * mean);
    result.momentum     = sum(model, gain);
    result.inertia_gap  = dt * sum(model, more);
  }


  template <int dim>
  void
  SolidEquations<dim>::balance_elasticity(SolidBalance<dim> &result,
                                          const Vector      &end,
                                          const Vector      &displacement_increment) const
  {
    result.elastic = elastic_energy(model, end) - elastic_energy(model, old_state.displacement);
    for (const auto &stage : coefficients.stages)
      result.elastic_loss +=
        stage.weight *
        internal_work(model, stage_displacement(end, stage.position), displacement_increment);
    try
      {
        // Finer only where the increment is so large that the rule does not resolve the integral.
        const double resolved  = std::max(1e-12 * elastic_energy(model, end),
                                         own_rounding * displacement_increment.l2_norm());
        double       along_way = 0;
        for (unsigned int parts = 1; parts <= 16; parts *= 4)
          {
            const dealii::QIterated<1> rule(dealii::QGauss<1>(6), parts);
            along_way = 0;
            for (unsigned int q = 0; q < rule.size(); ++q)
              along_way += rule.weight(q) * internal_work(model,
                                                          stage_displacement(end, rule.point(q)[0]),
                                                          displacement_increment);
            if (std::abs(along_way - result.elastic) <= resolved)
              break;
          }
        result.elastic_loss -= along_way;
      }
    catch (const SolveError &)
      {
        // The straight path leads through an inverted state: there is no such integral.
        result.elastic_loss -= result.elastic;
      }
  }


#define UNDINE_INSTANTIATE(dim)                                                                  \
  template SolidBalance<dim> SolidEquations<dim>::balance(const Vector &, const Vector &) const; \
  template void              SolidEquations<dim>::balance_inertia(                               \
    SolidBalance<dim> &, const Vector &, const Vector &) const;                     \
  template void SolidEquations<dim>::balance_elasticity(                                         \
    SolidBalance<dim> &, const Vector &, const Vector &) const;

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
