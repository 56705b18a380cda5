// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_outside_forces_h
#define undine_operators_outside_forces_h

#include <undine/fluid/boundary/boundary_map.h>
#include <undine/surface/surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// The forces in the nodes of surfaces [nodes] [N] of what is outside of the domain, where bodies
  /// reach out of it through openings:
  ///
  ///     f_i = int p N_i n dGamma,    p(x) = P(x', t) + weight.x'    [Pa]    (I11)
  ///
  /// over what is outside, with n into the body, the nearest point x' of the domain, and the
  /// reduced pressure P given there. The pressure is continuous where bodies pass an opening,
  /// whatever its level, and along it that of the fluid at rest; beyond walls and inflows alone
  /// there is none. What is flush with an opening is outside. `weight` rho g [Pa/m]; nodes at
  /// `positions` [m]; at `time` [s]. The same on all ranks, not collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  outside_forces(const BoundaryMap<dim>                &boundaries,
                 const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const dealii::Tensor<1, dim>          &weight,
                 double                                 time);

  /// The same by facets: for the k-th node of each the factor of the facet's area vector, out of
  /// the body, [facet * dim + k] [Pa]. As it has to be where areas change in a step.
  template <int dim>
  std::vector<double>
  outside_pressures_on_facets(const BoundaryMap<dim>                &boundaries,
                              const Surface<dim>                    &surface,
                              const std::vector<dealii::Point<dim>> &positions,
                              const dealii::Tensor<1, dim>          &weight,
                              double                                 time);

  /// The work that it takes to bring bodies out there against that pressure, int p dV over what of
  /// them is outside [J]: since p does not depend on the distance s from a side, by the divergence
  /// theorem a sum over facets,
  ///
  ///     int s p N.e dGamma,
  ///
  /// with N out of the body and the direction e in which s grows; of what is beyond two sides s is
  /// that from the first. Only the first `n_nodes` nodes and the facets between them count.
  template <int dim>
  double
  work_outside(const BoundaryMap<dim>                &boundaries,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions,
               unsigned int                           n_nodes,
               const dealii::Tensor<1, dim>          &weight,
               double                                 time);
} // namespace undine

#endif
