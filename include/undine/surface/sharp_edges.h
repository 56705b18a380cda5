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
    double                      area;     ///< a third of both facets, less if it is blunt [m^2]
    dealii::Tensor<1, 3>        outwards; ///< half way between the facets' normals, of length 1
    bool                        blunt;    ///< less than 30 degrees
  };

  /// Edges whose facets' normals enclose an angle theta of more than one degree; none in the plane.
  /// Those of less than 30 degrees count with the share
  ///
  ///     (1 - cos theta) / (1 - cos 30 degrees)                                               (S17)
  ///
  /// of their area: where a mesh resolves a smooth surface it goes to zero as facets become
  /// smaller. @{
  std::vector<SharpEdge>
  find_sharp_edges(const Surface<2> &surface, const std::vector<dealii::Point<2>> &places);
  std::vector<SharpEdge>
  find_sharp_edges(const Surface<3> &surface, const std::vector<dealii::Point<3>> &places);
  /// @}
} // namespace undine

#endif
