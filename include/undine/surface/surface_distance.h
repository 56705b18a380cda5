// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_surface_distance_h
#define undine_surface_surface_distance_h

#include <undine/surface/surface.h>

#include <deal.II/base/bounding_box.h>

#include <memory>
#include <vector>

namespace undine
{
  /// How far places are from a closed surface at rest, and on which side of it, in a time that
  /// grows with the logarithm of the facets (R-tree of their boxes). The side is that of the normal
  /// of what is nearest, a facet, an edge or a node; those of edges and nodes are means by angle
  /// [Baerentzen, Aanaes, IEEE Trans. Vis. Comput. Graph. 11 (2005)], with which it is right
  /// everywhere.
  template <int dim>
  class SurfaceDistance
  {
  public:
    /// The point of the surface that is nearest to a place.
    struct Nearest
    {
      dealii::Point<dim>     place;    ///< on the surface [m]
      double                 distance; ///< negative inside [m]
      dealii::Tensor<1, dim> outwards; ///< direction of the surface's normal there, of length 1
    };

    /// `surface` is closed (check_closed()) and its nodes are at `positions` [m].
    SurfaceDistance(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions);
    ~SurfaceDistance();

    /// The point of the surface that is nearest to `place` [m].
    Nearest
    nearest(const dealii::Point<dim> &place) const;

    /// Around the whole surface [m].
    dealii::BoundingBox<dim>
    box() const;

  private:
    struct Tree;

    std::array<dealii::Point<dim>, dim>
    corners(const unsigned int facet) const;

    /// Normal of the inside of a facet or of one of its nodes or ridges, of any length.
    dealii::Tensor<1, dim>
    normal(const unsigned int facet, const std::array<double, dim> &coordinates) const;

    Surface<dim>                        surface;
    std::vector<dealii::Point<dim>>     positions;
    std::vector<dealii::Tensor<1, dim>> facet_normals, ridge_normals, node_normals;
    std::unique_ptr<const Tree>         tree;
  };
} // namespace undine

#endif
