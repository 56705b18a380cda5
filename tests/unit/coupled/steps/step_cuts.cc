// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/scheme/scheme.h>

#include <coupled/obstacle_run.h>

#include <functional>

using namespace undine_tests;

namespace
{
  using Judge = std::function<void(double time, double dt)>;


  /// Pushes the fluid in steps that `judge` allows.
  class Push : public Effect<2>
  {
  public:
    explicit Push(const Judge &judge)
      : judge(judge)
    {
    }

    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "";
    }

    void
    accelerate(FluidStage<2> &step) const override
    {
      for (auto &component : step.state.velocity.components)
        for_each(component.owned(), [&](const auto &face) { component(face) += 1; });
      judge(step.time, step.dt);
    }

  private:
    Judge judge;
  };


  /// Counts the attempts at steps that effects may refuse.
  struct TryingRun
  {
    TryingRun(const double dt, const unsigned int maximum_cuts, const Judge &allow)
      : options(read_scene_text(
          section("Domain", "set Cells = 4, 4") + section("Fluid", "set Density = 1") +
          section("Time",
                  fmt::format("set Integrator = theta\nset Step = {}\nset Maximum cuts = {}",
                              dt,
                              maximum_cuts))))
      , scheme(Registry<Scheme<2>>::instance().make("simultaneous"))
    {
      scheme->add_options(options);
      models.fluid = std::make_unique<const FluidModel<2>>(options, MPI_COMM_WORLD);
      options.assert_all_used();
      models.effects.push_back(std::make_unique<Push>([this, allow](double time, double h) {
        ++attempts;
        allow(time, h);
      }));
      state.clock.end_time = 1;
      scheme->initialize(state, models, timing);
    }

    Report
    step()
    {
      const auto report = scheme->step(state, scheme->choose_dt(state));
      state.clock.advance(report.dt);
      return report;
    }

    /// Step until it fails; returns the message.
    template <class Error>
    std::string
    fail()
    {
      for (int n = 0; n < 1000; ++n)
        try
          {
            step();
          }
        catch (const Error &error)
          {
            return error.what();
          }
      return "";
    }

    double
    largest_speed() const
    {
      return largest_on_faces(state.fluid.velocity, [](const double v, const auto &, unsigned int) {
        return std::abs(v);
      });
    }

    const Options              options;
    std::unique_ptr<Scheme<2>> scheme;
    Models<2>                  models;
    TimingTree                 timing;
    State<2>                   state;
    int                        attempts = 0;
  };
} // namespace


TEST_CASE("A step that fails is redone with half its length", "[coupled][mpi]")
{
  TryingRun  run(.1, 3, [](const double time, const double dt) {
    if (time < .01 && dt > .03)
      throw SolveError("too fast");
  });
  const auto first = run.step();
  CHECK(first.cuts == 2);
  CHECK(first.dt == Approx(.025));
  // Why the last one was cut is told.
  REQUIRE(first.warnings.size() == 1);
  CHECK(first.warnings[0].text == "a step of 0.05 s was cut: too fast");
  // What went well, then twice as much up to what was asked for.
  std::vector<double> lengths;
  for (int n = 0; n < 4; ++n)
    lengths.push_back(run.step().dt);
  CHECK(lengths[0] == Approx(.025));
  CHECK(lengths[1] == Approx(.05));
  CHECK(lengths[2] == Approx(.1));
  CHECK(lengths[3] == Approx(.1));
}


TEST_CASE("Short of a time that no step gets past, steps do not become ever shorter",
          "[coupled][mpi]")
{
  for (const unsigned int cuts : {0, 3, 6})
    {
      TryingRun  run(.1, cuts, [](const double time, const double dt) {
        if (time + dt > .33)
          throw SolveError("here it ends");
      });
      const auto message = run.fail<SolveError>();
      CHECK(message.find("here it ends") != std::string::npos);
      CHECK(message.find(fmt::format("Maximum cuts = {}", cuts)) != std::string::npos);
      const double shortest = .1 / (1 << cuts);
      CHECK(message.find(fmt::format("none shorter than {:.4g} s", shortest)) != std::string::npos);
      // It has come as near as the shortest step gets, in no more attempts than that takes.
      CHECK(run.state.clock.time <= .33);
      CHECK(run.state.clock.time > .33 - shortest);
      CHECK(run.attempts <= 4 + 2 * static_cast<int>(cuts));
    }
}


TEST_CASE("What no smaller step can cure ends the run at once, the state before is kept",
          "[coupled][mpi]")
{
  TryingRun run(.1, 3, [](const double time, const double dt) {
    if (time + dt > .15)
      throw InputError("wrong from the start");
  });
  run.step();
  const double before = run.largest_speed();
  CHECK(run.fail<InputError>() == "wrong from the start");
  CHECK(run.attempts == 2);
  CHECK(run.largest_speed() == before);
}
