// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_held_pairs_h
#define undine_surface_held_pairs_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// One of several surfaces by itself; nodes keep their numbers. `surface`: its number in
  /// all.body_names().
  template <int dim>
  Surface<dim>
  one_surface(const Surface<dim> &all, unsigned int surface);


  /// Nodes at which a support fixes a body, in one direction at least.
  template <int dim>
  std::vector<unsigned int>
  fixed_nodes(const SolidModel<dim> &solid, const BodySurface<dim> &bodies);


  /// Gaps that are nothing but rounding of places: 1e-9 of the mean extent of facets [m].
  template <int dim>
  double
  rounding_of_places(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions);


  /// Numbers of two surfaces, the lower first.
  using PairOfSurfaces = std::array<unsigned int, 2>;

  /// The pairs of which one is held in the other: a node of `fixed` lies in it, or outside it by no
  /// more than `reach` [m] (negative: inside it by more than that), with all nodes at `rest`.
  /// Ascending.
  template <int dim>
  std::vector<PairOfSurfaces>
  held_pairs(const Surface<dim>                    &all,
             const std::vector<unsigned int>       &fixed,
             const std::vector<dealii::Point<dim>> &rest,
             double                                 reach);
} // namespace undine

#endif
