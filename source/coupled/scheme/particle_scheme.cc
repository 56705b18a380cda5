// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/interruption.h>
#include <undine/coupled/scheme/particle_scheme.h>
#include <undine/coupled/step/physics.h>
#include <undine/particles/execution/phases.h>
#include <undine/particles/setup/disorder.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  namespace
  {
    template <int dim>
    std::size_t
    count_fluid(const particles::ParticleState<dim> &state)
    {
      return std::count_if(state.tags.begin(), state.tags.end(), [](const auto tag) {
        return tag.kind() == particles::Kind::fluid;
      });
    }


    /// What went wrong in a frame without ending it.
    std::string
    complaint(const particles::StepControl &control)
    {
      std::vector<std::string> parts;
      if ((control.failures & static_cast<unsigned int>(particles::Failure::outside)) != 0)
        parts.push_back("a particle left the room");
      const auto add_solver = [&](const particles::SolverRecord &solver, const std::string &name) {
        if (solver.not_converged > 0)
          parts.push_back(
            fmt::format("the {} solver stopped above its tolerance in {} sub-step(s), "
                        "at worst at {:.2g}",
                        name,
                        solver.not_converged,
                        solver.worst_residual));
      };
      add_solver(control.pressure, "pressure");
      add_solver(control.faces, "faces'");
      return fmt::format("{}", fmt::join(parts, "; "));
    }


    /// How far a frame is, and what has bounded most of its sub-steps since `last`.
    std::string
    progress_of_frame(const particles::StepControl &now, const particles::StepControl &last)
    {
      // Counts begin again with every motion that seeks an equilibrium, and where a frame is
      // redone.
      const auto before = last.sub_steps <= now.sub_steps ? last : particles::StepControl();
      static const std::array<const char *, static_cast<int>(particles::Bound::count)> words{
        {"as long as allowed", "bounded by speed", "bounded by waves", "bounded by viscosity"}};
      unsigned int most = 0, which = 0;
      for (unsigned int bound = 0; bound < words.size(); ++bound)
        {
          const unsigned int times = now.bounded_by[bound] - before.bounded_by[bound];
          if (times > most)
            which = bound;
          most = std::max(most, times);
        }
      return fmt::format("{} sub-steps, {:.1f} % of the frame; now {:.3g} s each, {}",
                         now.sub_steps,
                         100 * now.elapsed / now.frame,
                         now.dt,
                         words[which]);
    }


    /// Where places of single precision are so coarse that strains of bodies suffer; empty if
    /// nowhere.
    template <int dim>
    std::string
    note_of_rounding(const particles::ParticleState<dim> &state, const double spacing)
    {
      constexpr double much     = 3e-4; // of the spacing: the error of a strain
      double           farthest = 0;
      for (const auto &position : state.positions)
        for (unsigned int d = 0; d < dim; ++d)
          farthest = std::max(farthest, std::abs(position[d]));
      const double rounding = std::numeric_limits<float>::epsilon() * farthest / spacing;
      if (rounding <= much)
        return "";
      return fmt::format("\nnote: particles are up to {:.3g} m from the origin, where single "
                         "precision knows their places to {:.1g} of the spacing. Try: the origin "
                         "in the middle of the domain, or 'Precision = double'",
                         farthest,
                         rounding);
    }
  } // namespace


  bool
  seeks_equilibrium(const Options &scene)
  {
    auto words = Registry<TimeIntegrator>::instance().names();
    words.push_back("sub-steps");
    std::string word = words.back();
    scene.section("Time").add(
      "Integrator",
      word,
      "",
      Allowed::one_of(words),
      "static: the equilibrium of bodies under the loads at the end of each Step, without a fluid, "
      "in "
      "double precision. "
      "All others are those of other schemes and not read: particles move in sub-steps.");
    return word == "static";
  }


  template <int dim>
  void
  ParticleScheme<dim>::add_options(const Options &options)
  {
    is_static = seeks_equilibrium(options);
    if (is_static && options.section("Fluid").given())
      options.mistake(options.section("Time").error(
        "Integrator",
        "'static' seeks an equilibrium of bodies, but the scene has a fluid, which moves under "
        "loads that bodies withstand",
        "Remove the key, and try a later 'Time / End': motion dies away by itself."));
    options.section("Time").add("Step",
                                frame,
                                "s",
                                Allowed::positive(),
                                "Length of a frame, which is computed in as many sub-steps as it "
                                "needs; statistics have one row for it.");
    if (options.is_reference())
      ParticleModel<dim>::declare(options);
  }


  template <int dim>
  Report
  ParticleScheme<dim>::initialize(State<dim> &state, const Models<dim> &models, TimingTree &tree)
  {
    model             = models.particles.get();
    timing            = &tree;
    const auto  names = Registry<particles::EngineFactory<dim>>::instance().joined_names();
    const auto &name  = model->numerics().executor;
    if (!Registry<particles::EngineFactory<dim>>::instance().contains(name))
      throw InputError("this program has no executor '" + name +
                       "' for particles; it has: " + names);
    // What is left to move in an equilibrium is less than single precision resolves.
    engine = Registry<particles::EngineFactory<dim>>::instance().make(name)->make(
      is_static ? particles::Precision::double_precision : model->numerics().precision,
      model->numerics().device);

    state.particles = model->initial_state();
    particles::disorder(model->setup(), state.particles);
    load(state);
    if (name == "host")
      engine->time_phases(); // which costs nothing there
    if (is_static && model->setup().n_moving > 0)
      throw InputError("Time / Integrator = static: obstacles that move have no equilibrium. Try: "
                       "remove the key, or the obstacles' 'Displacement'.");
    scalars.emplace(models.effects, *model);
    Report report;
    fetch(state.particles, report, particles::StepControl());
    scalars->start(state.particles);
    append(report.columns, scalars->columns(state.particles));
    if (is_static)
      append(report.columns, {{"Stops", "1", 0}, {"Released energy over elastic energy", "1", 0}});
    report.note = engine->describe();
    for (const auto &remark : model->notes())
      report.note += "\nnote: " + remark;
    if (!is_static && model->numerics().precision == particles::Precision::single_precision)
      report.note += note_of_rounding(state.particles, model->domain().spacing);
    if (scalars->longest_frame() < frame)
      report.note +=
        fmt::format("\nnote: frames are {:.3g} s long at most, instead of 'Time / Step': "
                    "what flows in gets its scalars once a frame, and the layers behind "
                    "an inflow must not go by in one",
                    scalars->longest_frame());
    return report;
  }


  template <int dim>
  double
  ParticleScheme<dim>::choose_dt(const State<dim> &state) const
  {
    return state.clock.land(std::min(frame, scalars->longest_frame()));
  }


  template <int dim>
  void
  ParticleScheme<dim>::follow(const typename Scheme<dim>::Follower &new_follower)
  {
    constexpr double pause = 1; // [s]
    follower               = new_follower;
    if (follower)
      engine->watch([this](const particles::StepControl &control) { return tell(control); }, pause);
    else
      engine->watch({}, pause);
  }


  template <int dim>
  bool
  ParticleScheme<dim>::tell(const particles::StepControl &control)
  {
    const bool goes_on = follower(progress_of_frame(control, told));
    told               = control;
    return goes_on;
  }


  template <int dim>
  Report
  ParticleScheme<dim>::step(State<dim> &state, const double dt)
  {
    const auto timed = timing->section("particles");
    load(state);
    is_loaded = false; // until the frame is known to be good
    Report report;
    report.dt    = dt;
    told         = particles::StepControl();
    auto fetched = state.particles; // which stay as they are if the frame is no good
    particles::StepControl control;
    if (is_static)
      {
        Relaxation<dim> relaxation(*engine, model->setup());
        control = relax(relaxation, fetched);
        fetch(fetched, report, control);
        append(report.columns,
               {{"Stops", "1", double(relaxation.stops())},
                {"Released energy over elastic energy", "1", relaxation.released()}});
      }
    else
      {
        engine->move_walls(model->wall_paths(state.clock.time, dt));
        control = advance(state, dt);
        fetch(fetched, report, control);
      }
    scalars->follow(fetched, state.particles, state.clock.time, dt, *timing);
    append(report.columns, scalars->columns(fetched));
    assert_finite(report.columns);
    report.linear_iterations = control.pressure.iterations;
    report.note              = complaint(control);
    if (!model->has_openings() && count_fluid(fetched) < count_fluid(state.particles))
      report.note += fmt::format("{}{} particle(s) of fluid left the room around the domain",
                                 report.note.empty() ? "" : "; ",
                                 count_fluid(state.particles) - count_fluid(fetched));
    state.particles = std::move(fetched);
    auto clock      = state.clock; // as the driver will advance it
    clock.advance(dt);
    is_loaded   = true;
    loaded_time = clock.time;
    collect_seconds();
    return report;
  }


  template <int dim>
  particles::StepControl
  ParticleScheme<dim>::advance(const State<dim> &state, const double dt)
  {
    try
      {
        return engine->advance(dt);
      }
    catch (const particles::FrameAbandoned &)
      {
        throw_if_interrupted(model->communicator());
        throw; // the follower has reasons of its own
      }
    catch (const SolveError &reason)
      {
        if (!model->is_nearly_full(count_fluid(state.particles)))
          throw;
        throw SolveError(std::string(reason.what()) +
                         " Fluid flows into the domain and nowhere out, and it is nearly full: try "
                         "an outflow, an open side or an earlier 'Time / End'.");
      }
  }


  template <int dim>
  particles::StepControl
  ParticleScheme<dim>::relax(Relaxation<dim>               &relaxation,
                             particles::ParticleState<dim> &particles) const
  {
    try
      {
        return relaxation.relax(particles);
      }
    catch (const particles::FrameAbandoned &)
      {
        throw_if_interrupted(model->communicator());
        throw;
      }
    catch (const SolveError &reason)
      {
        throw SolveError("an equilibrium was sought ('Time / Integrator = static'), which is only "
                         "where every body is held: " +
                         std::string(reason.what()));
      }
  }


  template <int dim>
  void
  ParticleScheme<dim>::load(const State<dim> &state)
  {
    if (is_loaded && loaded_time == state.clock.time)
      return;
    engine->load(model->setup(), state.particles);
    is_loaded   = true;
    loaded_time = state.clock.time;
    seconds.clear();
  }


  template <int dim>
  void
  ParticleScheme<dim>::fetch(particles::ParticleState<dim> &particles,
                             Report                        &report,
                             const particles::StepControl  &control) const
  {
    engine->fetch(particles);
    report.columns = particle_columns(*model, control, engine->balance(), particles);
  }


  template <int dim>
  void
  ParticleScheme<dim>::collect_seconds()
  {
    for (const auto &[phase, total] : engine->seconds())
      {
        if (total == 0 || phase == name_of(particles::Phase::other))
          continue; // the rest of the section says how long the others took
        timing->add(phase, total - seconds[phase]);
        seconds[phase] = total;
      }
  }


  template <int dim>
  Columns
  particle_columns(const ParticleModel<dim>            &model,
                   const particles::StepControl        &control,
                   const particles::Balance<dim>       &balance,
                   const particles::ParticleState<dim> &state)
  {
    using particles::Bound;
    const auto bounded_by = [&](const Bound bound) {
      return double(control.bounded_by[static_cast<int>(bound)]);
    };
    Columns    columns{{"Sub-steps", "1", double(control.sub_steps)},
                    {"Smallest sub-step", "s", control.smallest_dt},
                    {"Sub-steps as long as allowed", "1", bounded_by(Bound::asked)},
                    {"Sub-steps bounded by speed", "1", bounded_by(Bound::speed)},
                    {"Sub-steps bounded by waves", "1", bounded_by(Bound::waves)},
                    {"Sub-steps bounded by viscosity", "1", bounded_by(Bound::viscosity)},
                    {"Elastic sub-steps", "1", double(control.elastic_steps_total)},
                    {"Most pressure iterations", "1", double(control.pressure.most_iterations)},
                    {"Worst pressure residual", "1", control.pressure.worst_residual},
                    {"Face iterations", "1", double(control.faces.iterations)},
                    {"Fluid particles", "1", double(count_fluid(state))},
                    {"Fluid particles in bodies", "1", double(balance.fluid_in_bodies)},
                    {"Largest speed", "m/s", control.fastest},
                    {"Kinetic energy of fluid", "J", balance.kinetic_fluid},
                    {"Kinetic energy of bodies", "J", balance.kinetic_solid},
                    {"Potential energy", "J", balance.potential},
                    {"Elastic energy", "J", balance.elastic}};
    const auto add_vector = [&](const std::string                    &name,
                                const std::string                    &unit,
                                const particles::Vector<dim, double> &vector) {
      for (int axis = 0; axis < dim; ++axis)
        columns.push_back({name + " " + char('x' + axis), unit, vector[axis]});
    };
    add_vector("Momentum", "kg m/s", balance.momentum);
    for (std::size_t body = 0; body < model.body_names().size(); ++body)
      {
        const auto &name = model.body_names()[body];
        columns.push_back(
          {"Volume of " + name + " over that at rest", "1", balance.body_volumes[body]});
        add_vector("Centre of " + name, "m", balance.body_centres[body]);
        add_vector("Velocity of " + name, "m/s", balance.body_velocities[body]);
      }
    return columns;
  }


  template class ParticleScheme<2>;
  template class ParticleScheme<3>;
  template Columns
  particle_columns(const ParticleModel<2> &,
                   const particles::StepControl &,
                   const particles::Balance<2> &,
                   const particles::ParticleState<2> &);
  template Columns
  particle_columns(const ParticleModel<3> &,
                   const particles::StepControl &,
                   const particles::Balance<3> &,
                   const particles::ParticleState<3> &);


  namespace
  {
    const RegisterForDimensions<Scheme, ParticleScheme>
      registered_particle_scheme("particle",
                                 "Fluid and elastic bodies of particles, coupled by one pressure.");
  }
} // namespace undine
