// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <effects/effect_samples.h>

using namespace undine_tests;

namespace
{
  constexpr unsigned int n_steps = 3;


  std::string
  scene_with(const EffectSample &sample, const std::string &own_section)
  {
    return sample.scene + section("Effects", sample.others + own_section);
  }


  /// What is wrong with an effect that the scene does not call for: it must not leave a trace.
  std::vector<std::string>
  complaints_when_off(const std::string &name, const EffectSample &sample)
  {
    std::vector<std::string> complaints;
    SampleRun                known(scene_with(sample, ""));
    const auto               hidden = Registry<Effect<2>>::instance().hide(name);
    SampleRun                unknown(scene_with(sample, ""));
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        known.step();
        unknown.step();
      }
    if (numbers_of(known.state) != numbers_of(unknown.state))
      complaints.push_back("is off, but the state differs from that of a program without it");
    if (known.timing.work_of(name).calls != 0)
      complaints.push_back("is off, but a phase of its name was called");
    if (known.timing.memory.of(name).peak != 0)
      complaints.push_back("is off, but has memory");
    return complaints;
  }


  /// What is wrong with the budget of a step: its sum must be what fluid and bodies have gained, as
  /// the states show it.
  std::vector<std::string>
  complaints_about_budget(const SampleRun &before, const SampleRun &after)
  {
    double gain = 0, size = 0, by_terms = 0;
    for (const std::string name :
         {"Fluid kinetic energy", "solid kinetic energy", "solid elastic energy", "contact energy"})
      if (after.has(name))
        {
          gain += after.column(name) - before.column(name);
          size = std::max({size, after.column(name), before.column(name)});
        }
    for (const auto &term : {"transport",
                             "forces",
                             "diffusion",
                             "boundary values",
                             "sides",
                             "openings",
                             "loads",
                             "supports",
                             "damping",
                             "contact",
                             "integrator",
                             "sleep"})
      if (const std::string name = std::string("energy by ") + term; after.has(name))
        by_terms += after.column(name);
    if (!(std::abs(gain - by_terms) <= 1e-9 * size))
      return {fmt::format(
        "leaves the budget open: {:.12g} J gained, {:.12g} J by all terms", gain, by_terms)};
    if (!(after.column("energy closure") <= 1e-9 && after.column("momentum closure") <= 1e-9))
      return {fmt::format("leaves the budget open: closures {:.3g} and {:.3g}",
                          after.column("energy closure"),
                          after.column("momentum closure"))};
    return {};
  }


  /// What is wrong with what an effect that is on shows of its work.
  std::vector<std::string>
  complaints_when_on(const std::string &name, const EffectSample &sample)
  {
    std::vector<std::string> complaints;
    const std::string        text = scene_with(sample, section(name, sample.keys));
    SampleRun                run(text), last(text), without(scene_with(sample, ""));
    const bool               on_particles = run.scene.models.particles != nullptr;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        if (n > 0)
          last.step();
        run.step();
        without.step();
        if (on_particles)
          continue;
        for (const auto &complaint : complaints_about_budget(last, run))
          complaints.push_back(complaint);
      }
    if (!sample.moves_nothing && numbers_of(run.state) == numbers_of(without.state))
      complaints.push_back("is on, but the state is that without it");
    if (!on_particles && run.timing.work_of(name).calls == 0)
      complaints.push_back("is on, but no phase bears its name: open one where it works, "
                           "'const auto timed = step.timing.section(this->name);'");
    if (!on_particles && !run.has("energy by " + name))
      complaints.push_back("has no term 'energy by " + name + "' in the budget");
    const std::string column = sample.column.empty() ? "energy by " + name : sample.column;
    if (!sample.energy)
      complaints.push_back("has a sample without a formula: give EffectSample::energy");
    else if (!run.has(column))
      complaints.push_back("has no column '" + column + "'");
    else
      {
        const double value = run.column(column), expected = sample.energy(last, run);
        const double size = std::max(std::abs(value), std::abs(expected));
        if (!(std::abs(value - expected) <= sample.tolerance * size)) // nor is what is no number
          complaints.push_back(fmt::format(
            "column '{}' is {:.12g}, its formula gives {:.12g}", column, value, expected));
        if (!(size >= 1e-6))
          complaints.push_back(fmt::format(
            "column '{}' is {:.3g}: a sample in which it does something, please", column, value));
      }
    return complaints;
  }


  /// Everything that the contract of effects asks for.
  std::vector<std::string>
  complaints_about(const std::string &name, const EffectSamples &samples)
  {
    const auto sample = samples.find(name);
    if (sample == samples.end())
      return {"has no sample: add a scene in which it acts, and the formula of its energy, to "
              "tests/unit/effects/effect_samples.h"};
    auto       all  = complaints_when_off(name, sample->second);
    const auto more = complaints_when_on(name, sample->second);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }


  /// One who forgets everything: the work is neither timed nor booked.
  template <int dim>
  class Careless : public Effect<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "";
    }
  };
} // namespace


TEST_CASE("an effect that is off leaves no trace, one that is on shows its work", "[effects]")
{
  const auto samples = effect_samples();
  for (const auto &name : Registry<Effect<2>>::instance().names())
    for (const auto &complaint : complaints_about(name, samples))
      FAIL_CHECK("the effect '" << name << "' " << complaint);
}


TEST_CASE("samples are of effects that there are, in both dimensions", "[effects]")
{
  CHECK(Registry<Effect<2>>::instance().names() == Registry<Effect<3>>::instance().names());
  for (const auto &[name, sample] : effect_samples())
    CHECK(Registry<Effect<2>>::instance().contains(name));
}


TEST_CASE("the contract says what an effect lacks", "[effects]")
{
  auto &registry = Registry<Effect<2>>::instance();
  registry.add("careless", "For this test.", [] { return std::make_unique<Careless<2>>(); });
  auto       samples = effect_samples();
  const auto all     = [&] {
    std::string text;
    for (const auto &complaint : complaints_about("careless", samples))
      text += complaint + "\n";
    return text;
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(all(), Contains("has no sample") && Contains("effect_samples.h"));
  samples["careless"] = {open_column(), "", ""};
  CHECK_THAT(all(),
             Contains("no phase bears its name") && Contains("without a formula") &&
               Contains("the state is that without it"));
  // A scene that calls for nothing else, so that the formula is what fails.
  samples["careless"].energy = [](const auto &, const auto &) { return 1.; };
  CHECK_THAT(all(), Contains("'energy by careless' is 0, its formula gives 1"));
  {
    const auto hidden = registry.hide("careless");
    CHECK_FALSE(registry.contains("careless"));
  }
  CHECK(registry.contains("careless"));
  // For other tests it has never been there.
  static const auto *const hidden_for_good = new Registry<Effect<2>>::Hidden(registry, "careless");
  CHECK(hidden_for_good != nullptr);
}
