// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/outside_points.h>
#include <undine/operators/static_pressure.h>

#include <array>

namespace undine
{
  template <int dim>
  double
  work_against(const StaticPressure<dim>             &pressure,
               const MacGrid<dim>                    &grid,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions,
               const unsigned int                     n_nodes)
  {
    // Seen from a corner of the domain, where rounding is least.
    const auto  &origin = grid.lower();
    const double at_origin =
      pressure.at_origin + pressure.gradient * dealii::Tensor<1, dim>(origin);
    double sum = 0; // over all of the bodies
    for (const auto &facet : surface.facets())
      {
        if (facet[0] >= n_nodes)
          continue;
        std::array<dealii::Point<dim>, dim> corners;
        dealii::Tensor<1, dim>              mean;
        for (unsigned int k = 0; k < dim; ++k)
          {
            corners[k] = dealii::Point<dim>(positions[facet[k]] - origin);
            mean += dealii::Tensor<1, dim>(corners[k]) / dim;
          }
        sum +=
          mean * area_vector(corners) * (at_origin / dim + pressure.gradient * mean / (dim + 1));
      }
    for_each_point_outside(grid, surface, positions, n_nodes, [&](const OutsidePoint<dim> &point) {
      // From the plane of the side to the point the pressure is in the mean that in the middle.
      const unsigned int axis   = point.sides.front().axis;
      auto               middle = point.place;
      middle[axis] -= point.height() / 2;
      sum += point.into_body[axis] * point.height() *
             (pressure.at_origin + pressure.gradient * dealii::Tensor<1, dim>(middle));
    });
    return sum;
  }


#define INSTANTIATE(dim)                                                \
  template double work_against(const StaticPressure<dim> &,             \
                               const MacGrid<dim> &,                    \
                               const Surface<dim> &,                    \
                               const std::vector<dealii::Point<dim>> &, \
                               unsigned int);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
