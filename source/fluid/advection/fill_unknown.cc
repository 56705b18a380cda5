// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/fill_unknown.h>
#include <undine/fluid/grid/pressure_numbers.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace undine
{
  namespace
  {
    /// Sums over the known neighbours of cells and components to which nothing was brought.
    template <int dim>
    struct KnownNeighbours
    {
      explicit KnownNeighbours(const Field<dim> &scalar)
        : values(scalar.shared_lattice(), scalar.topology())
        , areas(values)
      {
      }

      /// The value `other` waits at an opening of this area.
      void
      join(const PressurePlace<dim> &to, const double other, const double area)
      {
        if ((to.component < 0 && !values.owned().contains(to.cell)) || std::isnan(other))
          return;
        (to.component < 0 ? values(to.cell) : values.parts()[to.component]) += area * other;
        (to.component < 0 ? areas(to.cell) : areas.parts()[to.component]) += area;
      }

      Field<dim> values, areas;
    };


    /// Through whole faces of a whole cell to whole cells.
    template <int dim>
    void
    join_whole_neighbours(KnownNeighbours<dim> &known,
                          const Field<dim>     &scalar,
                          const MacGrid<dim>   &grid,
                          const GridIndex<dim> &cell)
    {
      using Kind = typename SubLattice<dim>::Kind;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int end : {0, 1})
          {
            const auto face = moved<dim>(cell, axis, end);
            if (scalar.topology()->faces[axis].kind(face) == Kind::whole &&
                !grid.at_boundary(axis, face))
              known.join({cell, -1},
                         scalar(moved<dim>(cell, axis, 2 * end - 1)),
                         grid.face_area(axis, face));
          }
    }


    template <int dim>
    void
    join_through_pieces(KnownNeighbours<dim> &known, const Field<dim> &scalar)
    {
      const auto &open = *scalar.topology();
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
          {
            const auto &ends = open.pieces[axis][k].components;
            if (ends[0] == open.outside || ends[1] == open.outside)
              continue;
            for (const unsigned int end : {0, 1})
              known.join(end_of_piece(open, axis, k, end),
                         value_at(scalar, end_of_piece(open, axis, k, 1 - end)),
                         std::abs(open.faces[axis].all()[k].measure));
          }
    }


    /// What enters through inflows and openings of the domain.
    template <int dim>
    void
    join_boundaries(KnownNeighbours<dim>         &known,
                    const FluidModel<dim>        &model,
                    const BoundaryCondition<dim> &condition,
                    const double                  time)
    {
      using Kind       = typename SubLattice<dim>::Kind;
      const auto &grid = model.grid();
      const auto &open = *known.values.topology();
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const unsigned int end : {0, 1})
          {
            if (grid.periodic(axis))
              continue;
            const Side side{axis, end};
            auto       layer  = known.values.owned();
            const int  index  = end == 0 ? 0 : grid.cells_along()[axis] - 1;
            layer.lower[axis] = std::max(layer.lower[axis], index);
            layer.upper[axis] = std::min(layer.upper[axis], index + 1);
            for_each(layer, [&](const GridIndex<dim> &cell) {
              const auto &boundary = model.boundaries().at(side, cell);
              if (!boundary.lets_fluid_pass())
                return;
              const auto value = [&](const dealii::Point<dim> &place) {
                return condition.is_dirichlet(boundary)
                         ? condition.dirichlet_value(boundary, axis, place, time)
                         : condition.entering_value(place, time);
              };
              const auto  face    = moved<dim>(cell, axis, end);
              const auto &divided = open.faces[axis];
              if (divided.kind(face) == Kind::whole)
                known.join(
                  {cell, -1}, value(grid.faces(axis)->point(face)), grid.face_area(axis, face));
              for (int k = divided.first(face); k < divided.last(face); ++k)
                if (open.pieces[axis][k].components[1 - end] != open.outside)
                  known.join(end_of_piece(open, axis, k, 1 - end),
                             value(divided.all()[k].place),
                             std::abs(divided.all()[k].measure));
            });
          }
    }


    /// Give the unknown ones their means; the number of them that became known, on all ranks.
    template <int dim>
    unsigned int
    take_means(Field<dim>                        &scalar,
               const KnownNeighbours<dim>        &known,
               const std::vector<GridIndex<dim>> &cells,
               const MPI_Comm                     communicator)
    {
      unsigned int n_filled = 0;
      const auto   take     = [&](double &value, const double sum, const double area) {
        if (!std::isnan(value) || !(area > 0))
          return;
        value = sum / area;
        ++n_filled;
      };
      for (const auto &cell : cells)
        take(scalar(cell), known.values(cell), known.areas(cell));
      for (std::size_t c = 0; c < scalar.parts().size(); ++c)
        take(scalar.parts()[c], known.values.parts()[c], known.areas.parts()[c]);
      return dealii::Utilities::MPI::sum(n_filled, communicator);
    }


    /// From neighbour to neighbour as far as they are joined. Collective.
    template <int dim>
    void
    spread(Field<dim> &scalar, const std::vector<GridIndex<dim>> &cells, const MacGrid<dim> &grid)
    {
      unsigned int n_filled = 1;
      while (n_filled > 0)
        {
          scalar.exchange(1);
          KnownNeighbours<dim> known(scalar);
          for (const auto &cell : cells)
            join_whole_neighbours(known, scalar, grid, cell);
          join_through_pieces(known, scalar);
          n_filled = take_means(scalar, known, cells, grid.communicator());
        }
    }
  } // namespace


  template <int dim>
  void
  fill_unknown(Field<dim>                   &scalar,
               const FluidModel<dim>        &model,
               const BoundaryCondition<dim> &condition,
               const double                  time)
  {
    unsigned int                n_unknown = 0;
    std::vector<GridIndex<dim>> cells;
    for_each_value(scalar, [&](const double value, const auto &, const auto &) {
      n_unknown += std::isnan(value);
    });
    if (dealii::Utilities::MPI::sum(n_unknown, model.grid().communicator()) == 0)
      return;
    for_each(scalar.owned(), [&](const GridIndex<dim> &cell) {
      if (std::isnan(scalar(cell)))
        cells.push_back(cell);
    });
    spread(scalar, cells, model.grid());
    KnownNeighbours<dim> boundaries(scalar);
    join_boundaries(boundaries, model, condition, time);
    if (take_means(scalar, boundaries, cells, model.grid().communicator()) > 0)
      spread(scalar, cells, model.grid());
    for_each_value(scalar, [](double &value, const auto &, const auto &) {
      if (std::isnan(value))
        value = 0;
    });
  }


  template void
  fill_unknown(Field<2> &, const FluidModel<2> &, const BoundaryCondition<2> &, const double);
  template void
  fill_unknown(Field<3> &, const FluidModel<3> &, const BoundaryCondition<3> &, const double);
} // namespace undine
