// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_contact_h
#define undine_particles_contact_h

#include <undine/particles/elastic_bodies.h>

namespace undine::particles
{
  /// Contact of elastic bodies with walls, with each other, and of parts of a body that were not
  /// neighbours: particles closer than the spacing repel with the potential k (l0 - r)^2 / 2, equal
  /// and opposite. Who may come into contact is listed once for all steps of a run.
  template <int dim, class Real>
  struct Contact
  {
    Real                     spacing; ///< [m]
    ElasticBodies<dim, Real> bodies;
    Neighbours<dim, Real>    neighbours; ///< of the sorted particles
    const int               *identities;
    const int               *where; ///< sorted place of each identity
    Real                     volume;
    int                     *counts;   ///< of partners, by identity
    int                     *partners; ///< identities, or walls' sorted places p as -1 - p

    /// Bonded neighbours do not count: elasticity acts between them.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    list_partners(const int identity, const Lanes &lanes) const
    {
      const int i = where[identity], n = neighbours.counts[i];
      int       count = 0;
      for (int first = 0; first < n; first += lanes.count())
        {
          const int  k       = first + lanes.rank();
          int        partner = 0;
          const bool yes     = k < n && is_partner(identity, i, k, partner);
          const auto ballot  = lanes.ballot(yes);
          if (yes)
            partners[list_slot(identity, count + lanes.votes_before(ballot), neighbours.capacity)] =
              partner;
          count += lanes.votes(ballot);
        }
      if (lanes.rank() == 0)
        counts[identity] = count;
    }

    /// [m/s^2]
    template <class Lanes>
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int identity, const Lanes &lanes) const
    {
      auto      force = Vector<dim, Real>::zero();
      const int count = counts[identity];
      if (count == 0)
        return force;
      const auto &properties = bodies.materials[bodies.bodies[identity]];
      const auto  x          = bodies.points[identity].x;
      for (int k = lanes.rank(); k < count; k += lanes.count())
        {
          const int  partner = partners[list_slot(identity, k, neighbours.capacity)];
          const auto other =
            partner < 0 ? neighbours.places[-1 - partner].x : bodies.points[partner].x;
          const Real stiffness =
            partner < 0
              ? properties.contact
              : minimum(properties.contact, bodies.materials[bodies.bodies[partner]].contact);
          const auto r      = neighbours.grid.difference(x, other);
          const Real square = norm_square(r);
          if (square < spacing * spacing)
            force += (stiffness * (spacing * inverse_square_root(square) - 1)) * r;
        }
      return (1 / (properties.density * volume)) * lanes.sum(force);
    }

  private:
    /// Is the k-th neighbour of place i, where `identity` is?
    UNDINE_HOST_DEVICE
    bool
    is_partner(const int identity, const int i, const int k, int &partner) const
    {
      const int  j    = neighbours.indices[list_slot(i, k, neighbours.capacity)];
      const Kind kind = neighbours.places[j].tag.kind();
      partner         = kind == Kind::solid ? identities[j] : -1 - j;
      return kind != Kind::fluid && !(kind == Kind::solid && are_bonded(identity, partner));
    }

    /// Were they neighbours in the reference?
    UNDINE_HOST_DEVICE
    bool
    are_bonded(const int a, const int b) const
    {
      return bodies.bodies[a] == bodies.bodies[b] &&
             norm_square(bodies.reference[a].x - bodies.reference[b].x) <
               neighbours.reach * neighbours.reach;
    }
  };
} // namespace undine::particles

#endif
