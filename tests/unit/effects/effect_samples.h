// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_effects_effect_samples_h
#define undine_tests_effects_effect_samples_h

#include <effects/sample_run.h>

#include <functional>
#include <map>
#include <numeric>

namespace undine_tests
{
  /// How the contract test tries an effect: a plane scene in which it acts, and what energy it
  /// gives in a step by a formula that looks at states only.
  struct EffectSample
  {
    std::string scene;       ///< without the section `Effects`
    std::string others;      ///< subsections of the other effects that it needs
    std::string keys;        ///< of its own subsection
    std::string column = ""; ///< of `statistics` that shows it, instead of "energy by NAME"

    /// What that column says after a step that began with `before` [J].
    std::function<double(const SampleRun &before, const SampleRun &after)> energy = {};
    double tolerance     = 1e-9;  ///< relative
    bool   moves_nothing = false; ///< neither fluid nor bodies
  };


  inline std::string
  sample_steps(const double dt)
  {
    return section("Time", fmt::format("set End = 10\nset Step = {}", dt)) +
           section("Output", "set Budget = true\nset Parts = ");
  }


  /// A fluid of density 2 in the unit square, open below and above, at rest.
  inline std::string
  open_column()
  {
    return sample_steps(0.02) +
           std::string(FluidText{
             "4, 6", boundary("open", "bottom, top", "pressure", "set Pressure = 0"), "", "", 2.});
  }


  /// Vortices in a periodic square.
  inline std::string
  vortices(const double dt)
  {
    return sample_steps(dt) +
           std::string(FluidText{"16, 16",
                                 boundary("around", "left, right, bottom, top", "periodic"),
                                 "sin(2*pi*x)*cos(2*pi*y); -cos(2*pi*x)*sin(2*pi*y)"});
  }


  /// A block of 0.5 kg that flies freely.
  inline std::string
  flying_block()
  {
    return sample_steps(0.01) +
           section("Bodies",
                   section("block",
                           "set Shape = box\nset Lower corner = 0, 0\nset Upper corner = 1, 1\n"
                           "set Cells = 2, 2\nset Density = 0.5\nset Material = neo-Hookean\n"
                           "set Young's modulus = 100\nset Poisson's ratio = 0.3\n"
                           "set Initial velocity = 1; 2"));
  }


  inline std::string
  drop_of_particles(const std::string &more)
  {
    return "set Scheme = particle\n" + section("Time", "set End = 1\nset Step = 0.01") +
           section("Output", "set Parts = ") +
           section("Particles", "set Spacing = 0.1\nset Precision = double\nset Threads = 1") +
           more;
  }


  /// How far the block has come in the step [m].
  inline dealii::Tensor<1, 2>
  displacement_of_block(const SampleRun &before, const SampleRun &after)
  {
    dealii::Tensor<1, 2> path;
    for (const unsigned int axis : {0, 1})
      {
        const std::string name = std::string("centre of mass block ") + "xy"[axis];
        path[axis]             = after.column(name) - before.column(name);
      }
    return path;
  }


  /// The default integrator's step (T9).
  struct DefaultStep
  {
    explicit DefaultStep(const SampleRun &after)
      : length(after.report.dt)
      , g((1 - std::sqrt(.5)) * length)
      , w(std::sqrt(2.) / 4 * length)
    {
    }

    /// The integral over the step of what has these values where it begins, between its stages and
    /// where it ends.
    double
    integral(const double begin, const double middle, const double end) const
    {
      return w * (begin + middle) + g * end;
    }

    /// What is between the stages of a quantity that decays with the rate `rate` [1/s].
    double
    decayed(const double begin, const double rate) const
    {
      return begin * (1 - g * rate) / (1 + g * rate);
    }

    double length, g, w; ///< [s]
  };


  /// Of a uniform acceleration of the open column, which hinders nothing, as a function of time.
  template <class Acceleration>
  double
  work_on_column(const SampleRun &before, const SampleRun &after, const Acceleration &acceleration)
  {
    const DefaultStep step(after);
    const double      mass = 2, end = after.state.clock.time, begin = end - step.length;
    const double      middle = begin + 2 * step.g;
    const auto        speed  = [&](const SampleRun &run) {
      return std::sqrt(2 * run.column("Fluid kinetic energy") / mass);
    };
    const double between = speed(before) + step.g * (acceleration(begin) + acceleration(middle));
    return mass * step.integral(acceleration(begin) * speed(before),
                                acceleration(middle) * between,
                                acceleration(end) * speed(after));
  }


  /// The gain that no other term of the fluid explains.
  inline double
  rest_of_gain(const SampleRun &after, const std::vector<std::string> &terms)
  {
    double rest = after.column("energy gain");
    for (const auto &term : terms)
      rest -= after.column("energy by " + term);
    return rest;
  }


  inline double
  loss_by_friction(const SampleRun &before, const SampleRun &after)
  {
    // v decays with the rate nu k^2, with the k^2 of the grid's own Laplacian.
    const DefaultStep step(after);
    const double      width = 1. / 16;
    const double square = 2 * (2 - 2 * std::cos(2 * dealii::numbers::PI * width)) / (width * width);
    const double rate   = 0.05 * square;
    const auto   energy = [](const SampleRun &run) { return run.column("Fluid kinetic energy"); };
    const double speed  = step.decayed(std::sqrt(2 * energy(before)), rate);
    return -2 * rate * step.integral(energy(before), speed * speed / 2, energy(after));
  }


  inline double
  potential_of_attraction(const SampleRun &, const SampleRun &after)
  {
    double sum = 0; // of c m |x|^2 / 2, c = 3
    for (std::size_t k = 0; k < after.state.particles.positions.size(); ++k)
      if (after.state.particles.tags[k].kind() == particles::Kind::fluid)
        sum += norm_square(after.state.particles.positions[k]);
    return 3 * 0.1 * 0.1 * sum / 2;
  }


  inline double
  kinetic_energy_of_particles(const SampleRun &run)
  {
    double sum = 0; // of m |v|^2 / 2
    for (std::size_t k = 0; k < run.state.particles.velocities.size(); ++k)
      if (run.state.particles.tags[k].kind() == particles::Kind::fluid)
        sum += norm_square(run.state.particles.velocities[k]);
    return 0.1 * 0.1 * sum / 2;
  }


  using EffectSamples = std::map<std::string, EffectSample>;


  inline void
  add_samples_of_bodies(EffectSamples &samples)
  {
    samples["gravity"] = {flying_block(),
                          "",
                          "set Acceleration = 3, -10",
                          "",
                          [](const auto &before, const auto &after) {
                            const auto path = displacement_of_block(before, after);
                            return 0.5 * (3 * path[0] - 10 * path[1]);
                          }};
    samples["damping"] = {
      flying_block(),
      "",
      "set Mass coefficient = 2",
      "",
      [](const auto &before, const auto &after) {
        const DefaultStep step(after);
        const auto   energy = [](const auto &run) { return run.column("solid kinetic energy"); };
        const double speed  = step.decayed(std::sqrt(energy(before)), 2);
        return -2 * 2 * step.integral(energy(before), speed * speed, energy(after));
      }};
    samples["sleep"] = {
      flying_block(),
      "",
      "set Speed = 10\nset Time = 0.02",
      "",
      [](const auto &before, const auto &) { return -before.column("solid kinetic energy"); }};
    samples["contact"] = {
      flying_block(),
      "",
      "set Activation distance = 0.05\n" +
        section("Walls", section("right", "set Point = 1.04, 0\nset Normal = -1, 0")),
      "",
      [](const auto &, const auto &after) {
        return rest_of_gain(after, {"integrator", "loads", "supports"});
      }};
  }


  inline void
  add_samples_of_columns(EffectSamples &samples)
  {
    const std::string gravity = section("gravity", "set Acceleration = 0, -10");
    const std::string heat =
      section("scalar transport", section("heat", "set Initial value = 2\nset Inflow value = 2"));
    samples["body force"] = {open_column(),
                             "",
                             section("Fluid", "set Force per volume = 0; 6*t"),
                             "",
                             [](const auto &before, const auto &after) {
                               return work_on_column(
                                 before, after, [](const double time) { return 3 * time; });
                             }};
    samples["buoyancy"]   = {
        open_column(),
        gravity + heat,
        section("heat", "set Expansion coefficient = 0.05\nset Reference value = 1"),
        "",
        [](const auto &before, const auto &after) {
        return work_on_column(before, after, [](const double) { return 0.5; });
      }};
    samples["scalar transport"] = {
      open_column(),
      "",
      section("heat", "set Initial value = 1\nset Source = 3"),
      "Integral of heat",
      [](const auto &, const auto &after) { return 1 + 3 * after.state.clock.time; },
      1e-9,
      true};
  }


  inline void
  add_samples_of_vortices(EffectSamples &samples)
  {
    samples["viscosity"] = {
      vortices(0.02), "", "set Dynamic viscosity = 0.05", "", loss_by_friction};
    samples["convection"] = {vortices(0.05), "", "", "", [](const auto &, const auto &after) {
                               return rest_of_gain(after, {"integrator"});
                             }};
    samples["vorticity confinement"] = {
      vortices(0.05), convection(), "set Strength = 2", "", [](const auto &, const auto &after) {
        return rest_of_gain(after, {"integrator", "convection"});
      }};
  }


  inline void
  add_samples_of_particles(EffectSamples &samples)
  {
    const std::string all_sides   = "set Open sides = left, right, bottom, top";
    samples["central attraction"] = {
      drop_of_particles(
        section("Domain", "set Lower corner = -2, -2\nset Upper corner = 2, 2\n" + all_sides) +
        section("Fluid", "set Density = 1\nset Region = 1 - x^2 - y^2")),
      "",
      "set Strength = 3",
      "Potential energy",
      potential_of_attraction};
    samples["wall friction"] = {
      drop_of_particles(section("Domain",
                                "set Lower corner = 0, 0\nset Upper corner = 2, 1\n"
                                "set Open sides = top") +
                        section("Fluid",
                                "set Density = 1\nset Region = 0.5 - y\n"
                                "set Initial velocity = 1; 0")),
      section("gravity", "set Acceleration = 0, -10"),
      "set Dynamic viscosity = 1e-3",
      "Kinetic energy of fluid",
      [](const auto &, const auto &after) { return kinetic_energy_of_particles(after); }};
  }


  /// Every registered effect has a sample here.
  inline EffectSamples
  effect_samples()
  {
    EffectSamples samples;
    add_samples_of_bodies(samples);
    add_samples_of_columns(samples);
    add_samples_of_vortices(samples);
    add_samples_of_particles(samples);
    return samples;
  }
} // namespace undine_tests

#endif
