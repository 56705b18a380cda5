// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_surface_walls_h
#define undine_surface_surface_walls_h

#include <undine/fluid/visibility/obstruction.h>
#include <undine/surface/moved_surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// Which facets of a surface form a wall, through which nothing is visible, by the normals of
  /// neighbours. For facets that the caller has found near a place.
  template <int dim>
  class SurfaceWalls
  {
  public:
    using FacetImage = typename Obstruction<dim>::FacetImage;
    using Slab       = typename Obstruction<dim>::Slab;
    using Patch      = typename Obstruction<dim>::Patch;

    /// `thickness` of facets [m]. Keeps a reference to the surface.
    SurfaceWalls(const MovedSurface<dim> &moved, double thickness);

    /// Obstruction::patch().
    Patch
    patch(const std::vector<FacetImage> &images) const;

    /// Obstruction::is_wall().
    bool
    is_wall(const std::vector<FacetImage>  &images,
            const Slab                     &slab,
            const dealii::BoundingBox<dim> &box) const;

  private:
    /// Has a facet whose normal is less than 90 degrees away from `normal` a ridge near `box`
    /// beyond which there is none such?
    bool
    has_rim(const FacetImage               &image,
            const dealii::Tensor<1, dim>   &normal,
            const dealii::BoundingBox<dim> &box) const;

    static constexpr unsigned int no_facet = -1;

    const MovedSurface<dim>                 &moved;
    const double                             thickness;
    std::vector<dealii::Tensor<1, dim>>      normals;         ///< of facets, unit or zero
    std::vector<std::array<unsigned int, 2>> facets_of_ridge; ///< or no_facet
  };
} // namespace undine

#endif
