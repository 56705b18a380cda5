// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/nearest_of_edges.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    template <int dim>
    NearestOfEdges<dim>
    at_parts(const std::array<dealii::Point<dim>, 4> &x, const double first, const double second)
    {
      NearestOfEdges<dim> result;
      result.parts    = {{first, second}};
      result.inside   = {{first > 0 && first<1, second> 0 && second < 1}};
      result.from     = x[0] + first * (x[1] - x[0]) - (x[2] + second * (x[3] - x[2]));
      result.distance = result.from.norm();
      return result;
    }


    /// The point of the segment from `begin` to `end` nearest to a place, as part of the segment
    /// [1].
    template <int dim>
    double
    nearest_part(const dealii::Point<dim> &begin,
                 const dealii::Point<dim> &end,
                 const dealii::Point<dim> &place)
    {
      const auto   segment = end - begin;
      const double square  = segment * segment;
      return square > 0 ? std::clamp(segment * (place - begin) / square, 0., 1.) : 0.;
    }
  } // namespace


  template <int dim>
  NearestOfEdges<dim>
  nearest_of_edges(const std::array<dealii::Point<dim>, 4> &x)
  {
    const auto   u = x[1] - x[0], v = x[3] - x[2], between = x[0] - x[2];
    const double uu = u * u, uv = u * v, vv = v * v, ub = u * between, vb = v * between;
    const double determinant = uu * vv - uv * uv;
    if (determinant > 1e-12 * uu * vv)
      {
        const auto result =
          at_parts(x, (uv * vb - vv * ub) / determinant, (uu * vb - uv * ub) / determinant);
        if (result.inside[0] && result.inside[1])
          return result;
      }
    // The square of the distance is convex: its least value is at an end of one of both.
    auto result = at_parts(x, 0, nearest_part(x[2], x[3], x[0]));
    for (const auto &other : {at_parts(x, 1, nearest_part(x[2], x[3], x[1])),
                              at_parts(x, nearest_part(x[0], x[1], x[2]), 0),
                              at_parts(x, nearest_part(x[0], x[1], x[3]), 1)})
      if (other.distance < result.distance)
        result = other;
    return result;
  }


  template NearestOfEdges<2>
  nearest_of_edges(const std::array<dealii::Point<2>, 4> &);
  template NearestOfEdges<3>
  nearest_of_edges(const std::array<dealii::Point<3>, 4> &);
} // namespace undine
