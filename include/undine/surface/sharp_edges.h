// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_sharp_edges_h
#define undine_surface_sharp_edges_h

#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// Where two facets of a surface in space meet in a convex edge.
  struct SharpEdge
  {
    std::array<unsigned int, 2> nodes;
    unsigned int                surface;
    double                      length;   ///< [m]
    double                      area;     ///< a third of both facets [m^2]
    dealii::Tensor<1, 3>        outwards; ///< half way between the facets' normals, of length 1
  };

  /// Edges whose facets' normals differ by more than 30 degrees; none in the plane. @{
  std::vector<SharpEdge>
  find_sharp_edges(const Surface<2> &surface, const std::vector<dealii::Point<2>> &places);
  std::vector<SharpEdge>
  find_sharp_edges(const Surface<3> &surface, const std::vector<dealii::Point<3>> &places);
  /// @}
} // namespace undine

#endif
