// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_constants_h
#define undine_particles_model_constants_h

#include <undine/particles/model/body_force.h>
#include <undine/particles/model/cell_grid.h>
#include <undine/particles/model/elastic_material.h>
#include <undine/particles/model/particle.h>
#include <undine/particles/model/wall_friction.h>

namespace undine::particles
{
  /// What drives the pressure: the right-hand side of the pressure equation.
  enum class Source
  {
    divergence, ///< of the intermediate velocity, and a share of the density's error
    density,    ///< the whole error of the intermediate density (the source's equation 5)
    relaxed     ///< a share of it
  };

  /// How pressures become forces, see PressureForces.
  enum class PairForce
  {
    balanced,  ///< equal and opposite, and exact for constant pressures: virtual faces that close
    corrected, ///< exact for linear pressures; momentum is conserved up to the disorder
    minimum,   ///< every pair repels: P_j - min P [Koshizuka, Oka 1996]
    conserving ///< P_i + P_j: equal and opposite, but stiff under high pressure
  };

  /// How bodies take part in the pressure equation.
  enum class Coupling
  {
    simultaneous,    ///< as fluid of another density: all their particles are unknowns
    surface_pressure ///< with the pressure of their elasticity, the source's equation 7
  };

  /// The velocity with which fluid goes through a sub-step of length h.
  enum class PositionUpdate
  {
    end_velocity, ///< that at its end: dissipative, of first order in h
    mean_velocity ///< the mean of those at its start and at its end
  };

  /// The numbers of a scene that passes need, constant during a run; in the unit system of the
  /// scene.
  template <int dim, class Real>
  struct Constants
  {
    CellGrid<dim, Real> grid;
    Real                spacing;        ///< l0 [m]
    Real                reach;          ///< effective radius r_e [m]
    Real                volume;         ///< of a particle, l0^dim [m^dim]
    Real                number_density; ///< n0 [1]
    Real                spread;         ///< lambda [m^2]
    Real                filling;        ///< f0, of filling() [1]
    Real                surface_lack;   ///< of Lattice [1]
    Real                filling_growth; ///< of Lattice [1]

    BodyForce<dim, Real> force;

    /// Of Setup. The fluid's pressure at rest then bears its weight whatever the arrangement of
    /// particles: pressures are what is beyond it (P11), and of body forces only what acts on a
    /// density other than the fluid's is left.
    bool is_full;
    /// Full and without openings: pressures are known up to a constant.
    bool is_closed;
    /// Fluid at a free surface that moves by mean velocities, without bodies and walls that move:
    /// sub-steps, shifts and weights then let waves go on. Beside bodies they would cost light ones
    /// 3 % of their way, and beside walls that move let single particles through.
    bool is_alone;
    Real displaced_density; ///< the fluid's if is_full, else zero [kg/m^3]
    Real top_potential;     ///< of Setup [J/kg]

    Real               viscosity;        ///< kinematic, of the fluid [m^2/s]
    WallFriction<Real> wall_friction;    ///< instead of friction by pairs on walls
    Real               fluid_density;    ///< [kg/m^3]
    Real               lightest_density; ///< of fluid and bodies [kg/m^3]
    /// 1 / K of the fluid's volume in the pressure equation [1/Pa]; 0: incompressible, as bodies
    /// are there.
    Real fluid_compressibility;
    /// Of the bodies, where passes run; to be set by who has them there.
    const ElasticMaterial<Real> *bodies;

    Source source;
    Real   density_share;   ///< gamma of Source::relaxed, and of divergence without the next [1]
    Real   relaxation_time; ///< tau: gamma = dt / tau [s]; 0: density_share

    Real crowd_excess; ///< of n* over n0 from which on particles crowd [1]
    Real crowd_share;  ///< of the excess beyond that, removed in a sub-step [1]
    Real crowd_rate;   ///< and in a second, if that is less [1/s]; 0: no such bound

    Real surface_density;       ///< n* < this * n0: at the free surface
    Real body_surface_density;  ///< the same of bodies' particles
    Real one_sided_density;     ///< n* < this * n0 and
    Real surface_one_sidedness; ///< |sum w r/|r|| > this * n0: also at the free surface
    Real surface_fade;          ///< over twice of which both fade
    Real air;                   ///< how strongly missing neighbours pull pressures to zero [1]

    /// beta of PositionUpdate: an acceleration a takes a particle along by beta h^2 a in a
    /// sub-step; 1 with the velocity at its end, 1/2 with the mean velocity [1].
    Real path_weight;
    /// gamma: the part of its way in a sub-step that a particle has gone when pressures are found
    /// [1]. With gamma = 1 - beta sub-steps neither feed nor dampen waves.
    Real pressure_place;

    Real collision_distance; ///< [m]
    /// The same between particles of the fluid; shorter in a full domain, where EvenSpacing keeps
    /// them apart without a loss of energy.
    Real fluid_collision_distance;
    Real restitution; ///< [1]

    PairForce pair_force;
    Coupling  coupling;
    Real      shifting;       ///< strength [1]
    Real      shifting_limit; ///< [m] per sub-step

    /// By the body force, on the fluid [m/s^2].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    fluid_acceleration(const Vector<dim, Real> &x) const
    {
      return is_full ? Vector<dim, Real>::zero() : force.acceleration(x);
    }

    /// Of what a particle belongs to; walls count as fluid [kg/m^3].
    UNDINE_HOST_DEVICE
    Real
    density(const Tag tag) const
    {
      const int material = tag.material();
      return material > 0 ? bodies[material - 1].density : fluid_density;
    }

    /// Density at the middle between two particles, at which pressure gradients accelerate. Walls
    /// count as fluid.
    UNDINE_HOST_DEVICE
    Real
    mean_density(const Tag a, const Tag b) const
    {
      return (density(a) + density(b)) / 2;
    }
  };
} // namespace undine::particles

#endif
