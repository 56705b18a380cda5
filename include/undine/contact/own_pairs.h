// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_own_pairs_h
#define undine_contact_own_pairs_h

#include <undine/contact/activation_distances.h>

#include <utility>
#include <vector>

namespace undine
{
  /// Parts of bodies' own surfaces that may be in contact with each other.
  struct OwnPairsNearby
  {
    using Pairs = std::vector<std::pair<unsigned int, unsigned int>>;

    Pairs facets;   ///< nodes with facets that they meet, in ascending order
    Pairs left_out; ///< the same nodes with those that they do not meet
    Pairs edges;    ///< sharp edges that meet, by their numbers in ContactSurfaces::sharp_edges()
  };

  /// Finds them. What has been found is found again without a search as long as no node has moved
  /// far against the mean of its body: undeformed bodies cost next to nothing. That it is more than
  /// what is in contact at a time changes no result.
  template <int dim>
  class OwnPairs
  {
  public:
    using Positions = typename ContactSurfaces<dim>::Positions;

    /// The references must outlive it.
    OwnPairs(const ContactSurfaces<dim> &surfaces, const ActivationDistances<dim> &distances)
      : surfaces(surfaces)
      , distances(distances)
    {
    }

    /// All pairs that come nearer to each other than their activation distance on the straight
    /// paths of all nodes from `from` to `to` [m], and others.
    const OwnPairsNearby &
    nearby(const Positions &from, const Positions &to) const;

  private:
    bool
    is_known(const Positions &places, double margin) const;
    void
    search(const Positions &from, const Positions &to, double distance) const;

    const ContactSurfaces<dim>     &surfaces;
    const ActivationDistances<dim> &distances;
    mutable Positions               searched_at; ///< empty: nowhere
    mutable OwnPairsNearby          found;
  };
} // namespace undine

#endif
