// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_energy_bound_h
#define undine_particles_engine_energy_bound_h

#include <undine/particles/engine/engine.h>

#include <optional>
#include <string>

namespace undine::particles
{
  /// How much energy a frame may gain. Without walls that move and inflows the energy of fluid and
  /// bodies only falls, but for what the method adds by errors of single sub-steps, and for what
  /// contact, whose energy is not counted, gives back; so at the end of no frame is there more than
  /// at the start. With them it may grow by what they can do, which is known in its order of
  /// magnitude only. More is a sign that something has become unstable: such a frame must not be
  /// taken for a result.
  template <int dim>
  struct EnergyBound
  {
    EnergyBound() = default;

    EnergyBound(const Setup<dim> &setup, const ParticleState<dim> &state);

    /// Why the frame of `length` [s] between two balances cannot be; empty: it can.
    std::string
    reason_of_excess(const Balance<dim> &before, const Balance<dim> &after, double length) const;

    double wall_speed = 0; ///< the fastest of walls that move, in this frame [m/s]

    /// The frame between two balances counts.
    void
    accept(const Balance<dim> &before, const Balance<dim> &after);

  private:
    bool
    has_sources() const;

    /// Of the energy in motion and deformation, and of the weight times a spacing: what a frame
    /// without sources may gain [1].
    static constexpr double share = 0.25;

    /// The same of all frames together: of what is in motion and deformation, and of the weight
    /// times a spacing, by which levels and positions are uncertain [1].
    static constexpr double share_of_motion = 0.05, share_of_weight = 0.1;

    double mass         = 0; ///< of all that moves [kg, in the plane per m]
    double gravity      = 0; ///< largest body force per mass [m/s^2]
    double spacing      = 0; ///< [m]
    double height       = 0; ///< largest extent of the box [m]
    double inflow_speed = 0; ///< [m/s]
    bool   flows_in     = false;
    bool   falls_around = false; ///< across periodic sides, and gains height there
    double source_mass  = 0;     ///< that could flow in: of the full box [kg, in the plane per m]

    /// Of fluid and bodies, before the frames since when nothing drove them nor left the domain
    /// [J].
    std::optional<double> at_start;
  };
} // namespace undine::particles

#endif
