// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/rounding.h>
#include <undine/coupled/immersed/begin_of.h>
#include <undine/coupled/immersed/linearised_bodies.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/step/initial_guesses.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

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


  /// Call `action(i, j, value)` for the entries in owned rows, some of them several times, of the
  /// matrix over degrees of freedom that the damping of nodes is.
  template <int dim>
  template <class Action>
  void
  LinearisedBodies<dim>::for_each_entry(const std::array<NodeDampings, dim> &damping,
                                        const Action                        &action) const
  {
    const auto        &bodies  = *models.surface->bodies();
    const auto        &fixed   = models.solid->all_fixed();
    const unsigned int n_nodes = models.surface->n_body_nodes();
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const auto &entry : damping[axis])
        if (entry.row < n_nodes && entry.column < n_nodes)
          for (const auto &to : bodies.shares(entry.row))
            if (const auto i = to.dofs[axis]; tangent.in_local_range(i) && !fixed.is_element(i))
              for (const auto &of : bodies.shares(entry.column))
                if (const auto j = of.dofs[axis]; !fixed.is_element(j))
                  action(i, j, to.weight * of.weight * entry.value);
  }


  /// Nodes that a cell of the fluid couples need not be those of one element: the pattern has more
  /// entries than that of the bodies alone, unless there is only a diagonal.
  template <int dim>
  void
  LinearisedBodies<dim>::prepare(const std::array<NodeDampings, dim> &damping)
  {
    bool is_diagonal = true;
    for (const auto &entries : damping)
      for (const auto &entry : entries)
        is_diagonal = is_diagonal && entry.row == entry.column;
    Matrix damped;
    if (is_diagonal)
      damped.copy_from(tangent);
    else
      {
        const auto                    &owned = models.solid->locally_owned();
        dealii::DynamicSparsityPattern pattern(tangent.m(), tangent.n(), owned);
        for_each_entry(damping, [&](const auto i, const auto j, double) { pattern.add(i, j); });
        for (const auto row : owned)
          for (auto entry = tangent.begin(row); entry != tangent.end(row); ++entry)
            pattern.add(row, entry->column());
        damped.reinit(owned, owned, pattern, models.communicator());
        for (const auto row : owned)
          for (auto entry = tangent.begin(row); entry != tangent.end(row); ++entry)
            damped.add(row, entry->column(), entry->value());
      }
    for_each_entry(
      damping, [&](const auto i, const auto j, const double value) { damped.add(i, j, value); });
    damped.compress(dealii::VectorOperation::add);
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
