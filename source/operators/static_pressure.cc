// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/static_pressure.h>
#include <undine/surface/simplex.h>

#include <algorithm>
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
    double sum = 0;
    for (const auto &facet : surface.facets())
      {
        if (facet[0] >= n_nodes)
          continue;
        std::array<dealii::Point<dim>, dim> corners;
        dealii::Tensor<1, dim>              mean;
        for (unsigned int k = 0; k < dim; ++k)
          {
            for (unsigned int d = 0; d < dim; ++d)
              corners[k][d] =
                std::clamp(positions[facet[k]][d], grid.lower()[d], grid.upper()[d]) - origin[d];
            mean += dealii::Tensor<1, dim>(corners[k]) / dim;
          }
        sum +=
          mean * area_vector(corners) * (at_origin / dim + pressure.gradient * mean / (dim + 1));
      }
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
