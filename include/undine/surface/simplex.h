// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_simplex_h
#define undine_surface_simplex_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>

namespace undine
{
  /// Geometry of facets that differs between segments in the plane and triangles in space.

  /// Length times unit normal, to the right of the direction from node 0 to node 1 [m].
  inline dealii::Tensor<1, 2>
  area_vector(const std::array<dealii::Point<2>, 2> &nodes)
  {
    const auto segment = nodes[1] - nodes[0];
    return dealii::Tensor<1, 2>({segment[1], -segment[0]});
  }

  /// Area times unit normal, to where the nodes run counter-clockwise [m^2].
  inline dealii::Tensor<1, 3>
  area_vector(const std::array<dealii::Point<3>, 3> &nodes)
  {
    return 0.5 * dealii::cross_product_3d(nodes[1] - nodes[0], nodes[2] - nodes[0]);
  }

  /// True if `place`, a point of the line or plane of a facet, lies in the facet. @{
  inline bool
  contains(const std::array<dealii::Point<2>, 2> &nodes, const dealii::Point<2> &place)
  {
    return (place - nodes[0]) * (place - nodes[1]) <= 0;
  }

  inline bool
  contains(const std::array<dealii::Point<3>, 3> &nodes, const dealii::Point<3> &place)
  {
    const auto normal = area_vector(nodes);
    for (unsigned int k = 0; k < 3; ++k)
      if (normal * dealii::cross_product_3d(nodes[(k + 1) % 3] - nodes[k], place - nodes[k]) < 0)
        return false;
    return true;
  }
  /// @}

  /// The k-th ridge of a facet with its lower node first. @{
  inline std::array<unsigned int, 1>
  ridge(const std::array<unsigned int, 2> &facet, const unsigned int k)
  {
    return {{facet[k]}};
  }

  inline std::array<unsigned int, 2>
  ridge(const std::array<unsigned int, 3> &facet, const unsigned int k)
  {
    const auto ends = std::minmax(facet[k], facet[(k + 1) % 3]);
    return {{ends.first, ends.second}};
  }
  /// @}

  /// True if the facet runs along its k-th ridge from the lower node to the higher one; in 2D if
  /// it begins there. Two facets that meet in a ridge differ. @{
  inline bool
  runs_forward(const std::array<unsigned int, 2> &, const unsigned int k)
  {
    return k == 0;
  }

  inline bool
  runs_forward(const std::array<unsigned int, 3> &facet, const unsigned int k)
  {
    return facet[k] < facet[(k + 1) % 3];
  }
  /// @}
} // namespace undine

#endif
