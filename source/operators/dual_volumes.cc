// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/dual_volumes.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// Sums of the pieces' areas of each component by direction, both ends together.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    apertures(const CutCells<dim> &cut)
    {
      std::vector<dealii::Tensor<1, dim>> result(cut.components.size());
      for (const auto &piece : cut.pieces)
        for (const int c : piece.components)
          if (c >= 0)
            result[c][cut.faces[piece.face].axis] += std::abs(piece.area);
      return result;
    }


    /// Volume that a component gives per area of its pieces normal to `axis` [m].
    template <int dim>
    double
    share(const CutCells<dim> &cut,
          const int            component,
          const unsigned int   axis,
          const double         aperture)
    {
      const auto  &c     = cut.components[component];
      const double width = cut.block.planes().width(axis, cut.cells[c.cell].index[axis]);
      return std::min(std::max(c.volume, 0.) / aperture, DualVolumes<dim>::largest_share * width);
    }
  } // namespace


  template <int dim>
  DualVolumes<dim>
  dual_volumes(const CutCells<dim> &cut)
  {
    const auto       areas = apertures(cut);
    DualVolumes<dim> result;
    result.volumes.reserve(cut.pieces.size());
    for (const auto &piece : cut.pieces)
      {
        const auto        &face   = cut.faces[piece.face];
        const unsigned int axis   = face.axis;
        const double       area   = std::abs(piece.area);
        double             volume = 0, distance = 0;
        for (const int end : {0, 1})
          {
            const int cell = face.index[axis] + end - 1;
            const int c    = piece.components[end];
            if (c == cut.outside)
              continue;
            const double width = cut.block.planes().width(axis, cell);
            distance += width / 2;
            volume += area * (c == cut.uncut ? width / 2 : share(cut, c, axis, areas[c][axis]));
          }
        const double least = DualVolumes<dim>::smallest_volume * area * distance;
        result.added[axis] += std::max(0., least - volume);
        result.volumes.push_back(std::max(volume, least));
      }
    result.unassigned.resize(cut.components.size());
    for (unsigned int c = 0; c < cut.components.size(); ++c)
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const double area          = areas[c][axis];
          result.unassigned[c][axis] = std::max(cut.components[c].volume, 0.) -
                                       (area > 0 ? area * share(cut, c, axis, area) : 0.);
        }
    return result;
  }


  template DualVolumes<2>
  dual_volumes(const CutCells<2> &);
  template DualVolumes<3>
  dual_volumes(const CutCells<3> &);
} // namespace undine
