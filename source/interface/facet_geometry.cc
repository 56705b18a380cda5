// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/facet_geometry.h>
#include <undine/interface/simplex.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// The part of a way that is left after cutting off half-spaces.
    class ClippedWay
    {
    public:
      /// Keep what has a distance <= 0 from a plane, given the distances of both ends of the way.
      /// False if nothing is left.
      bool
      keep_behind(const double at_start, const double at_end)
      {
        if (at_start > 0 && at_end > 0)
          return false;
        if (at_start > 0)
          enter = std::max(enter, at_start / (at_start - at_end));
        else if (at_end > 0)
          leave = std::min(leave, at_start / (at_start - at_end));
        return enter <= leave;
      }

      double enter = 0, leave = 1;
    };


    /// A ridge of a facet, and the direction in the facet's plane that points out across it.
    template <int dim>
    struct Rim
    {
      dealii::Point<dim>     place;
      dealii::Tensor<1, dim> outward; ///< unit
    };

    std::array<Rim<2>, 2>
    rims(const FacetNodes<2> &facet, const dealii::Tensor<1, 2> &)
    {
      auto way = facet[1] - facet[0];
      way /= way.norm();
      return {{{facet[0], -way}, {facet[1], way}}};
    }

    std::array<Rim<3>, 3>
    rims(const FacetNodes<3> &facet, const dealii::Tensor<1, 3> &normal)
    {
      std::array<Rim<3>, 3> result;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const auto way    = facet[(k + 1) % 3] - facet[k];
          result[k].place   = facet[k];
          result[k].outward = dealii::cross_product_3d(way, normal);
          result[k].outward /= result[k].outward.norm();
        }
      return result;
    }


    /// The part of a way that lies in the box around a facet, widened by `thickness`.
    template <int dim>
    bool
    clip_by_box(ClippedWay               &way,
                const FacetNodes<dim>    &facet,
                const dealii::Point<dim> &from,
                const dealii::Point<dim> &to,
                const double              thickness)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          double lower = facet[0][d], upper = lower;
          for (const auto &node : facet)
            {
              lower = std::min(lower, node[d]);
              upper = std::max(upper, node[d]);
            }
          if (!way.keep_behind(lower - thickness - from[d], lower - thickness - to[d]) ||
              !way.keep_behind(from[d] - upper - thickness, to[d] - upper - thickness))
            return false;
        }
      return true;
    }


    /// The point of a segment nearest to a place, as share of the way from a to b.
    template <int dim>
    double
    nearest_share(const dealii::Point<dim> &a,
                  const dealii::Point<dim> &b,
                  const dealii::Point<dim> &place)
    {
      const auto   way    = b - a;
      const double square = way.norm_square();
      return square > 0 ? std::clamp((place - a) * way / square, 0., 1.) : 0.;
    }


    template <int dim>
    dealii::Point<dim>
    point(const FacetNodes<dim> &facet, const std::array<double, dim> &coordinates)
    {
      dealii::Point<dim> result;
      for (unsigned int k = 0; k < dim; ++k)
        result += coordinates[k] * facet[k];
      return result;
    }


    /// Barycentric coordinates of the projection onto a triangle's plane; false if it has none.
    bool
    project(std::array<double, 3>  &coordinates,
            const FacetNodes<3>    &facet,
            const dealii::Point<3> &x)
    {
      const auto   a = facet[1] - facet[0], b = facet[2] - facet[0], c = x - facet[0];
      const auto   normal = dealii::cross_product_3d(a, b);
      const double square = normal.norm_square();
      if (!(square > 0))
        return false;
      coordinates[1] = dealii::cross_product_3d(c, b) * normal / square;
      coordinates[2] = dealii::cross_product_3d(a, c) * normal / square;
      coordinates[0] = 1 - coordinates[1] - coordinates[2];
      return true;
    }


    /// (dim)! times the volume of a simplex, with a sign.
    template <int dim>
    double
    volume_form(const std::array<dealii::Point<dim>, dim + 1> &corners)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int k = 0; k < dim; ++k)
        edges[k] = corners[k + 1] - corners[0];
      return determinant(edges);
    }


    template <int dim>
    bool
    lies_in(const std::array<dealii::Point<dim>, dim + 1> &simplex,
            const dealii::Point<dim>                      &place,
            const double                                   thickness)
    {
      const double volume  = volume_form<dim>(simplex);
      bool         inside  = true;
      double       largest = 0;
      for (unsigned int k = 0; k <= dim; ++k)
        {
          FacetNodes<dim> opposite;
          for (unsigned int i = 0; i < dim; ++i)
            opposite[i] = simplex[i < k ? i : i + 1];
          // The form is the distance from this side times its area times (dim - 1)!.
          const double unit = (dim - 1) * area_vector(opposite).norm();
          auto         part = simplex;
          part[k]           = place;
          inside  = inside && (volume > 0 ? 1 : -1) * volume_form<dim>(part) >= -thickness * unit;
          largest = std::max(largest, unit);
        }
      return inside && std::abs(volume) > thickness * largest;
    }
  } // namespace


  template <int dim>
  double
  first_hit(const FacetNodes<dim>    &facet,
            const dealii::Point<dim> &from,
            const dealii::Point<dim> &to,
            const double              thickness)
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    ClippedWay       in_box;
    if (!clip_by_box<dim>(in_box, facet, from, to, thickness))
      return nowhere;
    auto         normal = area_vector(facet);
    const double area   = normal.norm();
    if (!(area > 0))
      return nowhere;
    normal /= area;

    // Distances of places near the facet: of far ends of a long way they would lose digits.
    const dealii::Point<dim> start = from + in_box.enter * (to - from);
    const dealii::Point<dim> end   = from + in_box.leave * (to - from);
    ClippedWay               way;
    const double             a = normal * (start - facet[0]), b = normal * (end - facet[0]);
    if (!way.keep_behind(a - thickness, b - thickness) ||
        !way.keep_behind(-a - thickness, -b - thickness))
      return nowhere;
    for (const auto &rim : rims(facet, normal))
      if (!way.keep_behind(rim.outward * (start - rim.place) - thickness,
                           rim.outward * (end - rim.place) - thickness))
        return nowhere;
    return in_box.enter + way.enter * (in_box.leave - in_box.enter);
  }


  std::array<double, 2>
  nearest_point(const FacetNodes<2> &facet, const dealii::Point<2> &place)
  {
    const double share = nearest_share(facet[0], facet[1], place);
    return {{1 - share, share}};
  }


  std::array<double, 3>
  nearest_point(const FacetNodes<3> &facet, const dealii::Point<3> &place)
  {
    std::array<double, 3> result;
    if (project(result, facet, place) && *std::min_element(result.begin(), result.end()) >= 0)
      return result;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned int k = 0; k < 3; ++k)
      {
        std::array<double, 3> on_edge{};
        const double          share = nearest_share(facet[k], facet[(k + 1) % 3], place);
        on_edge[k]                  = 1 - share;
        on_edge[(k + 1) % 3]        = share;
        const double square         = place.distance_square(point<3>(facet, on_edge));
        if (square < least)
          {
            least  = square;
            result = on_edge;
          }
      }
    return result;
  }


  template <int dim>
  bool
  passes_over(const FacetNodes<dim>               &before,
              const FacetNodes<dim>               &after,
              const std::array<unsigned int, dim> &order,
              const dealii::Point<dim>            &place,
              const double                         thickness)
  {
    for (unsigned int k = 0; k < dim; ++k)
      {
        std::array<dealii::Point<dim>, dim + 1> simplex;
        for (unsigned int i = 0; i <= k; ++i)
          simplex[i] = before[order[i]];
        for (unsigned int i = k; i < dim; ++i)
          simplex[i + 1] = after[order[i]];
        if (lies_in<dim>(simplex, place, thickness))
          return true;
      }
    return false;
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template double first_hit<dim>(const FacetNodes<dim> &, const dealii::Point<dim> &,                   \
                            const dealii::Point<dim> &, const double);                             \
  template bool passes_over<dim>(const FacetNodes<dim> &, const FacetNodes<dim> &,                      \
                            const std::array<unsigned int, dim> &, const dealii::Point<dim> &,     \
                            const double);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
