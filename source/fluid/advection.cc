// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection.h>
#include <undine/fluid/pressure_gradient.h>
#include <undine/fluid/pressure_numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();


    /// Sums over the known neighbours of cells and components to which nothing was brought.
    template <int dim>
    struct KnownNeighbours
    {
      explicit KnownNeighbours(const Field<dim> &scalar)
        : values(scalar.shared_lattice(), scalar.open_parts())
        , areas(values)
      {
      }

      /// Through an opening of this area between two places.
      void
      join(const Field<dim>         &scalar,
           const PressurePlace<dim> &to,
           const PressurePlace<dim> &from,
           const double              area)
      {
        const double other = value_at(scalar, from);
        if ((to.component < 0 && !scalar.owned().contains(to.cell)) || std::isnan(other))
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
      using Kind = typename LatticeParts<dim>::Kind;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int end : {0, 1})
          {
            const auto face = moved<dim>(cell, axis, end);
            if (scalar.open_parts()->faces[axis].kind(face) == Kind::whole &&
                !grid.at_boundary(axis, face))
              known.join(scalar,
                         {cell, -1},
                         {moved<dim>(cell, axis, 2 * end - 1), -1},
                         grid.face_area(axis, face));
          }
    }


    template <int dim>
    void
    join_through_pieces(KnownNeighbours<dim> &known, const Field<dim> &scalar)
    {
      const auto &open = *scalar.open_parts();
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
          {
            const auto &ends = open.pieces[axis][k].components;
            if (ends[0] == open.outside || ends[1] == open.outside)
              continue;
            for (const unsigned int end : {0, 1})
              known.join(scalar,
                         end_of_piece(open, axis, k, end),
                         end_of_piece(open, axis, k, 1 - end),
                         std::abs(open.faces[axis].all()[k].measure));
          }
    }


    /// Where nothing could be seen, scalars take the mean of their known neighbours, the nearer
    /// ones first; then zero. Collective.
    template <int dim>
    void
    fill_unknown(Field<dim> &scalar, const MacGrid<dim> &grid)
    {
      std::vector<GridIndex<dim>> cells;
      for_each(scalar.owned(), [&](const GridIndex<dim> &cell) {
        if (std::isnan(scalar(cell)))
          cells.push_back(cell);
      });
      for (unsigned int round = 0; round < 4; ++round)
        {
          scalar.exchange(1);
          KnownNeighbours<dim> known(scalar);
          for (const auto &cell : cells)
            join_whole_neighbours(known, scalar, grid, cell);
          join_through_pieces(known, scalar);
          for (const auto &cell : cells)
            if (std::isnan(scalar(cell)) && known.areas(cell) > 0)
              scalar(cell) = known.values(cell) / known.areas(cell);
          for (std::size_t c = 0; c < scalar.parts().size(); ++c)
            if (std::isnan(scalar.parts()[c]) && known.areas.parts()[c] > 0)
              scalar.parts()[c] = known.values.parts()[c] / known.areas.parts()[c];
        }
      for_each_value(scalar, [](double &value, const auto &, const auto &) {
        if (std::isnan(value))
          value = 0;
      });
    }
  } // namespace


  template <int dim>
  Field<dim>
  completed(const Flow<dim> &flow, Field<dim> field, const BoundaryCondition<dim> &condition)
  {
    field.exchange(flow.width());
    fill_boundary_points(field, flow.model(), condition, flow.velocity(), flow.time());
    return field;
  }


  template <int dim>
  NearBodies<dim>::NearBodies(const Flow<dim> &flow_, const Field<dim> &source)
    : flow(flow_)
    , axis(source.lattice().normal_axis())
  {
    if (const auto *obstruction = flow.bodies().obstruction)
      samples = std::make_unique<const VisibleSamples<dim>>(
        source, flow.width(), *obstruction, flow.vicinity());
  }


  template <int dim>
  double
  NearBodies<dim>::value_at(const dealii::Point<dim> &foot) const
  {
    if (const auto seen = samples->at(foot))
      return *seen;
    return axis < dim ? flow.bodies().obstruction->nearest_velocity(foot)[axis] : unknown;
  }


  template <int dim>
  void
  NearBodies<dim>::finish(Field<dim> &carried) const
  {
    if (!carried.open_parts())
      return;
    if (axis >= dim)
      fill_unknown(carried, flow.model().grid());
    set_means(carried, flow.model().grid());
  }


  template class NearBodies<2>;
  template class NearBodies<3>;
  template Field<2>
  completed(const Flow<2> &, Field<2>, const BoundaryCondition<2> &);
  template Field<3>
  completed(const Flow<3> &, Field<3>, const BoundaryCondition<3> &);
} // namespace undine
