// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_scheme_relaxation_h
#define undine_coupled_scheme_relaxation_h

#include <undine/particles/engine/engine.h>

namespace undine
{
  /// Equilibria of bodies of particles by dynamic relaxation with kinetic damping: the bodies move
  /// freely, and whenever their kinetic energy has passed a maximum, they are stopped. Near an
  /// equilibrium that maximum is what was left above the least energy. They are in equilibrium if,
  /// once stopped, they get no more of it than `tolerance` of their elastic energy in the time in
  /// which the slowest mode would turn its share into motion. Errors of displacements are of the
  /// order of the root of the tolerance.
  /// [A. S. Day, The Engineer 219, 1965; P. A. Cundall, 1976; M. R. Barnes, Computers and
  /// Structures 30, 1988, doi:10.1016/0045-7949(88)90089-1]
  template <int dim>
  class Relaxation
  {
  public:
    static constexpr double       tolerance   = 1e-8;
    static constexpr unsigned int most_pieces = 20000; ///< in which an equilibrium is sought

    /// The engine holds the particles to be moved.
    Relaxation(particles::Engine<dim> &engine, const particles::Setup<dim> &setup);

    /// Bring `state`, which is what the engine holds, into equilibrium, and the engine with it.
    /// Returns sums over all sub-steps. Throws SolveError if that takes too long or a frame fails.
    particles::StepControl
    relax(particles::ParticleState<dim> &state);

    /// How often the bodies were stopped.
    unsigned int
    stops() const
    {
      return n_stops;
    }

    /// The largest kinetic energy since the last stop over the elastic energy [1].
    double
    released() const
    {
      return released_share;
    }

  private:
    void
    stop(particles::ParticleState<dim> &state);

    /// In which the slowest mode rises from rest to its largest speed: Rayleigh's quotient for the
    /// deflection from the shape at rest [s].
    double
    time_to_rise(const particles::ParticleState<dim> &state, double elastic) const;

    /// An explicit step of the fastest body [s].
    double
    explicit_step() const;

    particles::Engine<dim>      &engine;
    const particles::Setup<dim> &setup;
    unsigned int                 n_stops        = 0;
    double                       released_share = 0;
  };
} // namespace undine

#endif
