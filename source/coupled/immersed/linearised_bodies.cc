// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/rounding.h>
#include <undine/coupled/immersed/begin_of.h>
#include <undine/coupled/immersed/linearised_bodies.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/step/initial_guesses.h>

namespace undine
{
  template <int dim>
  LinearisedBodies<dim>::LinearisedBodies(const Models<dim>           &models,
                                          const Matrix                &mass,
                                          const SolidEnvironment<dim> &environment,
                                          const FluidGeometry<dim>    &geometry,
                                          const State<dim>            &state,
                                          const Stage                 &stage,
                                          const double                 viscosity,
                                          TimingTree                  &timing,
                                          Solvers                     &solvers)
    : models(models)
    , preconditioner(solvers.preconditioner)
    , turning_stress(models.surface->surface(),
                     models.surface->n_body_nodes(),
                     geometry.surface_positions(),
                     geometry.uniform_pressure_forces(1),
                     viscosity)
  {
    SolidEquations<dim> equations(*models.solid,
                                  mass,
                                  state.solid,
                                  environment,
                                  state.clock.time + stage.start(),
                                  stage.length,
                                  timing,
                                  state.solid.fluid_loads,
                                  state.contact,
                                  begin_of(state, stage));
    solvers.motion.begin_stage(equations.symmetry());
    const auto velocity = equations.kept_apart(resting_guess(equations, solvers.motion, timing));
    all_but_friction    = equations.residual(velocity);
    all_but_friction *= -1.;
    tangent.copy_from(equations.jacobian(velocity));
    displacement = equations.displacement(velocity);
    of_surfaces  = models.surface->with_bodies(velocity, geometry.surface_velocities());
    all_but_friction.add(1., by_turning_stress(of_surfaces));
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vector
  LinearisedBodies<dim>::vector() const
  {
    return models.solid->vector();
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vectors
  LinearisedBodies<dim>::on_surfaces(const Vector &change) const
  {
    return models.surface->with_bodies(change, Vectors(of_surfaces.size()));
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vector
  LinearisedBodies<dim>::on_bodies(const Vectors &forces) const
  {
    auto result = models.solid->vector();
    models.surface->add_to_bodies(result, forces);
    clear_fixed(result, *models.solid);
    return result;
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vector
  LinearisedBodies<dim>::force(const Vector &change) const
  {
    auto result = models.solid->vector();
    tangent.vmult(result, change);
    if (!turning_stress.empty())
      result.add(-1., by_turning_stress(on_surfaces(change)));
    return result;
  }


  template <int dim>
  double
  LinearisedBodies<dim>::rounding(const Vector &change) const
  {
    return rounding_of_product(tangent, change);
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vector
  LinearisedBodies<dim>::by_turning_stress(const Vectors &velocities) const
  {
    Vectors forces(velocities.size());
    turning_stress.add_forces(forces, velocities);
    return on_bodies(forces);
  }


  /// The damping of nodes, as a matrix over the degrees of freedom that they hang on.
  template <int dim>
  void
  LinearisedBodies<dim>::prepare(const Vectors &damping)
  {
    Matrix damped;
    damped.copy_from(tangent);
    models.surface->bodies()->add_diagonal(
      damped,
      {damping.begin(), damping.begin() + models.surface->n_body_nodes()},
      models.solid->all_fixed());
    preconditioner.initialize(damped, displacement);
  }


  template <int dim>
  typename LinearisedBodies<dim>::Vector
  LinearisedBodies<dim>::approximate_change(const Vector &force) const
  {
    auto result = models.solid->vector();
    preconditioner.vmult(result, force);
    return result;
  }


  template class LinearisedBodies<2>;
  template class LinearisedBodies<3>;
} // namespace undine
