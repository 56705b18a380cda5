// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_surface_crossings_h
#define undine_surface_surface_crossings_h

#include <undine/surface/held_pairs.h>
#include <undine/surface/surface.h>

#include <array>
#include <map>
#include <set>
#include <vector>

namespace undine
{
  /// Where surfaces cross: new nodes, in which an edge of one passes through a facet of the other
  /// (in 2D facets are edges), and the lines in facets along which they cross (in 2D nodes).
  template <int dim>
  struct SurfaceCrossings
  {
    using Weights = std::array<double, dim>; ///< barycentric coordinates in a facet [1]
    using Ridge   = typename Surface<dim>::Ridge;

    /// What lies in a facet.
    struct InFacet
    {
      std::map<unsigned int, Weights> nodes; ///< by their numbers
      std::set<Ridge>                 lines; ///< between these, the lower node first
    };

    /// A node on an edge between two others.
    struct NewNode
    {
      std::array<unsigned int, 2> edge;
      double                      part; ///< of the edge, up to there [1]
    };

    std::vector<NewNode>            new_nodes;       ///< numbered after those of the surface
    std::map<unsigned int, InFacet> in_facets;       ///< by the number of the facet
    bool                            are_sure = true; ///< else rounding decides on some
  };

  /// Those of all pairs of surfaces. On which side of a facet a node lies is decided by the sign of
  /// a volume, computed from the nodes in ascending order, so that neighbouring facets agree; a
  /// node in the plane of a facet counts as on one side of it.
  template <int dim>
  SurfaceCrossings<dim>
  find_crossings(const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<PairOfSurfaces>     &pairs,
                 double                                 uncertainty);
} // namespace undine

#endif
