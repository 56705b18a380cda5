// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_engine_h
#define undine_particles_engine_engine_h

#include <undine/base/core/registry.h>
#include <undine/particles/boundaries/moving_walls.h>
#include <undine/particles/engine/pass_results.h>
#include <undine/particles/model/particle_state.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/setup/setup.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace undine::particles
{
  /// Sums over all particles.
  template <int dim>
  struct Balance
  {
    double              kinetic_fluid = 0, kinetic_solid = 0; ///< [J]
    double              potential       = 0;                  ///< of MeasureBalance [J]
    double              mass            = 0;                  ///< of all that moves [kg]
    double              elastic         = 0;                  ///< [J]
    int                 fluid_in_bodies = 0; ///< particles of the fluid that have entered a body
    Vector<dim, double> momentum = Vector<dim, double>::zero(); ///< of fluid and bodies [kg m/s]
    std::vector<double> body_volumes;                           ///< over that at rest [1]
    std::vector<Vector<dim, double>> body_centres;              ///< [m]
    std::vector<Vector<dim, double>> body_velocities;           ///< [m/s]
  };

  /// How fast memory is, in bytes read and written [B/s].
  struct Throughput
  {
    double product = 0; ///< of the pressure matrix, whose bytes count once
    double copy    = 0; ///< of what does not fit in caches
  };

  /// Somebody looked at a frame that went on and wanted no more of it.
  class FrameAbandoned : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Is shown how far a frame is; false: the frame is abandoned.
  using Look = std::function<bool(const StepControl &)>;

  /// Moves the particles of a scene; one for the host, one for the device.
  template <int dim>
  class Engine
  {
  public:
    virtual ~Engine() = default;

    /// Take up a state. Throws InputError if it makes no sense: particles outside the box or on top
    /// of each other.
    virtual void
    load(const Setup<dim> &setup, const ParticleState<dim> &state) = 0;

    /// How moving walls move in the next frame; to be said before each one, if there are any.
    virtual void
    move_walls(const WallPaths<dim> &paths) = 0;

    /// From now on show frames that go on to `look`: whenever about `pause` [s] of wall time have
    /// passed, but not within a sub-step. What sub-steps compute does not depend on it.
    virtual void
    watch(Look look, double pause) = 0;

    /// A frame of `length` [s] in sub-steps. Throws SolveError with the reason if it cannot be
    /// completed, and FrameAbandoned if the one who looks wants that; the particles are then where
    /// they were before the frame.
    virtual StepControl
    advance(double length) = 0;

    /// Copy the particles.
    virtual void
    fetch(ParticleState<dim> &state) const = 0;

    virtual Balance<dim>
    balance() const = 0;

    /// What the passes of the last sub-step computed, to compare executors with each other.
    virtual std::vector<PassResult>
    pass_results() const = 0;

    /// Of the matrix of the last sub-step; of fluid only.
    virtual Throughput
    throughput() = 0;

    /// Where and in what precision it computes.
    virtual std::string
    describe() const = 0;

    /// Measure seconds() from now on, which costs a little.
    virtual void
    time_phases() = 0;

    /// Seconds by phase since time_phases().
    virtual std::vector<std::pair<std::string, double>>
    seconds() const = 0;
  };

  enum class Precision
  {
    single_precision,
    double_precision
  };

  /// Makes engines of one kind of machine.
  template <int dim>
  class EngineFactory
  {
  public:
    virtual ~EngineFactory() = default;

    /// Why this program on this machine cannot make them; empty if it can. `device`: the number of
    /// the graphics processor; means nothing on the host.
    virtual std::string
    reason_not_available(unsigned int device) const = 0;

    /// Throws InputError, with the reason, if this machine cannot.
    virtual std::unique_ptr<Engine<dim>>
    make(Precision precision, unsigned int device) const = 0;
  };
} // namespace undine::particles

#endif
