// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_diffusion_problem_h
#define undine_fluid_viscosity_diffusion_problem_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/model/fluid_model.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace undine
{
  /// What ImplicitDiffusion solves: ds/dt = nu Laplace(s) for a field on a lattice. Model and
  /// condition must outlive it.
  template <int dim>
  struct DiffusionProblem
  {
    const FluidModel<dim>              &model;
    std::shared_ptr<const Lattice<dim>> lattice;
    const BoundaryCondition<dim>       &condition;
    double                              diffusivity; ///< nu [m^2/s]
  };


  /// Extent of the volume around a lattice point along `direction` [m].
  template <int dim>
  double
  extent(const MacGrid<dim>   &grid,
         const Lattice<dim>   &lattice,
         const unsigned int    direction,
         const GridIndex<dim> &index)
  {
    return direction == lattice.normal_axis() ? grid.dual_width(direction, index[direction])
                                              : grid.cell_width(direction, index[direction]);
  }


  template <int dim>
  double
  volume(const MacGrid<dim> &grid, const Lattice<dim> &lattice, const GridIndex<dim> &index)
  {
    double result = 1;
    for (unsigned int d = 0; d < dim; ++d)
      result *= extent(grid, lattice, d, index);
    return result;
  }


  /// Area over distance between a point and the next one along `direction`, which may be a
  /// boundary point.
  template <int dim>
  double
  coupling(const MacGrid<dim>   &grid,
           const Lattice<dim>   &lattice,
           const GridIndex<dim> &index,
           const unsigned int    direction,
           const int             step)
  {
    const auto  &row      = lattice.row(direction);
    const double distance = row.position(index[direction] + step) - row.position(index[direction]);
    return volume(grid, lattice, index) / extent(grid, lattice, direction, index) /
           std::abs(distance);
  }


  /// True for faces on walls and inflows, whose value is given.
  template <int dim>
  bool
  is_prescribed(const FluidModel<dim> &model,
                const Lattice<dim>    &lattice,
                const GridIndex<dim>  &index)
  {
    const unsigned int axis = lattice.normal_axis();
    if (axis == Lattice<dim>::no_axis || !model.grid().at_boundary(axis, index))
      return false;
    const Side side{axis, index[axis] == 0 ? 0u : 1u};
    return model.boundaries().at(side, index).prescribes_normal_velocity();
  }


  /// What lies on one side of a lattice point.
  enum class Beyond
  {
    neighbour, ///< another point
    boundary,  ///< a boundary point, half a cell away
    nothing    ///< the boundary itself runs through the point
  };


  template <int dim>
  Beyond
  beyond(const Lattice<dim>   &lattice,
         const GridIndex<dim> &index,
         const unsigned int    direction,
         const int             step)
  {
    const auto &row  = lattice.row(direction);
    const int   next = index[direction] + step;
    if (row.periodic() || (next >= 0 && next < row.size()))
      return Beyond::neighbour;
    return row.has_boundary_points() ? Beyond::boundary : Beyond::nothing;
  }


  /// Call `action(direction, step)` for the 2 dim steps to neighbours.
  template <int dim, class Action>
  void
  for_each_step(Action &&action)
  {
    for (unsigned int direction = 0; direction < dim; ++direction)
      for (const int step : {-1, 1})
        action(direction, step);
  }


  /// The largest 1 / dx^2 of the volumes around points [1/m^2]. Collective.
  template <int dim>
  double
  largest_diffusion_rate(const MacGrid<dim> &grid, const Lattice<dim> &lattice)
  {
    double least = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < dim; ++d)
      {
        GridIndex<dim> index{};
        for (int i = lattice.owned().lower[d]; i < lattice.owned().upper[d]; ++i)
          {
            index[d] = i;
            least    = std::min(least, extent(grid, lattice, d, index));
          }
      }
    least = dealii::Utilities::MPI::min(least, grid.communicator());
    return 1 / (least * least);
  }
} // namespace undine

#endif
