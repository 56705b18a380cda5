// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_particle_engine_h
#define undine_particles_engine_particle_engine_h

#include <undine/particles/engine/energy_bound.h>
#include <undine/particles/engine/engine.h>
#include <undine/particles/engine/failures.h>
#include <undine/particles/engine/measure_balance.h>
#include <undine/particles/engine/pace.h>
#include <undine/particles/engine/particle_system.h>
#include <undine/particles/engine/state_transfer.h>
#include <undine/particles/execution/phases.h>
#include <undine/particles/setup/check_state.h>

#include <algorithm>
#include <optional>
#include <type_traits>

namespace undine::particles
{
  /// The engine over an executor. Matrix entries are `Entry`; if neighbours turn out to be too far
  /// apart in memory for them, they are WideEntry from then on.
  template <class Executor, int dim, class Real, class Entry>
  class ParticleEngine : public Engine<dim>
  {
  public:
    explicit ParticleEngine(std::unique_ptr<Executor> executor)
      : executor(std::move(executor))
    {
    }

    void
    load(const Setup<dim> &new_setup, const ParticleState<dim> &state) override
    {
      check_state(new_setup, state);
      setup = new_setup;
      paths.clear();
      measure_layers(state);
      energy_bound = EnergyBound<dim>(setup, state);
      load(state, frames_in_reserve * entering(0));
    }

    void
    move_walls(const WallPaths<dim> &paths_of_frame) override
    {
      if (static_cast<int>(paths_of_frame.size()) != setup.n_moving)
        throw InputError("paths are for another number of moving particles than the scene has.");
      paths = paths_of_frame;
    }

    void
    watch(Look look_, const double pause) override
    {
      look = std::move(look_);
      pace.set_pause(look ? pause : 0);
    }

    /// A frame that fails, or in which more energy appears than can, is repeated with shorter
    /// sub-steps before it is given up.
    StepControl
    advance(const double length) override
    {
      make_room(length);
      const Balance<dim> before = balance();
      for (double shortening = 1;; shortening *= 2)
        {
          const StepControl control = attempt(length, shortening);
          std::string       reason  = control.failures != 0
                                        ? reason_of_failure(control)
                                        : energy_bound.reason_of_excess(before, balance(), length);
          if (reason.empty())
            {
              energy_bound.accept(before, balance());
              if (setup.has_openings())
                inflow_speed = std::max(inflow_speed, control.fastest);
              paths.clear();
              return control;
            }
          with_system(
            [&](auto &present) { snapshot->restore(present.arrays(), present.elastic()); });
          last_balance = before;
          if (shortening >= most_shortening || !depends_on_length(control))
            throw SolveError(reason);
        }
    }

    void
    fetch(ParticleState<dim> &state) const override
    {
      const bool can_go_around =
        std::any_of(setup.periodic, setup.periodic + dim, [](const bool is) { return is; });
      state.body_points.clear();
      with_system([&](auto &present) {
        give_state(state, present.arrays(), present.elastic());
        if (can_go_around)
          state.body_points = points_of_bodies(present.elastic());
      });
    }

    Balance<dim>
    balance() const override
    {
      if (last_balance)
        return *last_balance;
      Balance<dim> result;
      with_system([&](auto &present) {
        BalanceSheet<Executor, dim, Real> sheet(*executor, setup);

        result                 = sheet(present.arrays().view(), present.elastic().view());
        result.fluid_in_bodies = sheet.count_fluid_in_bodies(present.neighbours(), n);
      });
      last_balance = result;
      return result;
    }

    std::vector<PassResult>
    pass_results() const override
    {
      std::vector<PassResult> results;
      with_system([&](auto &present) { results = present.pass_results(); });
      return results;
    }

    Throughput
    throughput() override
    {
      Throughput result;
      with_system([&](auto &present) { result = present.throughput(); });
      return result;
    }

    std::string
    describe() const override
    {
      return executor->describe() + (sizeof(Real) == 4 ? ", single" : ", double") + " precision";
    }

    void
    time_phases() override
    {
      executor->time_phases();
    }

    std::vector<std::pair<std::string, double>>
    seconds() const override
    {
      constexpr int                               n_phases = static_cast<int>(Phase::count);
      std::vector<std::pair<std::string, double>> result;
      result.reserve(n_phases);
      for (int k = 0; k < n_phases; ++k)
        result.emplace_back(name_of(static_cast<Phase>(k)),
                            executor->seconds(static_cast<Phase>(k)));
      return result;
    }

  private:
    using Wide = WideEntry<Real>;

    template <class AnyEntry>
    using System = ParticleSystem<Executor, dim, Real, AnyEntry>;

    template <class Function>
    void
    with_system(const Function &f) const
    {
      if (system != nullptr)
        f(*system);
      else if (wide != nullptr)
        f(*wide);
    }

    ReferenceLattice<dim, Real>
    lattice() const
    {
      return ReferenceLattice<dim, Real>(setup);
    }

    /// Take up a state and park `n_parked` particles.
    void
    load(const ParticleState<dim> &state, const int n_parked)
    {
      executor->set_threads(setup.numerics.threads);
      n                = static_cast<int>(state.positions.size()) + n_parked;
      n_parked_at_load = n_parked;
      last_balance.reset();
      snapshot.reset();
      system.reset();
      wide.reset();
      system   = std::make_unique<System<Entry>>(*executor, setup, lattice(), n);
      snapshot = std::make_unique<Snapshot<Executor, dim, Real>>(
        *executor, n, system->elastic().n, static_cast<int>(setup.bodies.size()));
      take_state(system->arrays(), system->elastic(), state);
    }

    /// How many particles can flow in during a frame, at most.
    int
    entering(const double frame) const
    {
      double depth = 0;
      for (const auto &side : setup.open_sides)
        if (side.is_inflow || side.is_opening)
          depth = depth > 0 ? std::min(depth, side.depth) : side.depth;
      return n_in_layers == 0 ? 0
                              : static_cast<int>(n_in_layers * (2 + inflow_speed * frame / depth));
    }

    /// Look at the layers behind inflows and openings. Through openings fluid may enter as fast as
    /// anything moves.
    void
    measure_layers(const ParticleState<dim> &state)
    {
      n_in_layers  = 0;
      inflow_speed = 0;
      for (std::size_t i = 0; i < state.tags.size(); ++i)
        {
          n_in_layers += state.tags[i].is_in_layers() ? 1 : 0;
          if (state.tags[i].material() == inflow_material ||
              (setup.has_openings() && state.tags[i].is_free()))
            inflow_speed = std::max(inflow_speed, std::sqrt(norm_square(state.velocities[i])));
        }
    }

    /// Park more particles if those that wait might not last for a frame.
    void
    make_room(const double frame)
    {
      if (n_in_layers == 0)
        return;
      int parked = n_parked_at_load.value_or(0);
      if (!n_parked_at_load)
        with_system([&](auto &present) { parked = present.count_parked(); });
      if (parked >= entering(frame))
        return;
      ParticleState<dim> state;
      fetch(state);
      load(state, frames_in_reserve * entering(frame));
    }

    static bool
    has(const StepControl &control, const Failure failure)
    {
      return (control.failures & static_cast<unsigned int>(failure)) != 0;
    }

    /// Might shorter sub-steps have done better?
    static bool
    depends_on_length(const StepControl &control)
    {
      return !has(control, Failure::matrix_indices) && !has(control, Failure::no_reserve);
    }

    /// The frame with matrix entries that reach far enough.
    StepControl
    attempt(const double length, const double shortening)
    {
      last_balance.reset();
      n_parked_at_load.reset();
      if (system != nullptr)
        {
          snapshot->save(system->arrays(), system->elastic());
          const StepControl control = attempt(*system, length, shortening);
          if (!has(control, Failure::matrix_indices))
            return control;
          system.reset();
          wide = std::make_unique<System<Wide>>(*executor, setup, lattice(), n);
          snapshot->restore(wide->arrays(), wide->elastic());
        }
      snapshot->save(wide->arrays(), wide->elastic());
      return attempt(*wide, length, shortening);
    }

    /// What it does depends on the particles only, so that a saved state continues as the run that
    /// saved it.
    template <class AnySystem>
    void
    begin(AnySystem &present, const double length, const double shortening)
    {
      StepControl fresh;
      fresh.frame      = length;
      fresh.shortening = shortening;
      if (static_cast<int>(paths.size()) != setup.n_moving)
        throw InputError("it is not said how walls move in this frame.");
      energy_bound.wall_speed = fastest(paths, length);
      atomic_maximum(&fresh.largest_speed, static_cast<float>(energy_bound.wall_speed));
      StepControl *control = present.begin_frame(fresh, paths);
      executor->for_each(n, MeasureSpeed<dim, Real>{present.arrays().view(), control});
      present.prepare();
    }

    /// Sub-steps are enqueued in batches of as many as the last one lets expect, or, if somebody
    /// looks, as fit between two looks. What is enqueued beyond the end of the frame does nothing:
    /// how they are cut into batches does not matter.
    template <class AnySystem>
    StepControl
    attempt(AnySystem &present, const double length, const double shortening)
    {
      begin(present, length, shortening);
      StepControl control;
      int         batch = expected;
      do
        {
          batch = pace.at_most(batch);
          pace.start();
          for (int k = 0; k < batch; ++k)
            present.sub_step();
          executor->enter(Phase::other);
          control = present.read_control();
          pace.stop(batch);
          batch = control.sub_steps_left(most_in_a_batch);
          if (batch > 0 && control.failures == 0 && look && pace.is_due() && !look(control))
            abandon(present);
        }
      while (batch > 0 && control.failures == 0);
      ChooseStep{&control, {}}(0); // looks at the last speed, too
      expected = std::clamp(static_cast<int>(control.sub_steps), 1, most_in_a_batch);
      return control;
    }

    template <class AnySystem>
    [[noreturn]] void
    abandon(AnySystem &present)
    {
      snapshot->restore(present.arrays(), present.elastic());
      last_balance.reset();
      throw FrameAbandoned("the frame was abandoned.");
    }

    static constexpr double most_shortening = 8;

    static constexpr int most_in_a_batch   = 64;
    static constexpr int frames_in_reserve = 8;

    std::unique_ptr<Executor>                      executor;
    Setup<dim>                                     setup;
    int                                            n        = 0;
    int                                            expected = 1; ///< sub-steps of the next frame
    Look                                           look;         ///< empty: nobody does
    Pace                                           pace;
    int                                            n_in_layers = 0; ///< behind inflows and openings
    double                                         inflow_speed = 0; ///< of what may enter [m/s]
    std::optional<int>                             n_parked_at_load; ///< none: they have moved
    WallPaths<dim>                                 paths;            ///< of this frame
    EnergyBound<dim>                               energy_bound;
    mutable std::optional<Balance<dim>>            last_balance; ///< of the present particles
    std::unique_ptr<System<Entry>>                 system;
    std::unique_ptr<System<Wide>>                  wide; ///< instead of `system`
    std::unique_ptr<Snapshot<Executor, dim, Real>> snapshot;
  };


  /// An engine in a precision; single precision packs its matrices.
  template <class Executor, int dim, class Real>
  std::unique_ptr<Engine<dim>>
  make_particle_engine(std::unique_ptr<Executor> executor)
  {
    using Entry = std::conditional_t<sizeof(Real) == 4, PackedEntry, WideEntry<Real>>;
    return std::make_unique<ParticleEngine<Executor, dim, Real, Entry>>(std::move(executor));
  }
} // namespace undine::particles

#endif
