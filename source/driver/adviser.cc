// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/adviser.h>
#include <undine/solid/assembly/internal_forces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Largest |dd/dX| at the quadrature points of all bodies [1]. Collective.
    template <int dim>
    double
    largest_gradient(const SolidModel<dim> &model, const Vector &displacement)
    {
      const auto                         &geometry = model.geometry();
      const Vector                        ghosted  = model.ghosted(displacement);
      std::vector<double>                 d(geometry.n_nodes() * dim);
      std::vector<dealii::Tensor<1, dim>> gradients;
      double                              largest = 0;
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          ghosted.extract_subvector_to(geometry.dofs(cell), d);
          for (unsigned int q = 0; q < geometry.n_points(); ++q)
            {
              geometry.gradients(gradients, cell, q);
              dealii::Tensor<2, dim> H;
              for (unsigned int dof = 0; dof < d.size(); ++dof)
                H[dof % dim] += d[dof] * gradients[dof / dim];
              largest = std::max(largest, H.norm());
            }
        }
      return dealii::Utilities::MPI::max(largest, model.communicator());
    }


    /// nullptr if there is none of that name.
    const Column *
    find(const Columns &columns, const std::string &name)
    {
      const auto found = std::find_if(
        columns.begin(), columns.end(), [&](const auto &column) { return column.name == name; });
      return found == columns.end() ? nullptr : &*found;
    }
  } // namespace


  /// The value of a column that every step has; zero, and noted, if one has not.
  template <int dim>
  double
  Adviser<dim>::column(const Columns &columns, const std::string &name)
  {
    const auto *found = find(columns, name);
    if (found == nullptr)
      missing.insert(name);
    return found == nullptr ? 0 : found->value;
  }


  template <int dim>
  Adviser<dim>::Adviser(const Models<dim> &models, const State<dim> &start)
    : models(models)
  {
    if (models.solid)
      first_displacement = start.solid.displacement;
    if (models.fluid)
      measure_length(start);
  }


  /// The longest extent of something in the fluid along an axis, as far as it is in the domain;
  /// without such a thing the domain's shortest.
  template <int dim>
  void
  Adviser<dim>::measure_length(const State<dim> &state)
  {
    const auto        &lower    = models.fluid->grid().lower();
    const auto        &upper    = models.fluid->grid().upper();
    const bool         is_any   = models.surface && !state.surface_positions.empty();
    const unsigned int n_bodies = is_any ? models.surface->surface().body_names().size() : 0;
    for (unsigned int body = 0; body < n_bodies; ++body)
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          double      first = upper[axis], last = lower[axis];
          const auto &surface = models.surface->surface();
          for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
            if (surface.body(facet) == body)
              for (const auto node : surface.facets()[facet])
                {
                  const double place =
                    std::clamp(state.surface_positions[node][axis], lower[axis], upper[axis]);
                  first = std::min(first, place);
                  last  = std::max(last, place);
                }
          largest.length = std::max(largest.length, last - first);
        }
    if (largest.length > 0)
      return;
    largest.length = upper[0] - lower[0];
    for (unsigned int axis = 1; axis < dim; ++axis)
      largest.length = std::min(largest.length, upper[axis] - lower[axis]);
  }


  template <int dim>
  void
  Adviser<dim>::observe(const State<dim> &state, const Report &report)
  {
    largest.time += report.dt;
    if (models.fluid)
      largest.speed = std::max(largest.speed, column(report.columns, "Fluid largest speed"));
    if (const auto *damped = find(report.columns, "energy by damping")) // of the budget
      largest.damped += std::abs(damped->value);
    if (models.solid)
      {
        for (const auto &body : models.solid->bodies())
          largest.body_speed =
            std::max(largest.body_speed, column(report.columns, "max speed " + body.name));
        largest.body_energy = std::max(largest.body_energy,
                                       column(report.columns, "solid kinetic energy") +
                                         column(report.columns, "solid elastic energy"));
        auto displacement   = state.solid.displacement;
        displacement -= first_displacement;
        largest.displacement = std::max(largest.displacement, displacement.linfty_norm());
        // Costs a loop over all cells: at steps 1, 2, 4, 8, ... and at the end.
        const auto step = state.clock.step;
        if ((step & (step - 1)) == 0 || state.clock.ended())
          largest.gradient =
            std::max(largest.gradient, largest_gradient(*models.solid, state.solid.displacement));
      }
    if (models.fluid)
      {
        typename Effect<dim>::Scales scales;
        for (const auto &effect : models.effects)
          effect->measure(scales, state.fluid);
        largest.viscosity = scales.viscosity;
        largest.lift =
          std::max(largest.lift, dealii::Utilities::MPI::max(scales.lift, models.communicator()));
      }
  }


  template <int dim>
  Advice
  Adviser<dim>::advice() const
  {
    if (models.particles)
      return {};
    auto result = make_advice(models, largest);
    result.missing.assign(missing.begin(), missing.end());
    return result;
  }


  template class Adviser<2>;
  template class Adviser<3>;
} // namespace undine
