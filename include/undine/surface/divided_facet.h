// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_divided_facet_h
#define undine_surface_divided_facet_h

#include <array>
#include <vector>

namespace undine
{
  /// A facet with points in it, by their barycentric coordinates [points][dim]; the first are its
  /// corners, a coordinate of those on its sides is zero. Lines, of which points are the ends (in
  /// 2D points), must be joints.
  template <int dim>
  struct FacetWithPoints
  {
    std::vector<std::array<double, dim>>           points;
    std::vector<std::array<unsigned int, dim - 1>> lines;
  };

  /// Simplices of all these points that fill the facet and have its orientation, by numbers of
  /// points; empty if rounding does not allow it. In 3D edges are taken in if they cross no other:
  /// lines and sides first, then the shortest. @{
  std::vector<std::array<unsigned int, 2>>
  divided(const FacetWithPoints<2> &facet);
  std::vector<std::array<unsigned int, 3>>
  divided(const FacetWithPoints<3> &facet);
  /// @}
} // namespace undine

#endif
