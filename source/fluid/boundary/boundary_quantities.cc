// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/grid/pressure_numbers.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace undine
{
  namespace
  {
    /// Call `action(side, index)` for the points of a lattice next to a side that this rank owns;
    /// those of faces normal to the side lie on it.
    template <int dim, class Action>
    void
    for_each_next_to_side(const MacGrid<dim> &grid, const Lattice<dim> &lattice, Action &&action)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (unsigned int end = 0; end < 2 && !grid.periodic(axis); ++end)
          {
            const Side side{axis, end};
            const int  index  = end == 0 ? 0 : lattice.row(axis).size() - 1;
            auto       layer  = lattice.owned();
            layer.lower[axis] = std::max(layer.lower[axis], index);
            layer.upper[axis] = std::min(layer.upper[axis], index + 1);
            for_each(layer, [&](const GridIndex<dim> &point) { action(side, point); });
          }
    }


    /// Of the face of a cell that lies on a side: what bodies do not cover [1].
    template <int dim>
    double
    open_share(const MacGrid<dim>                              &grid,
               const std::shared_ptr<const FluidTopology<dim>> &open,
               const Side                                       side,
               const GridIndex<dim>                            &cell)
    {
      const auto face = moved<dim>(cell, side.axis, side.end);
      if (!open || open->faces[side.axis].kind(face) == SubLattice<dim>::Kind::whole)
        return 1;
      const auto &pieces = open->faces[side.axis];
      double      area   = 0;
      for (int k = pieces.first(face); k < pieces.last(face); ++k)
        area += pieces.all()[k].measure;
      return area / grid.face_area(side.axis, face);
    }


    /// A velocity along a wall and its distance from it.
    struct BesideWall
    {
      double velocity; ///< [m/s]
      double distance; ///< [m]
    };

    /// That of a face next to a side, or of its piece nearest to the wall; none if bodies cover it.
    template <int dim>
    std::optional<BesideWall>
    nearest_to_wall(const Field<dim>         &component,
                    const GridIndex<dim>     &point,
                    const Side                side,
                    const dealii::Point<dim> &wall)
    {
      constexpr double least = 1e-2; // of that of a whole face, as in ViscousTerms
      const double whole = std::abs(component.lattice().point(point)[side.axis] - wall[side.axis]);
      const auto  *divided = component.divided();
      if (!divided || divided->kind(point) == SubLattice<dim>::Kind::whole)
        return BesideWall{component(point), whole};
      std::optional<BesideWall> result;
      for (int k = divided->first(point); k < divided->last(point); ++k)
        {
          const double distance =
            std::max(std::abs(divided->all()[k].place[side.axis] - wall[side.axis]), least * whole);
          if (!result || distance < result->distance)
            result = BesideWall{component.parts()[k], distance};
        }
      return result;
    }


    /// Friction along an axis on a part of a side.
    template <int dim>
    struct WallFriction
    {
      const Boundary<dim> &boundary;
      unsigned int         axis;
      double               force;    ///< on the side [N]
      double               velocity; ///< of the side [m/s]
    };

    /// action(WallFriction) for what this rank has of sides whose velocity along them is
    /// prescribed.
    template <int dim, class Action>
    void
    for_each_friction(const BoundaryMap<dim> &boundaries,
                      const FluidState<dim>  &state,
                      const double            dynamic_viscosity,
                      const double            time,
                      const Action           &action)
    {
      const auto &grid = boundaries.grid();
      for (unsigned int axis = 0; axis < dim; ++axis)
        for_each_next_to_side(
          grid, *grid.faces(axis), [&](const Side side, const GridIndex<dim> &point) {
            if (side.axis == axis)
              return;
            const auto &lattice = *grid.faces(axis);
            double      area    = 1;
            for (unsigned int d = 0; d < dim; ++d)
              if (d != side.axis)
                area *= d == axis ? grid.dual_width(d, point[d]) : grid.cell_width(d, point[d]);
            const auto on_wall = moved<dim>(point, side.axis, side.sign());
            const auto wall_at = lattice.point(on_wall);
            const auto nearest = nearest_to_wall(state.velocity[axis], point, side, wall_at);
            const auto add     = [&](const Boundary<dim>  &boundary,
                                 const double          fraction,
                                 const GridIndex<dim> &cell) {
              if (!boundary.prescribes_tangential_velocity() || !nearest)
                return;
              const double wall = boundary.velocity_along(axis, side.axis, wall_at, time);
              const double open = open_share(grid, state.velocity[0].topology(), side, cell);
              action(WallFriction<dim>{boundary,
                                       axis,
                                       dynamic_viscosity * (nearest->velocity - wall) /
                                         nearest->distance * area * fraction * open,
                                       wall});
            };
            for_each_boundary_around(boundaries, lattice, side, on_wall, add);
          });
    }


    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    sum_over_ranks(std::vector<dealii::Tensor<1, dim>> forces, const MPI_Comm communicator)
    {
      for (auto &force : forces)
        force = dealii::Utilities::MPI::sum(force, communicator);
      return forces;
    }


    /// action(side, face, flux outwards [m^dim/s]) for the faces of this rank on sides.
    template <int dim, class Action>
    void
    for_each_flux(const MacGrid<dim> &grid, const Velocity<dim> &velocity, const Action &action)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        for_each_next_to_side(
          grid, *grid.faces(axis), [&](const Side side, const GridIndex<dim> &face) {
            if (side.axis == axis)
              action(side, face, side.sign() * grid.face_area(axis, face) * velocity[axis](face));
          });
    }
  } // namespace


  template <int dim>
  std::vector<double>
  boundary_fluxes(const BoundaryMap<dim> &boundaries, const Velocity<dim> &velocity)
  {
    const auto         &grid = boundaries.grid();
    std::vector<double> fluxes(boundaries.all().size(), 0.);
    for_each_flux(
      grid, velocity, [&](const Side side, const GridIndex<dim> &face, const double flux) {
        fluxes[boundaries.number(side, face)] += flux;
      });
    for (double &flux : fluxes)
      flux = dealii::Utilities::MPI::sum(flux, grid.communicator());
    return fluxes;
  }


  template <int dim>
  std::string
  net_flux_complaint(const BoundaryMap<dim> &boundaries, const Velocity<dim> &velocity)
  {
    if (boundaries.has_opening())
      return "";
    const auto  fluxes = boundary_fluxes(boundaries, velocity);
    double      net    = 0;
    double      size   = 0; // of what rounds the sum: the same boundary may let in and out
    std::string list;
    for_each_flux(
      boundaries.grid(), velocity, [&](const Side, const GridIndex<dim> &, const double flux) {
        size += std::abs(flux);
      });
    size = dealii::Utilities::MPI::sum(size, boundaries.grid().communicator());
    for (unsigned int b = 0; b < fluxes.size(); ++b)
      {
        net += fluxes[b];
        if (fluxes[b] != 0)
          list += fmt::format(
            "{}'{}' {:.6g}", list.empty() ? "" : ", ", boundaries.all()[b].name, fluxes[b]);
      }
    if (std::abs(net) <= 1e-10 * size)
      return "";
    return fmt::format("the fluid has no outlet, but in sum {:.6g} m^{}/s flow out of it (by "
                       "boundary, outwards: {})",
                       net,
                       dim,
                       list);
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  pressure_forces(const BoundaryMap<dim>       &boundaries,
                  const FluidState<dim>        &state,
                  const dealii::Tensor<1, dim> &weight)
  {
    const auto                         &grid = boundaries.grid();
    std::vector<dealii::Tensor<1, dim>> forces(boundaries.all().size());
    auto                                pressure = state.pressure;
    const auto                         *open     = pressure.topology().get();
    pressure.exchange(1);
    for_each_next_to_side(grid, *grid.cells(), [&](const Side side, const GridIndex<dim> &cell) {
      const unsigned int axis  = side.axis;
      const auto         next  = moved<dim>(cell, axis, -side.sign());
      const auto         whole = [&](const GridIndex<dim> &index) {
        return !open || open->cells.kind(index) == SubLattice<dim>::Kind::whole;
      };
      auto      &force = forces[boundaries.number(side, cell)][axis];
      const auto face  = moved<dim>(cell, axis, side.end);
      if (!whole(cell))
        {
          for (int k = open->faces[axis].first(face); k < open->faces[axis].last(face); ++k)
            {
              const auto &piece = open->faces[axis].all()[k];
              force += side.sign() * piece.measure *
                       (value_at(pressure, end_of_piece(*open, axis, k, 1 - side.end)) +
                        weight * piece.place);
            }
          return;
        }
      double on_wall = pressure(cell);
      if (next[axis] >= 0 && next[axis] < grid.cells_along()[axis] && whole(next))
        {
          const int plane = std::max(cell[axis], next[axis]);
          on_wall += (pressure(cell) - pressure(next)) * grid.cell_width(axis, cell[axis]) / 2 /
                     grid.dual_width(axis, plane);
        }
      force += side.sign() * (on_wall + weight * grid.faces(axis)->point(face)) *
               grid.face_area(axis, cell);
    });
    return sum_over_ranks(forces, grid.communicator());
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  viscous_forces(const BoundaryMap<dim> &boundaries,
                 const FluidState<dim>  &state,
                 const double            dynamic_viscosity,
                 const double            time)
  {
    std::vector<dealii::Tensor<1, dim>> forces(boundaries.all().size());
    for_each_friction(
      boundaries, state, dynamic_viscosity, time, [&](const WallFriction<dim> &friction) {
        forces[&friction.boundary - boundaries.all().data()][friction.axis] += friction.force;
      });
    return sum_over_ranks(forces, boundaries.grid().communicator());
  }


  template <int dim>
  double
  viscous_power(const BoundaryMap<dim> &boundaries,
                const FluidState<dim>  &state,
                const double            dynamic_viscosity,
                const double            time)
  {
    double power = 0;
    for_each_friction(
      boundaries, state, dynamic_viscosity, time, [&](const WallFriction<dim> &friction) {
        power -= friction.force * friction.velocity;
      });
    return dealii::Utilities::MPI::sum(power, boundaries.grid().communicator());
  }


  template <int dim>
  Columns
  force_columns(const std::string                         &what,
                const BoundaryMap<dim>                    &boundaries,
                const std::vector<dealii::Tensor<1, dim>> &forces)
  {
    Columns columns;
    for (unsigned int b = 0; b < forces.size(); ++b)
      {
        const auto &boundary = boundaries.all()[b];
        if (boundary.prescribes_normal_velocity() && !boundary.lets_fluid_pass())
          for (unsigned int d = 0; d < dim; ++d)
            columns.push_back({what + " on " + boundary.name + ", " + "xyz"[d], "N", forces[b][d]});
      }
    return columns;
  }


#define INSTANTIATE(dim)                                                                            \
  template std::vector<double> boundary_fluxes(const BoundaryMap<dim> &, const Velocity<dim> &);    \
  template std::string         net_flux_complaint(const BoundaryMap<dim> &, const Velocity<dim> &); \
  template std::vector<dealii::Tensor<1, dim>> pressure_forces(                                     \
    const BoundaryMap<dim> &, const FluidState<dim> &, const dealii::Tensor<1, dim> &);             \
  template std::vector<dealii::Tensor<1, dim>> viscous_forces(                                      \
    const BoundaryMap<dim> &, const FluidState<dim> &, const double, const double);                 \
  template double viscous_power(                                                                    \
    const BoundaryMap<dim> &, const FluidState<dim> &, const double, const double);                 \
  template Columns force_columns(                                                                   \
    const std::string &, const BoundaryMap<dim> &, const std::vector<dealii::Tensor<1, dim>> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
