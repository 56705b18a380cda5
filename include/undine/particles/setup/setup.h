// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_setup_setup_h
#define undine_particles_setup_setup_h

#include <undine/particles/model/constants.h>

#include <algorithm>
#include <vector>

namespace undine::particles
{
  /// How the particle method computes; every value has a measured default, see doc/particles.md.
  struct Numerics
  {
    double reach = 2.1; ///< effective radius r_e [spacings]

    double largest_sub_step = 0;   ///< [s]; 0: a frame
    double speed_share      = 0.2; ///< of the spacing that a particle may cross in a sub-step [1]
    double wave_share       = 0.3; ///< of l0 / sqrt(g H) [1]
    double carry_share =
      0.02; ///< of a body's pressure that elasticity takes over in a sub-step [1]
    int most_elastic_steps = 0; ///< explicit steps of bodies in a sub-step; if more were needed,
                                ///< one implicit step is taken; 0: always explicit
    PositionUpdate position_update = PositionUpdate::end_velocity;
    double elastic_share = 0.6; ///< of l0 / c_p that an explicit step of a body may take [1]

    Source source        = Source::divergence;
    double density_share = 0.02; ///< gamma [1]
    /// Errors of the density fade in this time [sqrt(l0 / g)], gamma = dt / tau; 0 or no gravity:
    /// density_share.
    double    relaxation_time = 3;
    double    crowd_excess    = 0.1; ///< of n* over n0, from which on errors are removed faster [1]
    double    crowd_share     = 0.2; ///< of the excess beyond that, removed in a sub-step [1]
    PairForce pair_force      = PairForce::balanced;
    Coupling  coupling        = Coupling::simultaneous;

    double surface_density       = 0.9;  ///< share of n0 [1]
    double body_surface_density  = 0.8;  ///< share of n0, of bodies' particles [1]
    double one_sided_density     = 0.97; ///< share of n0 [1]
    double surface_one_sidedness = 0.2;  ///< share of n0 [1]
    double surface_fade          = 0.03; ///< half the width over which both fade [1]
    double air                   = 2;    ///< weight of missing neighbours; 0: no pressure there [1]

    double collision_distance = 0.8;  ///< [spacings]
    double restitution        = 0.2;  ///< [1]
    double shifting           = 0.3;  ///< [1]
    double shifting_limit     = 0.05; ///< [spacings per sub-step]

    double tolerance       = 1e-4; ///< of the pressure solver, relative
    double faces_tolerance = 3e-2; ///< of the virtual faces' solver, relative
    int    max_iterations  = 2000;

    enum class Preconditioner
    {
      automatic, ///< the faster one for the number of particles
      jacobi,
      multigrid
    };
    Preconditioner preconditioner = Preconditioner::automatic;

    int threads = 0; ///< of the host; 0: all cores
  };

  /// An elastic body of particles.
  struct BodySetup
  {
    double density         = 1000; ///< [kg/m^3]
    double youngs_modulus  = 1e5;  ///< [Pa]
    double poissons_ratio  = 0.3;  ///< [1]
    double hourglass       = 1;    ///< alpha of Elasticity, >= 0 [1]
    double damping         = 0.02; ///< share of critical damping of bonds [1]
    double bulk_damping    = 0.2;  ///< of sound, as a share of rho c_p l0 [1]
    double contact_modulus = 0;    ///< [Pa]; 0: lambda + 2 mu
    Law    law             = Law::corotated;
  };

  /// Of all bodies, C = alpha M + eta V (P15).
  struct BodyDamping
  {
    double mass      = 0; ///< alpha [1/s]
    double stiffness = 0; ///< eta [s]
  };

  /// A side of the box, or a part of space behind a plane, where fluid enters or leaves; see
  /// OpenBoundary.
  struct OpenSide
  {
    int    axis   = 0;
    double plane  = 0; ///< [m]
    double inward = 1; ///< +1 or -1: direction into the domain along the axis
    bool   is_inflow =
      false; ///< with layers of wall and dummy particles of `inflow_material` behind it
    /// With layers of wall particles of `opening_material` behind it, which have the pressure: a
    /// full domain goes on there. Else what leaves is taken out.
    bool   is_opening = false;
    double depth      = 0; ///< of these layers, a whole number of spacings [m]
    double pressure   = 0; ///< of an opening [Pa]
    /// Does what enters through an opening come from rest, with the pressure less rho v^2 / 2?
    bool enters_from_rest = false;
  };

  /// What a run of particles is made of; constant. Identities 0 ... reference.size() - 1 are the
  /// particles of elastic bodies, whose vectors below are by identity.
  template <int dim>
  struct Setup
  {
    double              spacing = 0;  ///< l0 [m]
    Vector<dim, double> lower, upper; ///< of the box that no particle may leave, walls included [m]
    bool                periodic[dim] = {};
    Vector<dim, double> gravity       = Vector<dim, double>::zero(); ///< [m/s^2]
    double              attraction    = 0; ///< towards the centre, per distance [1/s^2]
    Vector<dim, double> centre        = Vector<dim, double>::zero(); ///< [m]

    bool   has_fluid          = true; ///< else bodies move by elasticity alone
    double fluid_density      = 1000; ///< [kg/m^3]
    double fluid_viscosity    = 0;    ///< kinematic [m^2/s]
    double wall_viscosity     = 0;    ///< of WallFriction [m^2/s]; 0: none
    double wall_roughness     = 0;    ///< of WallFriction [m]
    double fluid_bulk_modulus = 0;    ///< [Pa]; 0: incompressible
    double depth              = 0;    ///< of the fluid along gravity, for the waves' speed [m]

    /// Fluid and bodies fill the domain: there is no free surface. Pressures are known up to a
    /// constant unless there are openings.
    bool is_full = false;
    /// Potential energy per mass of the body force where the fluid at rest has no pressure: in
    /// the highest corner of a domain that it fills, else at its surface at the start [J/kg].
    double top_potential = 0;

    std::vector<OpenSide> open_sides;

    /// Particles of walls that move, see MoveWalls: the identities that follow those of bodies.
    int n_moving = 0;

    std::vector<BodySetup>           bodies;
    std::vector<Vector<dim, double>> reference; ///< X [m]
    std::vector<int>                 body_of;   ///< entry of `bodies`
    std::vector<unsigned char>       clamped;   ///< directions in which it does not move, bits
    BodyDamping                      body_damping;

    Numerics numerics;

    /// Does a full domain go on behind openings? Pressures are known then.
    bool
    has_openings() const
    {
      return std::any_of(
        open_sides.begin(), open_sides.end(), [](const OpenSide &side) { return side.is_opening; });
    }
  };
} // namespace undine::particles

#endif
