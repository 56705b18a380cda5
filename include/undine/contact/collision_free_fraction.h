// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_collision_free_fraction_h
#define undine_contact_collision_free_fraction_h

#include <undine/contact/activation_distances.h>
#include <undine/contact/contact_surfaces.h>
#include <undine/contact/own_pairs.h>

namespace undine
{
  /// The largest fraction of the straight paths of all nodes, from the places `from` to the places
  /// `to` [m], on which no gap closes to less than a fifth of what it was or, if that is less, than
  /// half of its activation distance; between 0 and 1 [1]. `nearby`: as OwnPairs finds it for these
  /// paths.
  template <int dim>
  double
  collision_free_fraction(const ContactSurfaces<dim>                     &surfaces,
                          const ActivationDistances<dim>                 &distances,
                          const OwnPairsNearby                           &nearby,
                          const typename ContactSurfaces<dim>::Positions &from,
                          const typename ContactSurfaces<dim>::Positions &to);
} // namespace undine

#endif
