// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/stability/splitting_step.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/mass_matrix.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sparse.h>

#include <numeric>

namespace undine
{
  namespace
  {
    /// sum of the levels' weights times positions.
    double
    weighted_position(const StageCoefficients &stage)
    {
      return std::accumulate(
        stage.levels.begin(), stage.levels.end(), 0., [](const double sum, const auto &level) {
          return sum + level.weight * level.position;
        });
    }


    /// Displacement over velocity where a step leads from -u and -d to u and d [s].
    double
    alternating_displacement(const StageCoefficients &stage)
    {
      return (stage.displacement - stage.displacement_velocity) / 2;
    }
  } // namespace


  template <int dim>
  SplittingStep<dim>::SplittingStep(const Models<dim> &models,
                                    const State<dim>  &state,
                                    const double       dt)
    : model(*models.solid)
    , dt(dt)
    , stage(model.numerics().integrator->coefficients(dt))
    , fluid(models, state)
  {
    const auto environment = models.requests_of_effects();
    mass_damping           = stage.damping == 0 ? 0. : environment.mass_damping;
    M.copy_from(mass_matrix(model));
    K.copy_from(internal_stiffness(model, state.solid.displacement));
    V.copy_from(viscous_stiffness(model, state.solid.displacement, model.vector(), 0, 1));
    V *= environment.stiffness_damping * stage.sum_of_weights();

    const double e = stage.displacement;
    tangent.factorise(
      sum(stage.mass + stage.damping * mass_damping, e * weighted_position(stage), e / dt));

    const double inertia   = stage.mass - stage.mass_old_velocity;
    const double drag      = mass_damping * (stage.damping - stage.damping_old_velocity);
    const double stiffness = 2 * weighted_position(stage) - stage.sum_of_weights();
    const double d         = alternating_displacement(stage);
    inertia_if_alternating.copy_from(sum(dt / 2 * (inertia + drag), dt / 2 * stiffness * d, d));
  }


  /// Of M, K and V, for unknowns that are zero at fixed degrees of freedom.
  template <int dim>
  typename SplittingStep<dim>::Matrix
  SplittingStep<dim>::sum(const double mass_factor,
                          const double stiffness_factor,
                          const double viscosity_factor) const
  {
    Matrix result = model.matrix();
    result.add(mass_factor, M);
    result.add(stiffness_factor, K);
    result.add(viscosity_factor, V);
    fix_rows_and_columns(result, model.all_fixed());
    return result;
  }


  /// The terms of the balance without the velocity at the end of the step [N].
  template <int dim>
  typename SplittingStep<dim>::Vector
  SplittingStep<dim>::forces_at_begin(const Motion &before) const
  {
    Vector way = before.velocity; // d^{n+1} - d^n without e u
    way *= stage.displacement_velocity;
    Vector inertia = before.velocity;
    inertia *= stage.mass_old_velocity + mass_damping * stage.damping_old_velocity;
    Vector place = before.displacement;
    place.sadd(stage.sum_of_weights(), weighted_position(stage), way);

    Vector result = before.pressure_forces, product = model.vector();
    M.vmult(product, inertia);
    result -= product;
    K.vmult(product, place);
    result -= product;
    V.vmult(product, way);
    result.add(-1 / dt, product);
    clear_fixed(result, model);
    return result;
  }


  template <int dim>
  typename SplittingStep<dim>::Motion
  SplittingStep<dim>::after(const Motion &before, const DrivenBy driven_by)
  {
    Motion result{
      before.displacement, tangent.solve(forces_at_begin(before)), before.surface, model.vector()};
    result.displacement.add(
      stage.displacement, result.velocity, stage.displacement_velocity, before.velocity);
    if (driven_by == DrivenBy::velocity)
      result.surface = result.velocity;
    else
      {
        result.surface = result.displacement;
        result.surface -= before.displacement;
        result.surface /= dt;
      }
    Vector change = result.surface;
    change -= before.surface;
    fluid.vmult(result.pressure_forces, change);
    result.pressure_forces *= -1 / dt;
    return result;
  }


  template <int dim>
  typename SplittingStep<dim>::Motion
  SplittingStep<dim>::alternating(const Vector &velocity) const
  {
    Motion result{velocity, velocity, velocity, model.vector()};
    result.displacement *= alternating_displacement(stage);
    fluid.vmult(result.pressure_forces, velocity);
    result.pressure_forces *= -2 / dt;
    return result;
  }


  template class SplittingStep<2>;
  template class SplittingStep<3>;
} // namespace undine
