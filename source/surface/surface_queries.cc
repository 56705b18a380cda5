// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/boxes.h>
#include <undine/surface/facet_geometry.h>
#include <undine/surface/surface_queries.h>

#include <deal.II/numerics/rtree.h>

#include <boost/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    template <int dim>
    using Leaf = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    template <int dim>
    using Tree = dealii::RTree<Leaf<dim>>;


    /// Call action(facet) for all facets whose boxes meet a box.
    template <int dim, class Action>
    void
    for_each_near(const Tree<dim> &tree, const dealii::BoundingBox<dim> &box, const Action &action)
    {
      tree.query(
        boost::geometry::index::intersects(box),
        boost::make_function_output_iterator([&](const Leaf<dim> &leaf) { action(leaf.second); }));
    }


    constexpr double nowhere = std::numeric_limits<double>::infinity();


    /// Call action(shift) for the vectors of whole periods by which the box [lower, upper] can be
    /// moved to meet `target`; in directions that are not periodic it is not moved.
    template <int dim, class Action>
    void
    for_each_shift(const dealii::Point<dim>       &lower,
                   const dealii::Point<dim>       &upper,
                   const dealii::BoundingBox<dim> &target,
                   const std::array<double, dim>  &periods,
                   const Action                   &action)
    {
      IndexBox<dim> shifts{{}, all_directions<dim>(1)};
      for (unsigned int d = 0; d < dim; ++d)
        if (periods[d] > 0)
          {
            shifts.lower[d] = std::ceil((target.lower_bound(d) - upper[d]) / periods[d]);
            shifts.upper[d] = std::floor((target.upper_bound(d) - lower[d]) / periods[d]) + 1;
          }
      for_each(shifts, [&](const GridIndex<dim> &index) {
        dealii::Tensor<1, dim> shift;
        for (unsigned int d = 0; d < dim; ++d)
          shift[d] = index[d] * periods[d];
        action(shift);
      });
    }


    /// Call action(a, b) for the images of the places a and b, moved together by whole periods,
    /// whose box, widened by `thickness`, may meet `target`.
    template <int dim, class Action>
    void
    for_each_image(const dealii::Point<dim>       &a,
                   const dealii::Point<dim>       &b,
                   const dealii::BoundingBox<dim> &target,
                   const std::array<double, dim>  &periods,
                   const double                    thickness,
                   const Action                   &action)
    {
      const auto corners = box_around(a, b, thickness).get_boundary_points();
      for_each_shift<dim>(
        corners.first, corners.second, target, periods, [&](const dealii::Tensor<1, dim> &shift) {
          action(dealii::Point<dim>(a + shift), dealii::Point<dim>(b + shift));
        });
    }
  } // namespace


  template <int dim>
  struct SurfaceQueries<dim>::Trees
  {
    Trees(const std::vector<Leaf<dim>> &boxes, const std::vector<Leaf<dim>> &swept_boxes)
      : facets(dealii::pack_rtree(boxes))
      , swept(dealii::pack_rtree(swept_boxes))
      , box(join(boxes))
      , swept_box(join(swept_boxes))
    {
    }

    static dealii::BoundingBox<dim>
    join(const std::vector<Leaf<dim>> &leaves)
    {
      dealii::BoundingBox<dim> result;
      for (std::size_t k = 0; k < leaves.size(); ++k)
        if (k == 0)
          result = leaves[k].first;
        else
          result.merge_with(leaves[k].first);
      return result;
    }

    Tree<dim>                facets; ///< where they are
    Tree<dim>                swept;  ///< what those that moved have swept
    dealii::BoundingBox<dim> box;    ///< around the former
    dealii::BoundingBox<dim> swept_box;
  };


  template <int dim>
  SurfaceQueries<dim>::SurfaceQueries(const MacGrid<dim> &grid, MovedSurface<dim> moved_surface)
    : moved(std::move(moved_surface))
  {
    double largest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        periods[d] = grid.periodic(d) ? grid.upper()[d] - grid.lower()[d] : 0.;
        largest    = std::max({largest, std::abs(grid.lower()[d]), std::abs(grid.upper()[d])});
      }
    thickness = tolerance * largest;

    std::vector<Leaf<dim>> leaves;
    leaves.reserve(moved.surface->facets().size());
    thick_facets.reserve(moved.surface->facets().size());
    for (unsigned int facet = 0; facet < moved.surface->facets().size(); ++facet)
      {
        const auto after = moved.nodes(facet), before = moved.old_nodes(facet);
        thick_facets.emplace_back(after, thickness);
        leaves.emplace_back(box_around(after, thickness), facet);
        if (after == before)
          continue;
        swept_boxes.push_back(leaves.back());
        swept_boxes.back().first.merge_with(box_around(before, thickness));
      }
    trees = std::make_unique<const Trees>(leaves, swept_boxes);
    walls = std::make_unique<const SurfaceWalls<dim>>(moved, thickness);
  }


  template <int dim>
  SurfaceQueries<dim>::~SurfaceQueries() = default;


  template <int dim>
  typename Obstruction<dim>::Patch
  SurfaceQueries<dim>::patch(const std::vector<FacetImage> &images) const
  {
    return walls->patch(images);
  }


  template <int dim>
  bool
  SurfaceQueries<dim>::is_wall(const std::vector<FacetImage>  &images,
                               const Slab                     &slab,
                               const dealii::BoundingBox<dim> &box) const
  {
    return walls->is_wall(images, slab, box);
  }


  template <int dim>
  double
  SurfaceQueries<dim>::first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const
  {
    double result = nowhere;
    if (trees->facets.empty())
      return result;
    for_each_image<dim>(
      from, to, trees->box, periods, thickness, [&](const auto &start, const auto &end) {
        for_each_near(
          trees->facets, box_around(start, end, thickness), [&](const unsigned int facet) {
            result = std::min(result, thick_facets[facet].first_hit(start, end));
          });
      });
    return result;
  }


  template <int dim>
  double
  SurfaceQueries<dim>::first_hit(const FacetImage         &image,
                                 const dealii::Point<dim> &from,
                                 const dealii::Point<dim> &to) const
  {
    return thick_facets[image.facet].first_hit(from + image.to_facet, to + image.to_facet);
  }


  template <int dim>
  std::vector<typename SurfaceQueries<dim>::FacetImage>
  SurfaceQueries<dim>::facets_near(const dealii::BoundingBox<dim> &box) const
  {
    std::vector<FacetImage> result;
    if (trees->facets.empty())
      return result;
    const auto corners =
      box_around(box.get_boundary_points().first, box.get_boundary_points().second, thickness)
        .get_boundary_points();
    for_each_shift<dim>(
      corners.first, corners.second, trees->box, periods, [&](const dealii::Tensor<1, dim> &shift) {
        const dealii::BoundingBox<dim> moved_box(std::make_pair(
          dealii::Point<dim>(corners.first + shift), dealii::Point<dim>(corners.second + shift)));
        for_each_near(trees->facets, moved_box, [&](const unsigned int facet) {
          result.push_back({facet, shift});
        });
      });
    return result;
  }


  template <int dim>
  bool
  SurfaceQueries<dim>::passes_over(const unsigned int facet, const dealii::Point<dim> &place) const
  {
    const auto                   &numbers = moved.surface->facets()[facet];
    std::array<unsigned int, dim> order;
    for (unsigned int k = 0; k < dim; ++k)
      order[k] = k;
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return numbers[a] < numbers[b];
    });
    return undine::passes_over<dim>(
      moved.old_nodes(facet), moved.nodes(facet), order, place, thickness);
  }


  template <int dim>
  bool
  SurfaceQueries<dim>::is_freshly_cleared(const dealii::Point<dim> &place) const
  {
    bool result = false;
    if (trees->swept.empty())
      return result;
    for_each_image<dim>(
      place, place, trees->swept_box, periods, thickness, [&](const auto &image, const auto &) {
        for_each_near(trees->swept, box_around(image, thickness), [&](const unsigned int facet) {
          result = result || passes_over(facet, image);
        });
      });
    return result;
  }


  /// By the point of the facets that have passed over the place which was nearest to it before.
  template <int dim>
  dealii::Point<dim>
  SurfaceQueries<dim>::carried(const dealii::Point<dim> &place) const
  {
    auto   result = place, surface = place; // carried along, and its nearest point of the surface
    double least = std::numeric_limits<double>::infinity(); // square of the distance
    if (trees->swept.empty())
      return result;
    const auto consider = [&](const unsigned int facet, const dealii::Point<dim> &image) {
      if (!passes_over(facet, image))
        return;
      const auto             before = moved.old_nodes(facet), now = moved.nodes(facet);
      const auto             coordinates = nearest_point(before, image);
      dealii::Point<dim>     nearest;
      dealii::Tensor<1, dim> motion;
      for (unsigned int k = 0; k < dim; ++k)
        {
          nearest += coordinates[k] * before[k];
          motion += coordinates[k] * (now[k] - before[k]);
        }
      const double square = nearest.distance_square(image);
      if (square >= least)
        return;
      least   = square;
      result  = place + motion;
      surface = result + (nearest - image);
    };
    for_each_image<dim>(
      place, place, trees->swept_box, periods, thickness, [&](const auto &image, const auto &) {
        for_each_near(trees->swept, box_around(image, thickness), [&](const unsigned int facet) {
          consider(facet, image);
        });
      });
    // In a gap that closes it stays before the other side.
    constexpr double off  = 1e-3; // of the way from the surface
    const auto       way  = result - surface;
    const double     free = first_hit(surface + off * way, result);
    if (free <= 1)
      result = surface + (off + (1 - off) * free / 2) * way;
    return result;
  }


  template <int dim>
  void
  SurfaceQueries<dim>::for_each_freshly_cleared(
    const Lattice<dim>                                &lattice,
    const IndexBox<dim>                               &box,
    const std::function<void(const GridIndex<dim> &)> &action) const
  {
    if (swept_boxes.empty() || box.empty())
      return;
    auto last = box.upper;
    for (int &index : last.values)
      --index;
    const auto lowest = lattice.point(box.lower), highest = lattice.point(last);
    for (const auto &leaf : swept_boxes)
      for_each_image<dim>(
        lowest, highest, leaf.first, periods, thickness, [&](const auto &image, const auto &) {
          const dealii::Tensor<1, dim> shift = image - lowest;
          IndexBox<dim>                points;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const auto &row = lattice.row(d);
              points.lower[d] = row.locate(leaf.first.lower_bound(d) - shift[d]).lower;
              points.upper[d] = row.locate(leaf.first.upper_bound(d) - shift[d]).lower + 2;
            }
          for_each(points.intersection(box), [&](const GridIndex<dim> &index) {
            const dealii::Point<dim> place = lattice.point(index) + shift;
            if (leaf.first.point_inside(place) && passes_over(leaf.second, place))
              action(index);
          });
        });
  }


  template <int dim>
  typename Obstruction<dim>::NearestPoint
  SurfaceQueries<dim>::nearest_point_to(const dealii::Point<dim> &place) const
  {
    typename Obstruction<dim>::NearestPoint result;
    if (trees->facets.empty())
      return result;
    double     least    = std::numeric_limits<double>::infinity(); // square of the distance
    const auto consider = [&](const unsigned int facet, const dealii::Point<dim> &image) {
      const auto         corners     = moved.nodes(facet);
      const auto         coordinates = nearest_point(corners, image);
      dealii::Point<dim> nearest;
      for (unsigned int k = 0; k < dim; ++k)
        nearest += coordinates[k] * corners[k];
      const double square = nearest.distance_square(image);
      if (square >= least)
        return;
      least             = square;
      const auto &nodes = moved.surface->facets()[facet];
      result            = {};
      result.is_free    = nodes[0] < moved.n_free_nodes;
      for (unsigned int k = 0; k < dim; ++k)
        result.velocity += coordinates[k] * moved.velocities[nodes[k]];
    };

    // The facet with the nearest box bounds the distance of the search.
    namespace index = boost::geometry::index;
    auto reach      = trees->box;
    reach.extend(*std::max_element(periods.begin(), periods.end()));
    for (unsigned int pass = 0; pass < 2; ++pass)
      {
        for_each_shift<dim>(place, place, reach, periods, [&](const dealii::Tensor<1, dim> &shift) {
          const dealii::Point<dim> image = place + shift;
          if (pass == 0)
            trees->facets.query(index::nearest(image, 1),
                                boost::make_function_output_iterator(
                                  [&](const Leaf<dim> &leaf) { consider(leaf.second, image); }));
          else
            for_each_near(trees->facets,
                          box_around(image, std::sqrt(least)),
                          [&](const unsigned int facet) { consider(facet, image); });
        });
        reach = trees->box;
        reach.extend(std::sqrt(least));
      }
    return result;
  }


  template class SurfaceQueries<2>;
  template class SurfaceQueries<3>;
} // namespace undine
