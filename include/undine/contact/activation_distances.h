// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_activation_distances_h
#define undine_contact_activation_distances_h

#include <undine/contact/contact_surfaces.h>

#include <vector>

namespace undine
{
  /// Below which distance contact acts. Between different surfaces, and with walls, it is D of the
  /// scene. Where surfaces belong together from the start it is less, so that nothing acts at rest:
  /// with the own surface, and with walls at which the body ends,
  ///
  ///     D_i = min(D, r_i / 2)                                                               (S19)
  ///
  /// r_i being the least distance of node i at rest from what it meets there. Of its own surface it
  /// meets facets that are five D away at rest, and nearer ones that it is in front of: all others
  /// are joined to it by material, which may become as thin as D, be it a sheet or the facet
  /// beside.
  template <int dim>
  class ActivationDistances
  {
  public:
    /// `general`: D [m]. The surfaces must outlive it.
    ActivationDistances(const ContactSurfaces<dim> &surfaces, double general);

    /// The same for other `surfaces` with the same nodes, facets and positions at rest.
    ActivationDistances(const ActivationDistances &all, const ContactSurfaces<dim> &surfaces);

    /// D [m]; no other is larger.
    double
    of_others() const
    {
      return general;
    }

    /// Of a node with its own surface [m]. Zero if it touches that at rest.
    double
    of_own(const unsigned int node) const
    {
      return own[node];
    }

    /// Of a node with a wall that it meets [m].
    double
    of_wall(unsigned int node, unsigned int wall) const;

    /// Of two sharp edges of one body without a common node [m], by their numbers in
    /// ContactSurfaces::sharp_edges(); zero if they do not meet.
    double
    of_own_edges(unsigned int one, unsigned int other) const;

    /// Does a node meet this facet of its own surface?
    bool
    meets_own(unsigned int node, unsigned int facet) const;

  private:
    const ContactSurfaces<dim> &surfaces;
    double                      general;
    std::vector<double>         own; ///< of nodes of bodies
  };
} // namespace undine

#endif
