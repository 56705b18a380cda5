// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/boxes.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface_walls.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  template <int dim>
  SurfaceWalls<dim>::SurfaceWalls(const MovedSurface<dim> &moved, const double thickness)
    : moved(moved)
    , thickness(thickness)
  {
    facets_of_ridge.assign(moved.surface->ridges().size(), {{no_facet, no_facet}});
    for (unsigned int facet = 0; facet < moved.surface->facets().size(); ++facet)
      {
        const auto   area = area_vector(moved.nodes(facet));
        const double size = area.norm();
        normals.push_back(size > 0 ? area / size : area);
        for (const unsigned int ridge : moved.surface->ridges(facet))
          {
            auto &pair                        = facets_of_ridge[ridge];
            pair[pair[0] == no_facet ? 0 : 1] = facet;
          }
      }
  }


  template <int dim>
  typename SurfaceWalls<dim>::Patch
  SurfaceWalls<dim>::patch(const std::vector<FacetImage> &images) const
  {
    const auto for_each_place = [&](const auto &action) {
      for (const auto &image : images)
        for (const unsigned int node : moved.surface->facets()[image.facet])
          action(dealii::Point<dim>(moved.positions[node] - image.to_facet));
    };

    Patch  patch;
    auto  &slab    = patch.slab;
    double largest = 0; // area of a facet
    for (const auto &image : images)
      if (const double area = area_vector(moved.nodes(image.facet)).norm(); area > largest)
        {
          largest     = area;
          slab.normal = normals[image.facet];
        }
    slab.lower   = std::numeric_limits<double>::infinity();
    slab.upper   = -slab.lower;
    patch.radius = 0;
    for (unsigned int d = 0; d < dim; ++d)
      patch.lower[d] = slab.lower, patch.upper[d] = slab.upper;
    for_each_place([&](const auto &place) {
      patch.middle += place;
      for (unsigned int d = 0; d < dim; ++d)
        {
          patch.lower[d] = std::min(patch.lower[d], place[d]);
          patch.upper[d] = std::max(patch.upper[d], place[d]);
        }
      slab.lower = std::min(slab.lower, slab.normal * place);
      slab.upper = std::max(slab.upper, slab.normal * place);
    });
    patch.middle /= std::max<std::size_t>(dim * images.size(), 1);
    for_each_place([&](const auto &place) {
      patch.radius = std::max(patch.radius, place.distance(patch.middle));
    });
    const double rim = 100 * thickness; // what places may lose by rounding
    slab.lower -= rim, slab.upper += rim;
    for (unsigned int d = 0; d < dim; ++d)
      patch.lower[d] -= rim, patch.upper[d] += rim;
    return patch;
  }


  template <int dim>
  bool
  SurfaceWalls<dim>::has_rim(const FacetImage               &image,
                             const dealii::Tensor<1, dim>   &normal,
                             const dealii::BoundingBox<dim> &box) const
  {
    const auto &numbers = moved.surface->ridges(image.facet);
    for (unsigned int k = 0; k < dim; ++k)
      {
        const auto        &pair  = facets_of_ridge[numbers[k]];
        const unsigned int other = pair[0] == image.facet ? pair[1] : pair[0];
        if (other != no_facet && normals[other] * normal > 0)
          continue;
        std::array<dealii::Point<dim>, dim - 1> ends;
        for (unsigned int e = 0; e + 1 < dim; ++e)
          ends[e] = moved.positions[moved.surface->ridges()[numbers[k]][e]] - image.to_facet;
        if (meet(box, box_around(ends, 100 * thickness)))
          return true;
      }
    return false;
  }


  template <int dim>
  bool
  SurfaceWalls<dim>::is_wall(const std::vector<FacetImage>  &images,
                             const Slab                     &slab,
                             const dealii::BoundingBox<dim> &box) const
  {
    const double steep = std::sqrt(.5);
    for (const auto &image : images)
      {
        const double cosine = slab.normal * normals[image.facet];
        if (std::abs(cosine) < steep ||
            has_rim(image, cosine > 0 ? slab.normal : -slab.normal, box))
          return false;
      }
    return !images.empty();
  }


  template class SurfaceWalls<2>;
  template class SurfaceWalls<3>;
} // namespace undine
