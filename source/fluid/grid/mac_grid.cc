// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/mac_grid.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    template <int dim>
    std::array<Row, dim>
    rows_of_lattice(const typename MacGrid<dim>::Planes &planes,
                    const std::array<bool, dim>         &periodic,
                    const unsigned int                   normal_axis)
    {
      std::array<Row, dim> rows;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto ends = periodic[d] ? Row::Ends::periodic : Row::Ends::bounded;
          rows[d] =
            d == normal_axis ? Row::of_planes(planes[d], ends) : Row::of_centres(planes[d], ends);
        }
      return rows;
    }
  } // namespace


  template <int dim>
  MacGrid<dim>::MacGrid(const MPI_Comm              communicator,
                        const Planes               &planes,
                        const std::array<bool, dim> periodic)
    : plane_positions(planes)
  {
    GridIndex<dim> n_cells;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n_cells[d]      = planes[d].size() - 1;
        lower_corner[d] = planes[d].front();
        upper_corner[d] = planes[d].back();
      }
    blocks       = std::make_shared<const Blocks<dim>>(communicator, n_cells, periodic);
    cell_lattice = std::make_shared<const Lattice<dim>>(
      blocks, rows_of_lattice<dim>(planes, periodic, Lattice<dim>::no_axis), Lattice<dim>::no_axis);
    for (unsigned int axis = 0; axis < dim; ++axis)
      face_lattices[axis] = std::make_shared<const Lattice<dim>>(
        blocks, rows_of_lattice<dim>(planes, periodic, axis), axis);
  }


  template <int dim>
  MPI_Comm
  MacGrid<dim>::communicator() const
  {
    return blocks->communicator();
  }


  template <int dim>
  dealii::types::global_dof_index
  MacGrid<dim>::n_cells() const
  {
    return cell_lattice->n_points();
  }


  template <int dim>
  const GridIndex<dim> &
  MacGrid<dim>::cells_along() const
  {
    return blocks->n_cells();
  }


  template <int dim>
  bool
  MacGrid<dim>::periodic(const unsigned int axis) const
  {
    return blocks->periodic(axis);
  }


  template <int dim>
  const dealii::Point<dim> &
  MacGrid<dim>::lower() const
  {
    return lower_corner;
  }


  template <int dim>
  const dealii::Point<dim> &
  MacGrid<dim>::upper() const
  {
    return upper_corner;
  }


  template <int dim>
  const std::vector<double> &
  MacGrid<dim>::planes(const unsigned int axis) const
  {
    return plane_positions[axis];
  }


  template <int dim>
  const std::shared_ptr<const Lattice<dim>> &
  MacGrid<dim>::cells() const
  {
    return cell_lattice;
  }


  template <int dim>
  const std::shared_ptr<const Lattice<dim>> &
  MacGrid<dim>::faces(const unsigned int axis) const
  {
    return face_lattices[axis];
  }


  template <int dim>
  double
  MacGrid<dim>::cell_width(const unsigned int axis, const int cell) const
  {
    const int i = cell_lattice->row(axis).wrapped(cell);
    return plane_positions[axis][i + 1] - plane_positions[axis][i];
  }


  template <int dim>
  double
  MacGrid<dim>::dual_width(const unsigned int axis, const int plane) const
  {
    const int  n         = cells_along()[axis];
    const bool has_below = periodic(axis) || plane > 0;
    const bool has_above = periodic(axis) || plane < n;
    return ((has_below ? cell_width(axis, plane - 1) : 0.) +
            (has_above ? cell_width(axis, plane) : 0.)) /
           2;
  }


  template <int dim>
  double
  MacGrid<dim>::cell_volume(const GridIndex<dim> &cell) const
  {
    double volume = 1;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= cell_width(d, cell[d]);
    return volume;
  }


  template <int dim>
  double
  MacGrid<dim>::face_area(const unsigned int axis, const GridIndex<dim> &face) const
  {
    double area = 1;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        area *= cell_width(d, face[d]);
    return area;
  }


  template <int dim>
  std::vector<double>
  MacGrid<dim>::cell_widths(const int first, const int n) const
  {
    std::vector<double> result;
    for (int cell = first; cell < first + n; ++cell)
      result.push_back(cell_width(0, cell));
    return result;
  }


  template <int dim>
  void
  MacGrid<dim>::set_face_areas(std::vector<double>       &areas,
                               const unsigned int         axis,
                               const GridIndex<dim>      &first,
                               const std::vector<double> &widths) const
  {
    double across = 1;
    for (unsigned int d = 1; d < dim; ++d)
      if (d != axis)
        across *= cell_width(d, first[d]);
    if (axis == 0)
      areas.assign(widths.size(), across);
    else
      {
        areas.resize(widths.size());
        for (std::size_t i = 0; i < widths.size(); ++i)
          areas[i] = widths[i] * across;
      }
  }


  template <int dim>
  double
  MacGrid<dim>::dual_volume(const unsigned int axis, const GridIndex<dim> &face) const
  {
    return face_area(axis, face) * dual_width(axis, face[axis]);
  }


  template <int dim>
  bool
  MacGrid<dim>::at_boundary(const unsigned int axis, const GridIndex<dim> &face) const
  {
    return !periodic(axis) && (face[axis] == 0 || face[axis] == cells_along()[axis]);
  }


  template <int dim>
  GridIndex<dim>
  MacGrid<dim>::cell_at(const dealii::Point<dim> &place) const
  {
    GridIndex<dim> cell;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &row   = face_lattices[d]->row(d);
        const auto  plane = row.locate(place[d]).lower;
        cell[d]           = cell_lattice->row(d).wrapped(plane);
      }
    return cell;
  }


  template <int dim>
  GridIndex<dim>
  MacGrid<dim>::planes_crossed(const dealii::Tensor<1, dim> &distance) const
  {
    GridIndex<dim> crossed;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto  &planes = plane_positions[axis];
        const int    n      = cells_along()[axis];
        const double length = planes[n] - planes[0];
        // More than the whole domain is never needed unless it repeats.
        const double path   = periodic(axis) ? distance[axis] : std::min(distance[axis], length);
        const int    rounds = path / length;
        const double rest   = path - rounds * length;
        const auto   place  = [&](const int plane) {
          const int periods = plane / n;
          return planes[plane % n] + periods * length;
        };
        int most = 0;
        for (int begin = 0, end = 0; begin < n; ++begin)
          {
            while (place(end) < planes[begin] + rest)
              ++end;
            most = std::max(most, end - begin);
          }
        crossed[axis] = rounds * n + most + 1;
      }
    return crossed;
  }


  template class MacGrid<2>;
  template class MacGrid<3>;
} // namespace undine
