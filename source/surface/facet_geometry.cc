// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/facet_geometry.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// The part of a segment that is left after cutting off half-spaces.
    class ClippedSegment
    {
    public:
      /// Keep what has a distance <= 0 from a plane, given the distances of both ends of the
      /// segment. False if nothing is left.
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


    /// The point of a segment from a to b nearest to a place, as share of the segment.
    template <int dim>
    double
    nearest_share(const dealii::Point<dim> &a,
                  const dealii::Point<dim> &b,
                  const dealii::Point<dim> &place)
    {
      const auto   segment = b - a;
      const double square  = segment.norm_square();
      return square > 0 ? std::clamp((place - a) * segment / square, 0., 1.) : 0.;
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


  template <>
  void
  ThickFacet<2>::set_rims(const FacetNodes<2> &nodes)
  {
    auto segment = nodes[1] - nodes[0];
    segment /= segment.norm();
    rims = {{{nodes[0], -segment}, {nodes[1], segment}}};
  }


  template <>
  void
  ThickFacet<3>::set_rims(const FacetNodes<3> &nodes)
  {
    for (unsigned int k = 0; k < 3; ++k)
      {
        const auto segment = nodes[(k + 1) % 3] - nodes[k];
        rims[k].place      = nodes[k];
        rims[k].outward    = dealii::cross_product_3d(segment, normal);
        rims[k].outward /= rims[k].outward.norm();
      }
  }


  template <int dim>
  ThickFacet<dim>::ThickFacet(const FacetNodes<dim> &nodes, const double thickness_)
    : thickness(thickness_)
    , lower(nodes[0])
    , upper(nodes[0])
    , in_plane(nodes[0])
    , normal(area_vector(nodes))
  {
    for (const auto &node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], node[d]);
          upper[d] = std::max(upper[d], node[d]);
        }
    const double area = normal.norm();
    has_area          = area > 0;
    if (!has_area)
      return;
    normal /= area;
    set_rims(nodes);
  }


  template <int dim>
  double
  ThickFacet<dim>::first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    // Most segments stay on one side of its plane. Ends far away lose digits: those in doubt go on.
    const double above_start = normal * (from - in_plane), above_end = normal * (to - in_plane);
    const double doubt = thickness + 1e-12 * (std::abs(above_start) + std::abs(above_end));
    if (std::min(above_start, above_end) > doubt || std::max(above_start, above_end) < -doubt)
      return nowhere;
    ClippedSegment in_box;
    for (unsigned int d = 0; d < dim; ++d)
      if (!in_box.keep_behind(lower[d] - thickness - from[d], lower[d] - thickness - to[d]) ||
          !in_box.keep_behind(from[d] - upper[d] - thickness, to[d] - upper[d] - thickness))
        return nowhere;
    if (!has_area)
      return nowhere;

    // Distances of places near the facet: those of the ends of a long segment would lose digits.
    const dealii::Point<dim> start = from + in_box.enter * (to - from);
    const dealii::Point<dim> end   = from + in_box.leave * (to - from);
    ClippedSegment           segment;
    const double             a = normal * (start - in_plane), b = normal * (end - in_plane);
    if (!segment.keep_behind(a - thickness, b - thickness) ||
        !segment.keep_behind(-a - thickness, -b - thickness))
      return nowhere;
    for (const auto &rim : rims)
      if (!segment.keep_behind(rim.outward * (start - rim.place) - thickness,
                               rim.outward * (end - rim.place) - thickness))
        return nowhere;
    return in_box.enter + segment.enter * (in_box.leave - in_box.enter);
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
  template class ThickFacet<dim>;                                                                    \
  template bool passes_over<dim>(const FacetNodes<dim> &, const FacetNodes<dim> &,                      \
                            const std::array<unsigned int, dim> &, const dealii::Point<dim> &,     \
                            const double);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
