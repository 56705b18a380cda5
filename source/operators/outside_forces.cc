// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/outside_forces.h>
#include <undine/surface/simplex.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace undine
{
  namespace
  {
    /// A part of a facet: its corners, and their barycentric coordinates in the facet.
    template <int dim>
    struct Part
    {
      std::array<dealii::Point<dim>, dim>      corners;
      std::array<std::array<double, dim>, dim> weights;
    };


    /// action(part) for parts that together are `part`, none of which is on both sides of the
    /// plane in which the coordinate along `axis` is `plane`.
    template <int dim, class Action>
    void
    divide(const Part<dim> &part, const unsigned int axis, const double plane, const Action &action)
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


    /// Divides facets along all sides of the domain, and calls action(side, part) for the parts
    /// outside, with a side that they are beyond.
    template <int dim, class Action>
    class OutsideParts
    {
    public:
      OutsideParts(const MacGrid<dim> &grid, const Action &action)
        : grid(grid)
        , action(action)
      {
      }

      void
      of(const Part<dim> &part, const unsigned int number = 0) const
      {
        if (number == 2 * dim)
          return;
        const Side   side{number / 2, number % 2};
        const double plane = side.end == 0 ? grid.lower()[side.axis] : grid.upper()[side.axis];
        if (grid.periodic(side.axis))
          of(part, number + 1);
        else
          divide(part, side.axis, plane, [&](const Part<dim> &piece) {
            double beyond = 0;
            for (const auto &corner : piece.corners)
              beyond += side.sign() * (corner[side.axis] - plane);
            if (beyond >= 0) // no fluid touches what is flush with a side
              action(side, piece);
            else
              of(piece, number + 1);
          });
      }

    private:
      const MacGrid<dim> &grid;
      const Action       &action;
    };


    template <int dim>
    dealii::Point<dim>
    nearest_in_domain(const MacGrid<dim> &grid, dealii::Point<dim> place)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!grid.periodic(d))
          place[d] = std::clamp(place[d], grid.lower()[d], grid.upper()[d]);
      return place;
    }
  } // namespace


  namespace
  {
    /// Where facets are outside of an opening.
    template <int dim>
    struct OutsidePoint
    {
      const std::array<unsigned int, dim> &facet;
      std::array<double, dim>              shape;  ///< N_i of its nodes
      dealii::Tensor<1, dim>               force;  ///< p n dGamma [N]
      Side                                 side;   ///< that it is beyond
      double                               height; ///< along the side's axis, from its plane [m]
    };


    /// action(OutsidePoint) for the points of a quadrature that is exact for quadratic functions.
    template <int dim, class Action>
    void
    for_each_point_outside(const BoundaryMap<dim>                &boundaries,
                           const Surface<dim>                    &surface,
                           const std::vector<dealii::Point<dim>> &positions,
                           const dealii::Tensor<1, dim>          &weight,
                           const double                           time,
                           const Action                          &action)
    {
      if (!boundaries.has_opening())
        return;
      const auto                          &grid = boundaries.grid();
      const dealii::QGaussSimplex<dim - 1> quadrature(2);
      const auto                          &weights = quadrature.get_weights();
      const double area_of_reference = std::accumulate(weights.begin(), weights.end(), 0.);
      for (const auto &facet : surface.facets())
        {
          const auto is_inside = [&](const unsigned int node) {
            for (unsigned int d = 0; d < dim; ++d)
              if (positions[node][d] <= grid.lower()[d] || positions[node][d] >= grid.upper()[d])
                return false;
            return true;
          };
          if (std::all_of(facet.begin(), facet.end(), is_inside))
            continue;
          Part<dim> whole{};
          for (unsigned int k = 0; k < dim; ++k)
            {
              whole.corners[k]    = positions[facet[k]];
              whole.weights[k][k] = 1;
            }
          const auto visit = [&](const Side side, const Part<dim> &part) {
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
                dealii::Point<dim> place;
                for (unsigned int k = 0; k < dim; ++k)
                  place += shares[k] * dealii::Tensor<1, dim>(part.corners[k]);
                const auto  nearest  = nearest_in_domain(grid, place);
                const auto &boundary = boundaries.at(side, nearest);
                if (!boundary.is_open())
                  continue;
                const double pressure = boundary.pressure.value(nearest, time) + weight * nearest;
                OutsidePoint<dim> point{facet,
                                        {},
                                        weights[q] * pressure * into_body,
                                        side,
                                        place[side.axis] - nearest[side.axis]};
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int k = 0; k < dim; ++k)
                    point.shape[i] += shares[k] * part.weights[k][i];
                action(point);
              }
          };
          OutsideParts<dim, decltype(visit)>(grid, visit).of(whole);
        }
    }
  } // namespace


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  outside_forces(const BoundaryMap<dim>                &boundaries,
                 const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const dealii::Tensor<1, dim>          &weight,
                 const double                           time)
  {
    std::vector<dealii::Tensor<1, dim>> forces(surface.n_nodes());
    for_each_point_outside(
      boundaries, surface, positions, weight, time, [&](const OutsidePoint<dim> &point) {
        for (unsigned int i = 0; i < dim; ++i)
          forces[point.facet[i]] += point.shape[i] * point.force;
      });
    return forces;
  }


  template <int dim>
  double
  work_outside(const BoundaryMap<dim>                &boundaries,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions,
               const unsigned int                     n_nodes,
               const dealii::Tensor<1, dim>          &weight,
               const double                           time)
  {
    double work = 0;
    for_each_point_outside(
      boundaries, surface, positions, weight, time, [&](const OutsidePoint<dim> &point) {
        if (point.facet[0] < n_nodes)
          work -= point.height * point.force[point.side.axis];
      });
    return work;
  }


#define INSTANTIATE(dim)                                                \
  template std::vector<dealii::Tensor<1, dim>> outside_forces(          \
    const BoundaryMap<dim> &,                                           \
    const Surface<dim> &,                                               \
    const std::vector<dealii::Point<dim>> &,                            \
    const dealii::Tensor<1, dim> &,                                     \
    double);                                                            \
  template double work_outside(const BoundaryMap<dim> &,                \
                               const Surface<dim> &,                    \
                               const std::vector<dealii::Point<dim>> &, \
                               unsigned int,                            \
                               const dealii::Tensor<1, dim> &,          \
                               double);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
