// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_find_overlap_h
#define undine_contact_find_overlap_h

#include <undine/contact/activation_distances.h>
#include <undine/contact/contact_surfaces.h>

#include <functional>
#include <optional>
#include <string>

namespace undine
{
  /// A node in a surface that is not its own.
  struct NodeInSurface
  {
    unsigned int node, surface;
  };

  /// The first node that lies in another surface, deeper than `depth` [m] (negative: closer to it
  /// than that from outside), with its nodes at `places` [m]; of the pairs of surfaces only those
  /// that counts(surface, other) names.
  template <int dim>
  std::optional<NodeInSurface>
  find_surfaces_that_overlap(const ContactSurfaces<dim>                            &surfaces,
                             const typename ContactSurfaces<dim>::Positions        &places,
                             double                                                 depth,
                             const std::function<bool(unsigned int, unsigned int)> &counts);

  /// What overlaps with its nodes at `places` [m], and where: a body that is not on the free side
  /// of a wall, or two surfaces, or a body that passes through itself or touches itself. Empty if
  /// nothing does.
  template <int dim>
  std::string
  find_overlap(const ContactSurfaces<dim>                     &surfaces,
               const ActivationDistances<dim>                 &distances,
               const typename ContactSurfaces<dim>::Positions &places);
} // namespace undine

#endif
