// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_contact_h
#define undine_particles_contact_h

#include <undine/particles/elastic_bodies.h>

namespace undine::particles
{
  /// Contact of elastic bodies with walls, with each other, and of parts of a body that were not
  /// neighbours: particles closer than the spacing repel with the force k (q^4 - q^3) r, q = l0 /
  /// |r|, equal and opposite: a spring of stiffness k when they touch, a barrier when they are
  /// pressed into each other. Who may come into contact is listed once for all steps of a run.
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

    /// Those that are near enough to touch within a sub-step. Bonded neighbours do not count:
    /// elasticity acts between them. Returns how many they are.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    int
    list_partners(const int identity, const Lanes &lanes) const
    {
      constexpr int together = 4; // on the way at the same time
      const int     i = where[identity], n = neighbours.counts[i];
      int           count = 0;
      for (int first = lanes.rank(); first - lanes.rank() < n; first += together * lanes.count())
        {
          int  partner[together];
          bool yes[together];
          UNDINE_UNROLL
          for (int m = 0; m < together; ++m)
            {
              const int k = first + m * lanes.count();
              const int j =
                neighbours.indices[list_slot(i, minimum(k, n - 1), neighbours.capacity)];
              yes[m] = is_partner(identity, i, j, partner[m]) && k < n;
            }
          UNDINE_UNROLL
          for (int m = 0; m < together; ++m)
            {
              const auto ballot = lanes.ballot(yes[m]);
              if (yes[m])
                partners[list_slot(
                  identity, count + lanes.votes_before(ballot), neighbours.capacity)] = partner[m];
              count += lanes.votes(ballot);
            }
        }
      if (lanes.rank() == 0)
        counts[identity] = count;
      return count;
    }

    /// What contact does to a particle.
    struct Response
    {
      Vector<dim, Real> acceleration;     ///< [m/s^2]
      Real              frequency_square; ///< bound on that of what it lets the particle do [1/s^2]
    };

    /// Of a particle at x with `count` partners. point_of(identity) is where a partner is.
    template <class Lanes, class Points>
    UNDINE_HOST_DEVICE
    Response
    response(const int                identity,
             const Vector<dim, Real> &x,
             const int                count,
             const Lanes             &lanes,
             const Points            &point_of) const
    {
      Response sum = {Vector<dim, Real>::zero(), 0};
      if (count == 0)
        return sum;
      const Real own = bodies.materials[bodies.bodies[identity]].contact;
      for (int k = lanes.rank(); k < count; k += lanes.count())
        {
          const int  partner = partners[list_slot(identity, k, neighbours.capacity)];
          const bool is_wall = partner < 0;
          const auto other   = is_wall ? neighbours.places[-1 - partner].x : point_of(partner);
          const auto r       = neighbours.grid.difference(x, other);
          const Real square  = norm_square(r);
          if (square < spacing * spacing)
            {
              const Real stiffness =
                is_wall ? own : minimum(own, bodies.materials[bodies.bodies[partner]].contact);
              const Real q = spacing * inverse_square_root(square);
              sum.acceleration += (stiffness * (q - 1) * q * q * q) * r;
              sum.frequency_square += 2 * stiffness * (3 * q - 2) * q * q * q;
            }
        }
      const Real inverse_mass = 1 / (bodies.materials[bodies.bodies[identity]].density * volume);
      return {inverse_mass * lanes.sum(sum.acceleration),
              inverse_mass * lanes.sum(sum.frequency_square)};
    }

    /// At the present points.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    Response
    response(const int identity, const Lanes &lanes) const
    {
      return response(
        identity, bodies.points[identity].x, counts[identity], lanes, [&](const int partner) {
          return bodies.points[partner].x;
        });
    }

  private:
    /// Is the neighbour at place j of i, where `identity` is? Reads all that it may need at once.
    UNDINE_HOST_DEVICE
    bool
    is_partner(const int identity, const int i, const int j, int &partner) const
    {
      const auto place    = neighbours.places[j];
      const int  other    = identities[j];
      const bool is_solid = place.tag.kind() == Kind::solid;
      const bool bonded   = are_bonded(identity, is_solid ? other : identity) && is_solid;
      const Real near     = Real(1.6) * spacing;
      partner             = is_solid ? other : -1 - j;
      return place.tag.kind() != Kind::fluid && !bonded &&
             norm_square(neighbours.grid.difference(place.x, neighbours.places[i].x)) < near * near;
    }

    /// Were they neighbours in the reference?
    UNDINE_HOST_DEVICE
    bool
    are_bonded(const int a, const int b) const
    {
      const bool same_body = bodies.bodies[a] == bodies.bodies[b];
      return norm_square(bodies.reference[a].x - bodies.reference[b].x) <
               neighbours.reach * neighbours.reach &&
             same_body;
    }
  };
} // namespace undine::particles

#endif
