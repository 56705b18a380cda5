// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_inward_directions_h
#define undine_particles_fluid_inward_directions_h

#include <undine/particles/model/constants.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// How much of bodies is around a particle of the fluid, and on which side.
  template <int dim, class Real>
  struct BodiesAround
  {
    Real              density = 0;                         ///< their part of the number density [1]
    Vector<dim, Real> side    = Vector<dim, Real>::zero(); ///< sum w r / |r| [1]

    UNDINE_HOST_DEVICE
    void
    add(const Pair<dim, Real> &pair)
    {
      if (pair.tag.kind() != Kind::solid)
        return;
      density += pair.weight;
      side += (pair.weight * pair.inverse_distance) * pair.r;
    }

    /// The direction into the body, once the particle is in it farther than any particle in front
    /// of a surface: bodies make at most 55 % of their neighbourhood. Its square times the
    /// sum of the weights is 1 from six tenths on, and 0 in front of surfaces. Between two bodies
    /// it fades out.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    inward_direction(const Real full) const
    {
      const Real strength = minimum(Real(1), Real(20) * (density / full - Real(0.55)));
      if (!(strength > 0))
        return Vector<dim, Real>::zero();
      const Real clear = maximum(square_root(norm_square(side)), Real(0.3) * density);
      return (square_root(strength / density) / clear) * side;
    }
  };


  /// The directions into bodies, of the particles of the fluid.
  template <int dim, class Real>
  struct MeasureInwardDirections
  {
    Constants<dim, Real>     constants;
    Neighbours<dim, Real>    neighbours;
    StoredVector<dim, Real> *inward_directions;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      BodiesAround<dim, Real> bodies;
      if (neighbours.places[i].tag.kind() == Kind::fluid)
        neighbours.for_each(i, [&](const int, const Pair<dim, Real> &pair) { bodies.add(pair); });
      inward_directions[i] = bodies.inward_direction(constants.number_density);
    }
  };


  /// Fluid that has come between the particles of a body goes no further: what it moves into the
  /// body, relative to the body's particles around it, is taken out, equal and opposite on both.
  template <int dim, class Real>
  struct StopEntry
  {
    Real                           fluid_density;     ///< [kg/m^3]
    const StoredVector<dim, Real> *inward_directions; ///< nullptr: no bodies

    /// The particles of a body that fluid pushes in front of it.
    static constexpr Real pushed = 4;

    /// The change of the velocity of fluid by a neighbour that approaches it with `approach`.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    of_fluid(const int                i,
             const Pair<dim, Real>   &pair,
             const Real               solid_density,
             const Vector<dim, Real> &approach) const
    {
      if (inward_directions == nullptr || pair.tag.kind() != Kind::solid)
        return Vector<dim, Real>::zero();
      return change(inward_directions[i], pair, solid_density, approach);
    }

    /// The change of the velocity of a body's particle by its neighbour j.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    of_solid(const int                j,
             const Pair<dim, Real>   &pair,
             const Real               solid_density,
             const Vector<dim, Real> &approach) const
    {
      if (inward_directions == nullptr || pair.tag.kind() != Kind::fluid)
        return Vector<dim, Real>::zero();
      return (-fluid_density / solid_density) *
             change(inward_directions[j], pair, solid_density, Real(-1) * approach);
    }

  private:
    /// Of the fluid.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    change(const Vector<dim, Real> &inward_direction,
           const Pair<dim, Real>   &pair,
           const Real               solid_density,
           const Vector<dim, Real> &approach) const
    {
      const Real share = pushed * solid_density / (fluid_density + pushed * solid_density);
      return (share * pair.weight * minimum(Real(0), approach * inward_direction)) *
             inward_direction;
    }
  };
} // namespace undine::particles

#endif
