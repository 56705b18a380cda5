// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/face_links.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// The length that two rims on the same edge of the grid have in common.
    double
    common_length(const Rim &a, const Rim &b)
    {
      const double common = std::min(a.middle + a.length / 2, b.middle + b.length / 2) -
                            std::max(a.middle - a.length / 2, b.middle - b.length / 2);
      return a.length > 0 && b.length > 0 ? std::max(0., common) : 0.;
    }
  } // namespace


  template <int dim>
  double
  FaceLinks<dim>::area_on_side(const FacePlace<dim> &place, const Side &side) const
  {
    if (place.part < 0)
      return whole_area(place.face, side);
    double result = 0;
    for_each_opening(place, side, [&](const Opening &opening) { result += opening.area; });
    return result;
  }


  template <int dim>
  PieceShape<dim>
  FaceLinks<dim>::whole_shape(const GridIndex<dim> &face) const
  {
    PieceShape<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        {
          result.lower_half[d] = grid.face_area(axis, face) / 2;
          for (const unsigned int end : {0, 1})
            result.rims[2 * d + end] = whole_rim(axis, face, d);
        }
    return result;
  }


  template <int dim>
  Rim
  FaceLinks<dim>::whole_rim(const unsigned int    normal,
                            const GridIndex<dim> &face,
                            const unsigned int    d) const
  {
    Rim result{1, 0};
    for (unsigned int along = 0; along < dim; ++along)
      if (along != normal && along != d)
        result = {grid.cell_width(along, face[along]),
                  grid.faces(normal)->row(along).position(face[along])};
    return result;
  }


  template <int dim>
  double
  FaceLinks<dim>::half_area(const unsigned int    normal,
                            const FacePlace<dim> &place,
                            const unsigned int    end) const
  {
    if (place.part < 0)
      return grid.face_area(normal, place.face) / 2;
    const double lower = surfaces.shapes[normal][place.part].lower_half[axis];
    const double all   = open.faces[normal].all()[place.part].measure;
    return std::max(0., end == 0 ? lower : all - lower);
  }


  template <int dim>
  std::optional<FacePlace<dim>>
  FaceLinks<dim>::piece_at(const GridIndex<dim> &face,
                           const Side           &side,
                           const unsigned int    half,
                           const int             component,
                           const unsigned int    normal,
                           const FacePlace<dim> &opening) const
  {
    std::optional<FacePlace<dim>> result;
    double                        longest = -1, nearest = std::numeric_limits<double>::infinity();
    const Rim                     of_opening = rim(normal, opening, {axis, 1 - half});
    for_each_place(face, [&](const FacePlace<dim> &place) {
      if (beside(place, half) != component)
        return;
      const double common   = common_length(rim(axis, place, side), of_opening);
      const double distance = centroid(place).distance(centroid(normal, opening));
      if (common < longest || (common == longest && distance >= nearest))
        return;
      longest = common;
      nearest = distance;
      result  = place;
    });
    return result;
  }


  template class FaceLinks<2>;
  template class FaceLinks<3>;
} // namespace undine
