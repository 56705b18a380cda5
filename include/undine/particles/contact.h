// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_contact_h
#define undine_particles_contact_h

#include <undine/particles/elastic_bodies.h>

namespace undine::particles
{
  /// Contact of elastic bodies with walls, with each other, and of parts of a body that were not
  /// neighbours: particles closer than the spacing repel with the potential k (l0 - r)^2 / 2, equal
  /// and opposite.
  template <int dim, class Real>
  struct Contact
  {
    Real                     spacing; ///< [m]
    ElasticBodies<dim, Real> bodies;
    Neighbours<dim, Real>    neighbours; ///< of the sorted particles
    const int               *identities;
    const int               *where; ///< sorted place of each identity
    Real                     volume;

    /// [m/s^2]
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int identity) const
    {
      const auto &properties = bodies.materials[bodies.bodies[identity]];
      const auto  x          = bodies.x[identity];
      const int   i          = where[identity];
      auto        force      = Vector<dim, Real>::zero();
      for (int k = 0; k < neighbours.counts[i]; ++k)
        {
          const int  j     = neighbours.indices[list_slot(i, k, neighbours.capacity)];
          const auto place = neighbours.places[j];
          if (place.tag.kind() == Kind::fluid)
            continue;
          Vector<dim, Real> other     = place.x;
          Real              stiffness = properties.contact;
          if (place.tag.kind() == Kind::solid)
            {
              const int partner = identities[j];
              if (are_bonded(identity, partner))
                continue;
              other     = bodies.x[partner];
              stiffness = minimum(stiffness, bodies.materials[bodies.bodies[partner]].contact);
            }
          const auto r      = neighbours.grid.difference(x, other);
          const Real square = norm_square(r);
          if (square < spacing * spacing)
            force += (stiffness * (spacing * inverse_square_root(square) - 1)) * r;
        }
      return (1 / (properties.density * volume)) * force;
    }

  private:
    /// Were they neighbours in the reference?
    UNDINE_HOST_DEVICE
    bool
    are_bonded(const int a, const int b) const
    {
      return bodies.bodies[a] == bodies.bodies[b] &&
             norm_square(bodies.reference[a] - bodies.reference[b]) <
               neighbours.reach * neighbours.reach;
    }
  };
} // namespace undine::particles

#endif
