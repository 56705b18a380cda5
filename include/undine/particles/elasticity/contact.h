// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_contact_h
#define undine_particles_elasticity_contact_h

#include <undine/particles/elasticity/elastic_bodies.h>

namespace undine::particles
{
  /// Contact of elastic bodies with walls, with each other, and of parts of a body that were not
  /// neighbours: particles closer than the spacing l0 repel with the equal and opposite forces
  ///
  ///     k (q^4 - q^3) r,   q = l0 / |r|:
  ///
  /// a spring of stiffness k when they touch, a barrier when they are pressed into each other.
  /// Neighbours in the reference repel alike from 0.4 l0 on: where a body is folded, mean
  /// deformations do not tell that they come to the same place. Who may come into contact is listed
  /// once for all steps of a run.
  template <int dim, class Real>
  struct Contact
  {
    Real                     spacing; ///< [m]
    ElasticBodies<dim, Real> bodies;
    Neighbours<dim, Real>    neighbours; ///< of the sorted particles
    const int               *identities;
    const int               *where;   ///< sorted place of each identity
    const Motion<dim, Real> *motions; ///< of the sorted particles
    Real                     volume;
    int                     *counts;   ///< of partners, by identity
    int                     *partners; ///< identities, or walls' sorted places p as -1 - p
    Real time_left = 0;                ///< until the end of the sub-step, where walls stand [s]

    /// Those that are near enough to touch within a sub-step. Returns how many they are.
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
      Vector<dim, Real> acceleration; ///< [m/s^2]
      /// Bounds on the squares of the frequency that contact lets it have, and of the rate at which
      /// it comes closer to others [1/s^2].
      Real frequency_square, closing_square;
    };

    /// Of a particle with `count` partners, `left` [s] before the end of the sub-step.
    /// point_of(identity) is where a partner is then.
    template <class Lanes, class Points>
    UNDINE_HOST_DEVICE
    Response
    response(const int                      identity,
             const ElasticPoint<dim, Real> &point,
             const int                      count,
             const Real                     left,
             const Lanes                   &lanes,
             const Points                  &point_of) const
    {
      Response sum = {Vector<dim, Real>::zero(), 0, 0};
      if (count == 0)
        return sum;
      for (int k = lanes.rank(); k < count; k += lanes.count())
        {
          const int  partner = partners[list_slot(identity, k, neighbours.capacity)];
          const bool is_wall = partner < 0;
          const auto other   = is_wall ? wall_point(-1 - partner, left) : point_of(partner);
          const auto r       = distance(point.x, other.x);
          const Real square  = norm_square(r);
          const Real touch   = touching_distance(identity, is_wall ? identity : partner);
          if (square < touch * touch)
            {
              const Real k_ij    = stiffness(identity, partner);
              const Real q       = touch * inverse_square_root(square);
              const Real closing = minimum(Real(0), r * (other.v - point.v) / square);
              sum.acceleration += (k_ij * (q - 1) * q * q * q) * r;
              sum.frequency_square += 2 * k_ij * (3 * q - 2) * q * q * q;
              sum.closing_square += closing * closing;
            }
        }
      const Real inverse_mass = 1 / (bodies.materials[bodies.bodies[identity]].density * volume);
      return {inverse_mass * lanes.sum(sum.acceleration),
              inverse_mass * lanes.sum(sum.frequency_square),
              lanes.sum(sum.closing_square)};
    }

    /// At the present points.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    Response
    response(const int identity, const Lanes &lanes) const
    {
      return response(identity,
                      bodies.points[identity],
                      counts[identity],
                      time_left,
                      lanes,
                      [&](const int partner) { return bodies.points[partner]; });
    }

    /// The change of the acceleration as particles move along u, by identity; walls stay. Of each
    /// pair the part along its line, which the barrier makes stiff [1/s^2 times that of u].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration_change(const int identity, const Vector<dim, Real> *u) const
    {
      const auto point = bodies.points[identity];
      auto       force = Vector<dim, Real>::zero();
      for (int k = 0; k < counts[identity]; ++k)
        {
          const int  partner = partners[list_slot(identity, k, neighbours.capacity)];
          const bool is_wall = partner < 0;
          const auto other = is_wall ? neighbours.places[-1 - partner].x : bodies.points[partner].x;
          const auto r     = distance(point.x, other);
          const Real square = norm_square(r);
          const Real touch  = touching_distance(identity, is_wall ? identity : partner);
          if (!(square < touch * touch))
            continue;
          const Real q       = touch * inverse_square_root(square);
          const auto closing = is_wall ? u[identity] : u[identity] - u[partner];
          force -=
            (stiffness(identity, partner) * (3 * q - 2) * q * q * q * (closing * r) / square) * r;
        }
      return (1 / (bodies.materials[bodies.bodies[identity]].density * volume)) * force;
    }

  private:
    /// The particle of a wall at the sorted place j, `left` [s] before the end of the sub-step.
    /// Walls that move stand where the sub-step ends, and have their mean velocity in it: were they
    /// there from its beginning, they would enter a body by all of their way at once.
    UNDINE_HOST_DEVICE
    ElasticPoint<dim, Real>
    wall_point(const int j, const Real left) const
    {
      const auto place = neighbours.places[j];
      if (place.tag.material() != moving_material)
        return {place.x, Vector<dim, Real>::zero()};
      const auto v = motions[j].v;
      return {place.x - left * v, v};
    }

    /// To x from y, the points of bodies, which may have gone around the box several times [m].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    distance(const Vector<dim, Real> &x, const Vector<dim, Real> &y) const
    {
      const auto &grid = neighbours.grid;
      return grid.difference(grid.wrapped(x), grid.wrapped(y));
    }

    /// Of the softer one; a wall does not give [N/m, in the plane per m].
    UNDINE_HOST_DEVICE
    Real
    stiffness(const int identity, const int partner) const
    {
      const Real own = bodies.materials[bodies.bodies[identity]].contact;
      return partner < 0 ? 2 * own : minimum(own, bodies.materials[bodies.bodies[partner]].contact);
    }

    /// [m]; of a wall's particle that of `identity` itself.
    UNDINE_HOST_DEVICE
    Real
    touching_distance(const int identity, const int other) const
    {
      const Real folded = Real(0.4);
      return other != identity && are_bonded(identity, other) ? folded * spacing : spacing;
    }

    /// Is the neighbour at place j of i, where `identity` is? Reads all that it may need at once.
    UNDINE_HOST_DEVICE
    bool
    is_partner(const int identity, const int i, const int j, int &partner) const
    {
      const auto place    = neighbours.places[j];
      const int  other    = identities[j];
      const bool is_solid = place.tag.kind() == Kind::solid;
      const Real near     = Real(1.6) * touching_distance(identity, is_solid ? other : identity);
      partner             = is_solid ? other : -1 - j;
      return place.tag.kind() != Kind::fluid &&
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
