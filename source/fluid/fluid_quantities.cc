// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/fluid_quantities.h>
#include <undine/fluid/pressure_gradient.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// A copy whose upper faces are known for every owned cell.
    template <int dim>
    Velocity<dim>
    with_ghosts(Velocity<dim> velocity)
    {
      exchange(velocity);
      return velocity;
    }


    /// Mean of the two faces of a cell normal to `axis` [m/s].
    template <int dim>
    double
    at_centre(const Velocity<dim> &velocity, const unsigned int axis, const GridIndex<dim> &cell)
    {
      return (velocity[axis](cell) + velocity[axis](moved<dim>(cell, axis, 1))) / 2;
    }


    void
    check_finite(const bool finite, const MPI_Comm communicator)
    {
      if (dealii::Utilities::MPI::min(finite ? 1 : 0, communicator) == 0)
        throw SolveError(
          "The fluid's velocity is not a finite number any more. Try a smaller step, "
          "and check expressions for forces and boundary values.");
    }
  } // namespace


  template <int dim>
  double
  kinetic_energy(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    double energy = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(velocity[axis].owned(), [&](const GridIndex<dim> &face) {
        const double speed = velocity[axis](face);
        energy += model.density() * model.grid().dual_volume(axis, face) * speed * speed / 2;
      });
    return dealii::Utilities::MPI::sum(energy, model.grid().communicator());
  }


  template <int dim>
  double
  fluid_volume(const FluidModel<dim> &model)
  {
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= model.grid().upper()[d] - model.grid().lower()[d];
    return volume;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  largest_components(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    dealii::Tensor<1, dim> result;
    bool                   finite = true;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        double largest = 0;
        for_each(velocity[axis].owned(), [&](const GridIndex<dim> &face) {
          finite  = finite && std::isfinite(velocity[axis](face));
          largest = std::max(largest, std::abs(velocity[axis](face)));
        });
        result[axis] = dealii::Utilities::MPI::max(largest, model.grid().communicator());
      }
    check_finite(finite, model.grid().communicator());
    return result;
  }


  template <int dim>
  double
  largest_speed(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto known   = with_ghosts(velocity);
    double     largest = 0;
    bool       finite  = true;
    for_each(model.grid().cells()->owned(), [&](const GridIndex<dim> &cell) {
      double square = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        square += std::pow(at_centre(known, axis, cell), 2);
      finite  = finite && std::isfinite(square);
      largest = std::max(largest, square);
    });
    check_finite(finite, model.grid().communicator());
    return std::sqrt(dealii::Utilities::MPI::max(largest, model.grid().communicator()));
  }


  template <int dim>
  double
  flux_area(const MacGrid<dim> &grid, const GridIndex<dim> &cell)
  {
    double width = grid.cell_width(0, cell[0]);
    for (unsigned int d = 1; d < dim; ++d)
      width = std::min(width, grid.cell_width(d, cell[d]));
    return grid.cell_volume(cell) / width;
  }


  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const std::vector<double> &fluxes)
  {
    double      largest = 0;
    std::size_t k       = 0;
    for_each(model.grid().cells()->owned(), [&](const GridIndex<dim> &cell) {
      largest = std::max(largest, std::abs(fluxes[k++]) / flux_area(model.grid(), cell));
    });
    return dealii::Utilities::MPI::max(largest, model.grid().communicator());
  }


  template <int dim>
  double
  largest_divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    return largest_divergence(model, divergence(model, with_ghosts(velocity)));
  }


  template <int dim>
  double
  integral(const FluidModel<dim> &model, const Field<dim> &scalar)
  {
    double sum = 0;
    for_each(scalar.owned(), [&](const GridIndex<dim> &cell) {
      sum += model.grid().cell_volume(cell) * scalar(cell);
    });
    return dealii::Utilities::MPI::sum(sum, model.grid().communicator());
  }


  template <int dim>
  Columns
  fluid_columns(const FluidModel<dim> &model, const FluidState<dim> &state)
  {
    const double scale      = largest_components(model, state.velocity).norm();
    const double divergence = largest_divergence(model, state.velocity);
    Columns      columns{{"Fluid kinetic energy", "J", kinetic_energy(model, state.velocity)},
                    {"Fluid largest speed", "m/s", largest_speed(model, state.velocity)},
                    {"Fluid divergence", "1", scale > 0 ? divergence / scale : 0.}};
    const auto   fluxes = boundary_fluxes(model, state.velocity);
    for (unsigned int b = 0; b < fluxes.size(); ++b)
      {
        const auto &boundary = model.boundaries().all()[b];
        if (boundary.is_open() || boundary.kind == BoundaryKind::inflow)
          columns.push_back(
            {"Flux through " + boundary.name, "m^" + std::to_string(dim) + "/s", fluxes[b]});
      }
    const auto forces = force_columns("Pressure force", model, pressure_forces(model, state));
    columns.insert(columns.end(), forces.begin(), forces.end());
    return columns;
  }


#define INSTANTIATE(dim)                                                                          \
  template double                 kinetic_energy(const FluidModel<dim> &, const Velocity<dim> &); \
  template double                 fluid_volume(const FluidModel<dim> &);                          \
  template dealii::Tensor<1, dim> largest_components(const FluidModel<dim> &,                     \
                                                     const Velocity<dim> &);                      \
  template double                 largest_speed(const FluidModel<dim> &, const Velocity<dim> &);  \
  template double                 flux_area(const MacGrid<dim> &, const GridIndex<dim> &);        \
  template double  largest_divergence(const FluidModel<dim> &, const std::vector<double> &);      \
  template double  largest_divergence(const FluidModel<dim> &, const Velocity<dim> &);            \
  template double  integral(const FluidModel<dim> &, const Field<dim> &);                         \
  template Columns fluid_columns(const FluidModel<dim> &, const FluidState<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
