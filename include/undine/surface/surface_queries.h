// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_surface_queries_h
#define undine_surface_surface_queries_h

#include <undine/fluid/grid/mac_grid.h>
#include <undine/fluid/visibility/obstruction.h>
#include <undine/surface/facet_geometry.h>
#include <undine/surface/moved_surface.h>
#include <undine/surface/surface_walls.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace undine
{
  /// Geometric queries about a surface, in a time that grows with the logarithm of the number of
  /// its facets (R-tree of their boxes).
  ///
  /// Facets are taken as thick as rounding: `tolerance` times the size of the domain, and as much
  /// wider. No segment passes between facets that share an edge or a node.
  ///
  /// In periodic directions the surface repeats.
  template <int dim>
  class SurfaceQueries : public Obstruction<dim>
  {
  public:
    static constexpr double tolerance = 1e-13;

    /// Keeps the positions and a pointer to the surface, which must outlive it.
    SurfaceQueries(const MacGrid<dim> &grid, MovedSurface<dim> moved);

    ~SurfaceQueries() override;

    using FacetImage = typename Obstruction<dim>::FacetImage;

    double
    first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const override;

    std::vector<FacetImage>
    facets_near(const dealii::BoundingBox<dim> &box) const override;

    using Slab = typename Obstruction<dim>::Slab;

    typename Obstruction<dim>::Patch
    patch(const std::vector<FacetImage> &images) const override;

    bool
    is_wall(const std::vector<FacetImage>  &images,
            const Slab                     &slab,
            const dealii::BoundingBox<dim> &box) const override;

    double
    first_hit(const FacetImage         &image,
              const dealii::Point<dim> &from,
              const dealii::Point<dim> &to) const override;

    bool
    is_freshly_cleared(const dealii::Point<dim> &place) const override;

    dealii::Point<dim>
    carried(const dealii::Point<dim> &place) const override;

    void
    for_each_freshly_cleared(
      const Lattice<dim>                                &lattice,
      const IndexBox<dim>                               &box,
      const std::function<void(const GridIndex<dim> &)> &action) const override;

    typename Obstruction<dim>::NearestPoint
    nearest_point_to(const dealii::Point<dim> &place) const override;

  private:
    struct Trees;

    /// Has a facet swept `place` in the last step?
    bool
    passes_over(const unsigned int facet, const dealii::Point<dim> &place) const;

    MovedSurface<dim>            moved;
    std::array<double, dim>      periods; ///< [m]; 0: not periodic
    double                       thickness;
    std::vector<ThickFacet<dim>> thick_facets;
    std::vector<std::pair<dealii::BoundingBox<dim>, unsigned int>>
                                 swept_boxes; ///< around what facets that moved have swept
    std::unique_ptr<const Trees> trees;
    std::unique_ptr<const SurfaceWalls<dim>> walls;
  };
} // namespace undine

#endif
