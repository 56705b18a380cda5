// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_pressure_forces_h
#define undine_particles_pressure_pressure_forces_h

#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/pressure/assemble_pressure.h>

namespace undine::particles
{
  /// Gives the bodies' particles the pressure of their elasticity, P_s = -lambda tr(e), on the
  /// surface that it pushes (the source's equation 7, whose divergence is that of the printed
  /// units).
  template <int dim, class Real>
  struct GiveSurfacePressures
  {
    ElasticBodies<dim, Real> bodies;
    Motion<dim, Real>       *motions;
    const int               *where;

    UNDINE_HOST_DEVICE
    void
    operator()(const int identity) const
    {
      const Real strain =
        double_contraction(bodies.rotations[identity], bodies.deformations[identity]) - dim;
      const Real lambda                 = bodies.materials[bodies.bodies[identity]].lambda;
      motions[where[identity]].pressure = maximum(-lambda * strain, Real(0));
    }
  };


  /// Gives the particles their pressures, which do not pull unless they may, and tells their
  /// neighbours how far they are fluid at the free surface.
  template <int dim, class Real>
  struct TakePressures
  {
    Neighbourhood<dim, Real> neighbourhood;
    const Real              *solution;
    Particles<dim, Real>     particles;
    bool                     keeps_solids; ///< whose pressures are given
    bool                     may_pull;     ///< only differences of pressures matter
    const StepControl       *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      const Kind kind = particles.places[i].tag.kind();
      particles.potentials[i].set_companion(kind == Kind::fluid ? 1 - neighbourhood.coverages[i]
                                                                : Real(0));
      if (control->done() || (keeps_solids && kind == Kind::solid) ||
          particles.places[i].tag.material() == opening_material)
        return;
      const Real pressure           = may_pull ? solution[i] : maximum(solution[i], Real(0));
      particles.motions[i].pressure = neighbourhood.is_unknown[i] ? pressure : Real(0);
    }
  };


  /// The accelerations by pressure, a_i = -(2 / rho_i) sum_j P_ij a_ij with the pressure at the
  /// middle
  ///     P_ij = (rho_j P_i + rho_i P_j) / (rho_i + rho_j)
  /// that makes both particles of a pair accelerate alike, and virtual faces a_ij by PairForce;
  /// then the correction of velocity and place (P7b), and a shift towards even spacing, next to the
  /// free surface along it: across, it would push the surface outwards. LocalShift makes it
  /// where the fluid is alone. For bodies the acceleration is only kept.
  ///
  /// Inside the fluid the body force f = -grad phi, of which the particles already have all, is
  /// replaced by that through the same faces,
  ///     sum_j a_ij (phi_i - phi_j) + 2 (P_rest / rho) sum_j a_ij - f(x_i),
  /// so that it weighs the volume on which pressure acts: else particles that are locally a little
  /// too dense or too sparse sink or rise like cold and warm water, and keep water at rest moving.
  /// The second term, with the pressure at rest below the surface at the start but not more than
  /// the present one, takes out what that pressure does to what the solver has left open of faces:
  /// else it drives or brakes all of the water (only where the fluid is alone).
  template <int dim, class Real>
  struct PressureForces
  {
    Constants<dim, Real>           constants;
    Neighbours<dim, Real>          neighbours;
    Neighbourhood<dim, Real>       neighbourhood;
    VirtualFaces<dim, Real>        faces;
    const Motion<dim, Real>       *motions;
    const int                     *identities;
    Place<dim, Real>              *new_places;
    Motion<dim, Real>             *new_motions;
    const StoredVector<dim, Real> *gaps; ///< of AssemblePressure
    StoredVector<dim, Real> *shifts; ///< receives those towards even spacing, for LocalShift [m]
    Vector<dim, Real>       *solid_accelerations; ///< by identity [m/s^2]
    StepControl             *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      Place<dim, Real>  place  = neighbours.places[i];
      Motion<dim, Real> motion = motions[i];
      if (!control->done() && place.tag.kind() == Kind::fluid)
        move(i, place, motion);
      else if (!control->done() && place.tag.is_in_layers())
        place.x += (1 - constants.pressure_place) * static_cast<Real>(control->dt) * motion.v;
      else if (!control->done() && place.tag.kind() == Kind::solid)
        {
          solid_accelerations[identities[i]] =
            sum<SolidSum>(i, place.tag, motion.pressure).acceleration;
        }
      new_places[i]  = place;
      new_motions[i] = motion;
    }

  private:
    /// The face to a neighbour.
    struct Face
    {
      const Pair<dim, Real> &pair;
      Vector<dim, Real>      area;        ///< [1/m]
      Vector<dim, Real>      by_pressure; ///< acceleration [m/s^2]
      Vector<dim, Real>      force;       ///< body force at its middle [m/s^2]
    };

    /// Over the neighbours of a particle of the fluid.
    struct FluidSum
    {
      Vector<dim, Real> acceleration = Vector<dim, Real>::zero(); ///< [m/s^2]
      Vector<dim, Real> weight       = Vector<dim, Real>::zero(); ///< f by the faces [m/s^2]
      Vector<dim, Real> opening      = Vector<dim, Real>::zero(); ///< sum of the faces [1/m]
      Vector<dim, Real> crowd        = Vector<dim, Real>::zero(); ///< sum w r / r^2 [1/m]
      Vector<dim, Real> bodies       = Vector<dim, Real>::zero(); ///< the same of bodies only [1/m]
      Vector<dim, Real> surface      = Vector<dim, Real>::zero(); ///< and of the free surface [1/m]
      Real              body_density = 0; ///< their part of the number density [1]

      UNDINE_HOST_DEVICE
      void
      add(const Pair<dim, Real> &pair, const Vector<dim, Real> &plain, const Real at_surface)
      {
        crowd += plain;
        surface += at_surface * plain;
        if (pair.tag.kind() == Kind::solid)
          {
            bodies += plain;
            body_density += pair.weight;
          }
      }

      UNDINE_HOST_DEVICE
      void
      add(const Face &face)
      {
        acceleration += face.by_pressure;
        weight += (face.force * face.pair.r) * face.area;
        opening += face.area;
      }
    };

    /// Over those of a particle of a body.
    struct SolidSum
    {
      Vector<dim, Real> acceleration = Vector<dim, Real>::zero(); ///< [m/s^2]

      UNDINE_HOST_DEVICE
      void
      add(const Pair<dim, Real> &, const Vector<dim, Real> &, Real)
      {
      }

      UNDINE_HOST_DEVICE
      void
      add(const Face &face)
      {
        acceleration += face.by_pressure;
      }
    };

    template <class Sum>
    UNDINE_HOST_DEVICE
    Sum
    sum(const int i, const Tag tag, const Real P) const
    {
      const auto M       = neighbourhood.corrections[i].matrix();
      const auto side    = faces.side(i);
      const auto x       = neighbours.places[i].x;
      const Real density = constants.density(tag);
      const Real least =
        constants.pair_force == PairForce::minimum ? least_pressure(i, P) : Real(0);
      Sum sum;
      struct Other
      {
        Real                                   pressure;
        typename VirtualFaces<dim, Real>::Side side;
      };
      const auto fetch = [&](const int j) { return Other{motions[j].pressure, faces.side(j)}; };
      neighbours.for_each(
        i, fetch, [&](const int, const Pair<dim, Real> &pair, const Other &other) {
          const Vector<dim, Real> plain = pair.weight_over_square() * pair.r;
          sum.add(pair, plain, other.side.surface());
          if (pair.tag.kind() == Kind::dummy || is_left_to_elasticity(tag, pair.tag))
            return;
          auto face  = faces.factor * plain;
          Real value = twice_pressure(tag, pair.tag, P, other.pressure);
          if (constants.pair_force == PairForce::balanced)
            face = faces.closed(side, other.side, pressure_coefficient(constants, tag, pair), pair);
          else if (constants.pair_force == PairForce::corrected)
            {
              face = faces.factor * (M * plain);
              value -= 2 * P;
            }
          else if (constants.pair_force == PairForce::minimum)
            value = other.pressure - least;
          sum.add(Face{pair,
                       face,
                       (-value / density) * face,
                       constants.fluid_acceleration(x + Real(0.5) * pair.r)});
        });
      return sum;
    }

    /// With surface pressures a body's particles count neighbours of the fluid only (the source's
    /// equation 8).
    UNDINE_HOST_DEVICE
    bool
    is_left_to_elasticity(const Tag tag, const Tag other) const
    {
      return constants.coupling == Coupling::surface_pressure && tag.kind() == Kind::solid &&
             tag.code == other.code;
    }

    /// 2 P_ij. A body and something else press but do not pull each other, as far as it is known
    /// where pressures are zero.
    UNDINE_HOST_DEVICE
    Real
    twice_pressure(const Tag tag, const Tag other, const Real P_i, const Real P_j) const
    {
      Real value = P_i + P_j;
      if (tag.material() != other.material())
        {
          const Real a = constants.density(tag);
          const Real b = constants.density(other);
          value        = 2 * (b * P_i + a * P_j) / (a + b);
        }
      return tag.code == other.code || constants.is_full ? value : maximum(value, Real(0));
    }

    UNDINE_HOST_DEVICE
    Real
    least_pressure(const int i, Real least) const
    {
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        if (pair.tag.kind() != Kind::dummy)
          least = minimum(least, motions[j].pressure);
      });
      return least;
    }

    /// Corrects a particle of the fluid.
    UNDINE_HOST_DEVICE
    void
    move(const int i, Place<dim, Real> &place, Motion<dim, Real> &motion) const
    {
      FluidSum   sum      = this->sum<FluidSum>(i, place.tag, motion.pressure);
      const Real coverage = neighbourhood.coverages[i];
      if (constants.pair_force == PairForce::balanced)
        sum.acceleration += coverage * (sum.weight - constants.fluid_acceleration(place.x));
      if (constants.pair_force == PairForce::balanced && constants.is_alone)
        sum.acceleration +=
          (2 * weight_of_column(place.x, motion.pressure)) * left_open(i, coverage, sum.opening);
      move(place, motion, sum.acceleration);
      const auto evened = coverage * along_surface(sum.surface, shift(sum.crowd));
      if (constants.is_alone)
        shifts[i] = evened;
      else if (!constants.is_full) // else EvenSpacing
        place.x += evened;
      place.x += way_out(sum);
      place.x = constants.grid.wrapped(place.x);
      if (!constants.grid.contains(place.x))
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::outside));
    }

    /// The pressure at rest over the density, as far as the fluid has it [J/kg].
    UNDINE_HOST_DEVICE
    Real
    weight_of_column(const Vector<dim, Real> &x, const Real pressure) const
    {
      const Real at_rest = constants.top_potential - constants.force.potential(x);
      return maximum(Real(0), minimum(at_rest, pressure / constants.fluid_density));
    }

    /// What the solver has left open of faces that it should have closed, times the coverage: the
    /// part 1 - coverage of a particle at the free surface is open by intention [1/m].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    left_open(const int i, const Real coverage, const Vector<dim, Real> &opening) const
    {
      return coverage * opening + (1 - coverage) * Vector<dim, Real>(gaps[i]);
    }

    /// The rest of the way, and what the pressure does to all of it.
    UNDINE_HOST_DEVICE
    void
    move(Place<dim, Real>        &place,
         Motion<dim, Real>       &motion,
         const Vector<dim, Real> &acceleration) const
    {
      const Real dt   = static_cast<Real>(control->dt);
      const Real rest = (1 - constants.pressure_place) * dt;
      if (rest > 0)
        place.x += rest * (motion.v - (1 - constants.path_weight) * dt *
                                        constants.fluid_acceleration(place.x));
      motion.v += dt * acceleration;
      place.x += (constants.path_weight * dt * dt) * acceleration;
      atomic_maximum(&control->largest_speed,
                     static_cast<float>(square_root(norm_square(motion.v))));
    }

    /// Out of a body into which fluid is about to squeeze between its particles: outside, bodies
    /// make less than half of a neighbourhood [m].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    way_out(const FluidSum &sum) const
    {
      const Real excess = maximum(Real(0), sum.body_density / constants.number_density - Real(0.5));
      return limited((-2 * excess * constants.spacing * constants.spacing * faces.factor) *
                       sum.bodies,
                     Real(0.2) * constants.spacing);
    }

    /// Away from where neighbours crowd [m].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    shift(const Vector<dim, Real> &crowd) const
    {
      return limited((-constants.shifting * constants.spacing * constants.spacing * faces.factor) *
                       crowd,
                     constants.shifting_limit);
    }

    /// Without what is across the free surface, as far as that is near: a full layer of its
    /// particles next to this one makes a sum `surface` of half a face.
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    along_surface(const Vector<dim, Real> &surface, const Vector<dim, Real> &shift) const
    {
      const Vector<dim, Real> across = (constants.spacing * faces.factor) * surface;
      const Real              little = Real(0.1);
      return shift - (shift * across / (norm_square(across) + little * little)) * across;
    }

    UNDINE_HOST_DEVICE
    static Vector<dim, Real>
    limited(Vector<dim, Real> shift, const Real limit)
    {
      const Real square = norm_square(shift);
      if (square > limit * limit)
        shift *= limit * inverse_square_root(square);
      return shift;
    }
  };
} // namespace undine::particles

#endif
