// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_outside_points_h
#define undine_operators_outside_points_h

#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace undine
{
  /// A point of a quadrature over what of a surface is outside of the domain.
  template <int dim>
  struct OutsidePoint
  {
    const std::array<unsigned int, dim> &facet;
    std::array<double, dim>              shape;     ///< N_i of the facet's nodes
    dealii::Point<dim>                   place;     ///< [m]
    dealii::Point<dim>                   nearest;   ///< in the domain [m]
    dealii::Tensor<1, dim>               into_body; ///< n dGamma [m^(dim-1)]
    std::vector<Side>                    sides;     ///< that it is beyond or flush with

    /// Along the axis of the first of these sides, from its plane, in the direction of the axis
    /// [m].
    double
    height() const
    {
      return place[sides.front().axis] - nearest[sides.front().axis];
    }
  };


  /// A part of a facet: its corners, and their barycentric coordinates in the facet.
  template <int dim>
  struct FacetPart
  {
    std::array<dealii::Point<dim>, dim>      corners;
    std::array<std::array<double, dim>, dim> weights;
  };


  /// action(part) for parts that together are `part`, none of which is on both sides of the plane
  /// in which the coordinate along `axis` is `plane`.
  template <int dim, class Action>
  void
  divide(const FacetPart<dim> &part,
         const unsigned int    axis,
         const double          plane,
         const Action         &action)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < i; ++j)
        {
          const double at_i = part.corners[i][axis] - plane;
          const double at_j = part.corners[j][axis] - plane;
          if (at_i * at_j >= 0)
            continue;
          const double       share = at_i / (at_i - at_j); // of j
          dealii::Point<dim> between;
          for (unsigned int d = 0; d < dim; ++d)
            between[d] = part.corners[i][d] + share * (part.corners[j][d] - part.corners[i][d]);
          between[axis] = plane;
          std::array<double, dim> weights;
          for (unsigned int k = 0; k < dim; ++k)
            weights[k] = (1 - share) * part.weights[i][k] + share * part.weights[j][k];
          for (const unsigned int replaced : {i, j})
            {
              auto half              = part;
              half.corners[replaced] = between;
              half.weights[replaced] = weights;
              divide(half, axis, plane, action);
            }
          return;
        }
    action(part);
  }


  /// Divides facets along all sides of the domain.
  template <int dim>
  class OutsideParts
  {
  public:
    explicit OutsideParts(const MacGrid<dim> &grid)
      : grid(grid)
    {
    }

    /// action(part, sides) for the parts outside, with the sides that they are beyond. What is
    /// flush with a side is outside: the fluid inside does not reach it.
    template <class Action>
    void
    visit(const FacetPart<dim>    &part,
          const Action            &action,
          const unsigned int       number = 0,
          const std::vector<Side> &beyond = {}) const
    {
      if (number == 2 * dim)
        {
          if (!beyond.empty())
            action(part, beyond);
          return;
        }
      const Side side{number / 2, number % 2};
      if (grid.periodic(side.axis))
        return visit(part, action, number + 1, beyond);
      const double plane = side.end == 0 ? grid.lower()[side.axis] : grid.upper()[side.axis];
      divide(part, side.axis, plane, [&](const FacetPart<dim> &piece) {
        double height = 0;
        for (const auto &corner : piece.corners)
          height += side.sign() * (corner[side.axis] - plane);
        auto sides = beyond;
        if (height >= 0)
          sides.push_back(side);
        visit(piece, action, number + 1, sides);
      });
    }

  private:
    const MacGrid<dim> &grid;
  };


  /// action(OutsidePoint) for the points of a quadrature, exact for quadratic functions of places
  /// and nearest places, over what is outside of the facets of the first `n_nodes` nodes, which are
  /// at `positions` [m].
  template <int dim, class Action>
  void
  for_each_point_outside(const MacGrid<dim>                    &grid,
                         const Surface<dim>                    &surface,
                         const std::vector<dealii::Point<dim>> &positions,
                         const unsigned int                     n_nodes,
                         const Action                          &action)
  {
    const auto is_inside = [&](const unsigned int node) {
      for (unsigned int d = 0; d < dim; ++d)
        if (positions[node][d] <= grid.lower()[d] || positions[node][d] >= grid.upper()[d])
          return false;
      return true;
    };
    const dealii::QGaussSimplex<dim - 1> quadrature(2);
    const auto                          &weights = quadrature.get_weights();
    const double            area_of_reference = std::accumulate(weights.begin(), weights.end(), 0.);
    const OutsideParts<dim> parts(grid);
    for (const auto &facet : surface.facets())
      {
        if (facet[0] >= n_nodes || std::all_of(facet.begin(), facet.end(), is_inside))
          continue;
        FacetPart<dim> whole{};
        for (unsigned int k = 0; k < dim; ++k)
          {
            whole.corners[k]    = positions[facet[k]];
            whole.weights[k][k] = 1;
          }
        parts.visit(whole, [&](const FacetPart<dim> &part, const std::vector<Side> &sides) {
          const auto into_body = -area_vector(part.corners) / area_of_reference;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              std::array<double, dim> shares; // of the part's corners
              shares[0] = 1;
              for (unsigned int k = 1; k < dim; ++k)
                {
                  shares[k] = quadrature.point(q)[k - 1];
                  shares[0] -= shares[k];
                }
              OutsidePoint<dim> point{facet, {}, {}, {}, weights[q] * into_body, sides};
              for (unsigned int k = 0; k < dim; ++k)
                {
                  point.place += shares[k] * dealii::Tensor<1, dim>(part.corners[k]);
                  for (unsigned int i = 0; i < dim; ++i)
                    point.shape[i] += shares[k] * part.weights[k][i];
                }
              point.nearest = point.place;
              for (unsigned int d = 0; d < dim; ++d)
                if (!grid.periodic(d))
                  point.nearest[d] = std::clamp(point.place[d], grid.lower()[d], grid.upper()[d]);
              action(point);
            }
        });
      }
  }
} // namespace undine

#endif
