// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_halves.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/field_algebra.h>

namespace undine
{
  namespace
  {
    /// Area times half the width of the cell at `end` of a face; zero outside the domain.
    template <int dim>
    double
    half_of_whole(const MacGrid<dim>   &grid,
                  const unsigned int    axis,
                  const GridIndex<dim> &face,
                  const unsigned int    end)
    {
      if (grid.at_boundary(axis, face) && (face[axis] == 0) == (end == 0))
        return 0;
      const int cell = face[axis] + static_cast<int>(end) - 1;
      return grid.face_area(axis, face) * grid.cell_width(axis, cell) / 2;
    }


    /// Sum of the areas of the pieces around each component, normal to `axis`.
    template <int dim>
    std::vector<double>
    apertures(const FluidTopology<dim> &open, const unsigned int axis)
    {
      std::vector<double> result(open.cells.all().size());
      for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
        for (const int c : open.pieces[axis][k].components)
          if (c >= 0)
            result[c] += open.faces[axis].all()[k].measure;
      return result;
    }


    template <int dim>
    void
    set_pieces(DualHalves<dim>          &halves,
               const MacGrid<dim>       &grid,
               const FluidTopology<dim> &open,
               const unsigned int        axis)
    {
      const auto opening = apertures(open, axis);
      for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
        {
          const auto           &piece = open.pieces[axis][k];
          const auto           &part  = open.faces[axis].all()[k];
          std::array<double, 2> volumes{};
          for (const unsigned int end : {0, 1})
            if (const int c = piece.components[end]; c >= 0)
              volumes[end] = part.measure * open.cells.all()[c].measure / opening[c];
            else if (c == FluidTopology<dim>::whole)
              volumes[end] = part.measure * half_of_whole(grid, axis, part.index, end) /
                             grid.face_area(axis, part.index);
          const double sum = volumes[0] + volumes[1];
          for (const unsigned int end : {0, 1})
            halves[end][axis].parts()[k] = piece.volume * (sum > 0 ? volumes[end] / sum : 0.5);
        }
    }
  } // namespace


  template <int dim>
  DualHalves<dim>
  dual_halves(const MacGrid<dim> &grid, const std::shared_ptr<const FluidTopology<dim>> &topology)
  {
    DualHalves<dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        for (const unsigned int end : {0, 1})
          {
            result[end][axis] = Field<dim>(grid.faces(axis), topology);
            auto &field       = result[end][axis];
            for_each(field.owned(), [&](const GridIndex<dim> &face) {
              if (is_whole(field.divided(), face))
                field(face) = half_of_whole(grid, axis, face, end);
            });
          }
        if (topology)
          set_pieces(result, grid, *topology, axis);
      }
    for (auto &half : result)
      exchange(half);
    return result;
  }


  template DualHalves<2>
  dual_halves(const MacGrid<2> &, const std::shared_ptr<const FluidTopology<2>> &);
  template DualHalves<3>
  dual_halves(const MacGrid<3> &, const std::shared_ptr<const FluidTopology<3>> &);
} // namespace undine
