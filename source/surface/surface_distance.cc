// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/facet_geometry.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface_distance.h>

#include <deal.II/numerics/rtree.h>

#include <boost/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    namespace index = boost::geometry::index;

    template <int dim>
    using Leaf = std::pair<dealii::BoundingBox<dim>, unsigned int>;


    /// The angle of a facet at its corner k; ends of segments count alike. @{
    double
    angle(const FacetNodes<2> &, const unsigned int)
    {
      return 1;
    }

    double
    angle(const FacetNodes<3> &corners, const unsigned int k)
    {
      const auto   a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
      const double lengths = a.norm() * b.norm();
      return lengths > 0 ? std::acos(std::clamp(a * b / lengths, -1., 1.)) : 0.;
    }
    /// @}
  } // namespace


  template <int dim>
  struct SurfaceDistance<dim>::Tree
  {
    dealii::RTree<Leaf<dim>> facets;
    dealii::BoundingBox<dim> box;
  };


  template <int dim>
  SurfaceDistance<dim>::SurfaceDistance(const Surface<dim>                    &surface,
                                        const std::vector<dealii::Point<dim>> &positions)
    : surface(surface)
    , positions(positions)
    , ridge_normals(surface.ridges().size())
    , node_normals(surface.n_nodes())
  {
    std::vector<Leaf<dim>> leaves;
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      {
        const auto   nodes  = corners(facet);
        const auto   area   = area_vector(nodes);
        const double size   = area.norm();
        const auto   normal = size > 0 ? area / size : area;
        facet_normals.push_back(normal);
        for (unsigned int k = 0; k < dim; ++k)
          {
            ridge_normals[surface.ridges(facet)[k]] += normal;
            node_normals[surface.facets()[facet][k]] += angle(nodes, k) * normal;
          }
        leaves.emplace_back(dealii::BoundingBox<dim>(nodes), facet);
      }
    auto box = leaves.front().first;
    for (const auto &leaf : leaves)
      box.merge_with(leaf.first);
    tree = std::make_unique<const Tree>(Tree{dealii::pack_rtree(leaves), box});
  }


  template <int dim>
  SurfaceDistance<dim>::~SurfaceDistance() = default;


  template <int dim>
  std::array<dealii::Point<dim>, dim>
  SurfaceDistance<dim>::corners(const unsigned int facet) const
  {
    FacetNodes<dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      result[k] = positions[surface.facets()[facet][k]];
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  SurfaceDistance<dim>::normal(const unsigned int             facet,
                               const std::array<double, dim> &coordinates) const
  {
    std::vector<unsigned int> taking_part;
    for (unsigned int k = 0; k < dim; ++k)
      if (coordinates[k] > 1e-12)
        taking_part.push_back(k);
    if (taking_part.size() == dim)
      return facet_normals[facet];
    if (taking_part.size() == 1)
      return node_normals[surface.facets()[facet][taking_part[0]]];
    // Ridge k leads from node k to the next one.
    const unsigned int first =
      (taking_part[0] + 1) % dim == taking_part[1] ? taking_part[0] : taking_part[1];
    return ridge_normals[surface.ridges(facet)[first]];
  }


  template <int dim>
  typename SurfaceDistance<dim>::Nearest
  SurfaceDistance<dim>::nearest(const dealii::Point<dim> &place) const
  {
    Nearest                 result{place, 0, {}};
    double                  least       = std::numeric_limits<double>::infinity();
    unsigned int            least_facet = 0;
    std::array<double, dim> share{};
    const auto              consider = [&](const Leaf<dim> &leaf) {
      const auto         nodes       = corners(leaf.second);
      const auto         coordinates = nearest_point(nodes, place);
      dealii::Point<dim> point;
      for (unsigned int k = 0; k < dim; ++k)
        point += coordinates[k] * nodes[k];
      const double square = point.distance_square(place);
      if (square >= least)
        return;
      least        = square;
      least_facet  = leaf.second;
      result.place = point;
      share        = coordinates;
    };

    // The facet with the nearest box bounds the distance of the search.
    tree->facets.query(index::nearest(place, 1), boost::make_function_output_iterator(consider));
    auto box = dealii::BoundingBox<dim>({place, place});
    box.extend(std::sqrt(least));
    tree->facets.query(index::intersects(box), boost::make_function_output_iterator(consider));

    result.outwards     = normal(least_facet, share);
    const double length = result.outwards.norm();
    if (length > 0)
      result.outwards /= length;
    const bool outside = (place - result.place) * result.outwards > 0;
    result.distance    = outside ? std::sqrt(least) : -std::sqrt(least);
    return result;
  }


  template <int dim>
  dealii::BoundingBox<dim>
  SurfaceDistance<dim>::box() const
  {
    return tree->box;
  }


  template class SurfaceDistance<2>;
  template class SurfaceDistance<3>;
} // namespace undine
