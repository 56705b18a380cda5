// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/divided_facet.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace undine
{
  namespace
  {
    /// The division of a triangle.
    class Triangulation
    {
    public:
      using Edge = std::array<unsigned int, 2>;

      /// Edges that pass a point by less than `rounding`, in coordinates, are not taken in.
      Triangulation(const FacetWithPoints<3> &facet, const double rounding)
        : points(facet.points)
        , rounding(rounding)
        , is_edge(points.size(), std::vector<bool>(points.size(), false))
      {
        for (const auto &line : facet.lines)
          if (!on_one_side(line[0], line[1]))
            take(line);
        for (unsigned int side = 0; side < 3; ++side)
          add_side(side);
        add_shortest();
      }

      /// Those of mutual neighbours without a point between them.
      std::vector<std::array<unsigned int, 3>>
      triangles() const
      {
        std::vector<std::array<unsigned int, 3>> result;
        const unsigned int                       n = points.size();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = a + 1; b < n; ++b)
            for (unsigned int c = b + 1; is_edge[a][b] && c < n; ++c)
              if (is_edge[b][c] && is_edge[a][c] && is_empty(a, b, c))
                result.push_back(turn(a, b, c) > 0 ? std::array<unsigned int, 3>{{a, b, c}}
                                                   : std::array<unsigned int, 3>{{a, c, b}});
        // By Euler's formula, with n_on_sides points on the rim.
        return result.size() + n_on_sides + 2 == 2 * n ? result : decltype(result)();
      }

    private:
      /// Twice the area of a triangle in the plane of the coordinates, counter-clockwise positive;
      /// the same to the bit, but for the sign, in whatever order the points are given.
      double
      turn(unsigned int a, unsigned int b, unsigned int c) const
      {
        double     sign     = 1;
        const auto in_order = [&](unsigned int &low, unsigned int &high) {
          if (low > high)
            {
              std::swap(low, high);
              sign = -sign;
            }
        };
        in_order(a, b);
        in_order(b, c);
        in_order(a, b);
        const auto &p = points[a], &q = points[b], &r = points[c];
        return sign * ((q[1] - p[1]) * (r[2] - p[2]) - (q[2] - p[2]) * (r[1] - p[1]));
      }

      bool
      on_one_side(const unsigned int a, const unsigned int b) const
      {
        bool result = false;
        for (unsigned int side = 0; side < 3; ++side)
          result = result || (points[a][side] == 0 && points[b][side] == 0);
        return result;
      }

      bool
      is_empty(const unsigned int a, const unsigned int b, const unsigned int c) const
      {
        const bool left = turn(a, b, c) > 0;
        for (unsigned int p = 0; p < points.size(); ++p)
          if (p != a && p != b && p != c && (turn(a, b, p) > 0) == left &&
              (turn(b, c, p) > 0) == left && (turn(c, a, p) > 0) == left)
            return false;
        return true;
      }

      bool
      crosses(const Edge &a, const Edge &b) const
      {
        for (const unsigned int end : a)
          if (end == b[0] || end == b[1])
            return false;
        return (turn(a[0], a[1], b[0]) > 0) != (turn(a[0], a[1], b[1]) > 0) &&
               (turn(b[0], b[1], a[0]) > 0) != (turn(b[0], b[1], a[1]) > 0);
      }

      /// Does a point lie on the edge, but for rounding?
      bool
      passes_a_point(const Edge &edge) const
      {
        const auto along = [&](const unsigned int p) {
          const auto &from = points[edge[0]], &to = points[edge[1]];
          return (to[1] - from[1]) * (points[p][1] - from[1]) +
                 (to[2] - from[2]) * (points[p][2] - from[2]);
        };
        const double square = along(edge[1]);
        for (unsigned int p = 0; p < points.size(); ++p)
          if (p != edge[0] && p != edge[1] && along(p) > 0 && along(p) < square &&
              std::abs(turn(edge[0], edge[1], p)) <= rounding * std::sqrt(square))
            return true;
        return false;
      }

      void
      take(const Edge &edge)
      {
        edges.push_back(edge);
        is_edge[edge[0]][edge[1]] = is_edge[edge[1]][edge[0]] = true;
      }

      /// The side on which a coordinate is zero.
      void
      add_side(const unsigned int side)
      {
        std::vector<unsigned int> on_side;
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points[p][side] == 0)
            on_side.push_back(p);
        const unsigned int along = (side + 1) % 3;
        std::sort(on_side.begin(), on_side.end(), [&](const unsigned int p, const unsigned int q) {
          return points[p][along] < points[q][along];
        });
        for (std::size_t k = 0; k + 1 < on_side.size(); ++k)
          take({{on_side[k], on_side[k + 1]}});
        n_on_sides += on_side.size() - 1;
      }

      void
      add_shortest()
      {
        std::vector<std::tuple<double, Edge>> candidates;
        for (unsigned int a = 0; a < points.size(); ++a)
          for (unsigned int b = a + 1; b < points.size(); ++b)
            if (!is_edge[a][b] && !on_one_side(a, b) && !passes_a_point({{a, b}}))
              {
                double square = 0;
                for (unsigned int k = 0; k < 3; ++k)
                  square += (points[a][k] - points[b][k]) * (points[a][k] - points[b][k]);
                candidates.push_back({square, {{a, b}}});
              }
        std::sort(candidates.begin(), candidates.end());
        for (const auto &candidate : candidates)
          if (const auto &edge = std::get<1>(candidate);
              std::none_of(edges.begin(), edges.end(), [&](const Edge &other) {
                return crosses(edge, other);
              }))
            take(edge);
      }

      const std::vector<std::array<double, 3>> &points;
      const double                              rounding;
      std::vector<std::vector<bool>>            is_edge; ///< between two points
      std::vector<Edge>                         edges;
      std::size_t                               n_on_sides = 0;
    };
  } // namespace


  std::vector<std::array<unsigned int, 2>>
  divided(const FacetWithPoints<2> &facet)
  {
    std::vector<unsigned int> order(facet.points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](const unsigned int p, const unsigned int q) {
      return facet.points[p][1] < facet.points[q][1];
    });
    std::vector<std::array<unsigned int, 2>> result;
    for (std::size_t k = 0; k + 1 < order.size(); ++k)
      result.push_back({{order[k], order[k + 1]}});
    return result;
  }


  std::vector<std::array<unsigned int, 3>>
  divided(const FacetWithPoints<3> &facet)
  {
    // Points on a line need edges that pass them, or none: it depends on what is beside the line.
    auto result = Triangulation(facet, 1e-11).triangles();
    return result.empty() ? Triangulation(facet, -1).triangles() : result;
  }
} // namespace undine
