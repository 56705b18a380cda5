// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A block of a ten thousandth of the water's density rises at 200 g to the open surface of a
  /// tank, and out of it, by more than its size within a step of 1/60 s.
  template <int dim>
  CoupledRun<dim>
  block_at_a_surface(const std::string &time)
  {
    return CoupledRun<dim>(
      section("Time", "set Step = 1/60\n" + time) +
      section("Domain",
              plane_or_space<dim>("set Cells = 14, 15",
                                  "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\n"
                                  "set Cells = 8, 9, 7")) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries", boundary("surface", "top", "pressure", "set Pressure = 0"))) +
      section("Solid numerics",
              plane_or_space<dim>("set Element degree = 2", "set Element degree = 1")) +
      section("Bodies",
              body("block",
                   plane_or_space<dim>("set Lower corner = .37, .61\nset Upper corner = .62, .83\n"
                                       "set Cells = 2, 2\n",
                                       "set Lower corner = .37, .61, .3\n"
                                       "set Upper corner = .62, .83, .6\nset Cells = 2, 2, 2\n") +
                     std::string("set Density = .1\nset Young's modulus = 1e8\n"
                                 "set Poisson's ratio = .2\n"))) +
      section("Effects",
              section("contact", "") +
                section("gravity",
                        plane_or_space<dim>("set Acceleration = 0, -2000",
                                            "set Acceleration = 0, -2000, 0"))));
  }


  template <int dim>
  double
  energy(const CoupledRun<dim> &run)
  {
    return run.column("Fluid kinetic energy") + run.column("solid kinetic energy") +
           run.column("solid elastic energy");
  }


  /// Until .1 s there is no more energy than the water has lost of height, as the block rose and as
  /// it was compressed.
  template <int dim>
  void
  check_fallback()
  {
    INFO(dim << "D");
    auto         run    = block_at_a_surface<dim>("");
    const double weight = 2000 * 999.9 * run.column("volume block");
    const double start  = run.column("centre of mass block y");
    const double volume = run.column("volume block"), depth = .83;
    double       rise = 0;
    unsigned int n    = 0;
    while (run.state.clock.time < .1)
      {
        run.step();
        rise                    = std::max(rise, run.column("centre of mass block y") - start);
        const double compressed = volume - run.column("volume block");
        CHECK(energy(run) < 1.01 * (weight * rise + 2000 * 1000 * depth * std::abs(compressed)));
        n += run.report.is_by_fallback;
        CHECK(run.state.clock.after_fallback == run.report.is_by_fallback);
        if (run.report.is_by_fallback)
          CHECK(run.report.dt < .51 / 60);
      }
    CHECK(n > 0);
  }


  /// Lets no stage pass that goes on with rates, at first, and then no other.
  template <int dim>
  class Refusal : public Effect<dim>
  {
  public:
    explicit Refusal(const double until)
      : until(until)
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
    accelerate(FluidStage<dim> &stage) const override
    {
      if (stage.stage.keeps_rates() == (stage.time < until))
        throw SolveError("refused");
    }

  private:
    const double until; ///< [s]
  };


  /// The first step is implicit Euler's, which would begin the next one, too.
  template <int dim>
  void
  check_last_resort()
  {
    INFO(dim << "D");
    const double step = 1. / 60;
    auto         run  = block_at_a_surface<dim>("");
    run.models.effects.push_back(std::make_unique<Refusal<dim>>(step / 8));
    run.step();
    CHECK(run.report.is_by_fallback);
    CHECK(run.report.dt == Approx(step / 4));
    run.step();
    CHECK(!run.report.is_by_fallback);
    CHECK(run.report.dt == Approx(step / 4));
    CHECK(run.report.cuts == 7); // 1/4 to 1/256, before stages are tried
  }
} // namespace


TEST_CASE("where stages cannot end a step, implicit Euler does", "[coupled]")
{
  check_fallback<2>();
  check_fallback<3>();
}


TEST_CASE("what implicit Euler cannot end at last, stages are tried for", "[coupled]")
{
  check_last_resort<2>();
  check_last_resort<3>();
}


TEST_CASE("steps fall back only where they fail, and if the scene allows it", "[coupled]")
{
  auto         run      = block_at_a_surface<2>("set Fallback = none");
  unsigned int cuts     = 0;
  const auto   has_gone = [&] {
    while (run.state.clock.time < .06)
      {
        run.step();
        cuts += run.report.cuts;
        if (run.report.is_by_fallback)
          return false;
      }
    return true;
  };
  CHECK(has_gone());
  CHECK(cuts > 0);
  auto calm = block_at_a_surface<2>("");
  calm.step();
  CHECK(calm.report.cuts == 0);
  CHECK(!calm.report.is_by_fallback);
}
