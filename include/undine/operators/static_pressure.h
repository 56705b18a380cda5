// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_static_pressure_h
#define undine_operators_static_pressure_h

#include <undine/fluid/grid/mac_grid.h>
#include <undine/surface/surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// The pressure of a fluid at rest, which is linear in space.
  template <int dim>
  struct StaticPressure
  {
    double                 at_origin = 0; ///< [Pa]
    dealii::Tensor<1, dim> gradient;      ///< rho g [Pa/m]
  };


  /// The work that it takes to bring bodies into the fluid against that pressure [J]: its integral
  /// over their volume within the domain, by the divergence theorem a sum over facets whose nodes
  /// are at `positions` [m],
  ///
  ///     int (p + c.x) dV = sum x.N (p / dim + c.x / (dim + 1)),
  ///
  /// x being the mean of the facet's nodes and N its area vector, less the same over what is
  /// outside. Only the first `n_nodes` nodes and the facets between them count.
  template <int dim>
  double
  work_against(const StaticPressure<dim>             &pressure,
               const MacGrid<dim>                    &grid,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions,
               unsigned int                           n_nodes);
} // namespace undine

#endif
