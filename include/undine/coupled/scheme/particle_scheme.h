// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_scheme_particle_scheme_h
#define undine_coupled_scheme_particle_scheme_h

#include <undine/coupled/scheme/carried_scalars.h>
#include <undine/coupled/scheme/relaxation.h>
#include <undine/coupled/scheme/scheme.h>
#include <undine/particles/engine/engine.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

namespace undine
{
  /// Does a scene of particles ask for equilibria of its bodies (`Time / Integrator = static`)?
  bool
  seeks_equilibrium(const Options &scene);

  /// Fluid and bodies as particles: a step is a frame, which the engine makes in sub-steps that it
  /// chooses. The engine keeps the particles between frames; the state is a copy of them.
  template <int dim>
  class ParticleScheme : public Scheme<dim>
  {
  public:
    void
    add_options(const Options &options) override;

    typename Scheme<dim>::Method
    method() const override
    {
      return Scheme<dim>::Method::particles;
    }

    Report
    initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing) override;

    double
    choose_dt(const State<dim> &state) const override;

    void
    follow(const typename Scheme<dim>::Follower &follower) override;

    /// Throws Interruption or particles::FrameAbandoned if the follower wants that.
    Report
    step(State<dim> &state, double dt) override;

  private:
    /// Give the state to the engine, unless it is what the engine holds.
    void
    load(const State<dim> &state);

    /// A frame. Throws SolveError, with what the scene may have to do with it.
    particles::StepControl
    advance(const State<dim> &state, const double dt);

    /// Seek an equilibrium of what the engine holds. Throws SolveError if none is found.
    particles::StepControl
    relax(Relaxation<dim> &relaxation, particles::ParticleState<dim> &particles) const;

    /// Tell the follower how far the frame is. Returns false if it is to be abandoned.
    bool
    tell(const particles::StepControl &control);

    /// Copy the engine's particles, and what it says about them.
    void
    fetch(particles::ParticleState<dim> &particles,
          Report                        &report,
          const particles::StepControl  &control) const;

    /// Seconds by phase since the last call.
    void
    collect_seconds();

    double                                  frame     = 0.01;  ///< [s]
    bool                                    is_static = false; ///< each is an equilibrium
    const ParticleModel<dim>               *model     = nullptr;
    TimingTree                             *timing    = nullptr;
    std::unique_ptr<particles::Engine<dim>> engine;
    std::optional<CarriedScalars<dim>>      scalars;
    bool                                    is_loaded   = false;
    double                                  loaded_time = 0; ///< of the engine's particles [s]
    std::map<std::string, double>           seconds;         ///< so far
    typename Scheme<dim>::Follower          follower;        ///< empty: nobody
    particles::StepControl                  told;            ///< what it has been told last
  };

  /// The columns of the file `statistics`.
  template <int dim>
  Columns
  particle_columns(const ParticleModel<dim>            &model,
                   const particles::StepControl        &control,
                   const particles::Balance<dim>       &balance,
                   const particles::ParticleState<dim> &state);
} // namespace undine

#endif
