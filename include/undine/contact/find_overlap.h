// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_find_overlap_h
#define undine_contact_find_overlap_h

#include <undine/contact/activation_distances.h>
#include <undine/contact/contact_surfaces.h>

#include <string>

namespace undine
{
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
