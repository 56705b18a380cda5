// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/divided_differences.h>

#include <cmath>
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double turning_frequency = 2;  // [rad/s]
  constexpr double length_of_run     = 20; // of a run [s]

  /// A bar of one linear element between guides: its end swings by sin(frequency t), if pushed.
  std::string
  bar(const std::string &integrator, const std::string &time, const std::string &more)
  {
    return section("Time", "set Step = 0.5\nset Maximum cuts = 12\n" + time) +
           section("Bodies",
                   body("bar",
                        fmt::format("set Upper corner = 1, 1\nset Cells = 1, 1\nset Density = 1\n"
                                    "set Material = linear elastic\nset Poisson's ratio = 0\n"
                                    "set Young's modulus = {}\n",
                                    turning_frequency * turning_frequency / 3) +
                          more,
                        clamp("wall", "1", "set Sides = left") +
                          clamp("guides", "1", "set Components = y"))) +
           section("Solid numerics", "set Element degree = 1") +
           section("Time", "set Integrator = " + integrator);
  }


  std::string
  swinging(const std::string &integrator, const double tolerance)
  {
    return bar(integrator,
               fmt::format("set Tolerance = {}", tolerance),
               fmt::format("set Initial velocity = {}*x; 0\n", turning_frequency));
  }


  struct Run : CoupledRun<2>
  {
    explicit Run(const std::string &text)
      : CoupledRun<2>(text)
    {
      state.clock.end_time = length_of_run;
    }

    void
    advance()
    {
      report = scheme->step(state, scheme->choose_dt(state));
      state.clock.advance(report.dt);
    }

    double
    displacement() const
    {
      return 2 * (column("centre of mass bar x") - 0.5);
    }

    /// The largest error of the displacement over the run, whose amplitude is one.
    double
    largest_error()
    {
      double largest = 0;
      while (!state.clock.ended())
        {
          advance();
          largest = std::max(
            largest, std::abs(displacement() - std::sin(turning_frequency * state.clock.time)));
        }
      return largest;
    }
  };
} // namespace


TEST_CASE("derivative weights are exact for polynomials", "[coupled]")
{
  const std::vector<double> times{0.3, -1, 2, 0.7};
  const auto                weights = derivative_weights(times);
  double                    third = 0, second = 0;
  for (unsigned int i = 0; i < 4; ++i)
    {
      third += weights[i] * std::pow(times[i], 3);
      second += weights[i] * std::pow(times[i], 2);
    }
  CHECK(third == Approx(6));
  CHECK(second == Approx(0).margin(1e-12));
}


TEST_CASE("the first of steps by a tolerance is short, and can be cut", "[coupled]")
{
  Run run(swinging("newmark", 1e-3));
  run.advance();
  CHECK(run.report.dt == Approx(.5 / (1 << 10)));
}


TEST_CASE("a tolerance is met within a factor of two", "[coupled]")
{
  for (const std::string integrator : {"newmark", "generalised_alpha", "theta\nset Theta = 0.6"})
    for (const double tolerance : {3e-2, 1e-2, 1e-3})
      {
        if (integrator[0] == 't' && tolerance < 1e-2)
          continue; // 60000 steps of first order
        Run          run(swinging(integrator, tolerance));
        const double error = run.largest_error();
        INFO(integrator << " " << tolerance << ": " << error << " in " << run.state.clock.step);
        CHECK(error > tolerance / 2);
        CHECK(error < tolerance * 2);
        CHECK(run.column("Error in time") == Approx(error).epsilon(0.5));
      }
}


TEST_CASE("without a tolerance steps are constant, to the bit", "[coupled]")
{
  const std::string push = "set Initial velocity = x; 0\n";
  Run               zero(bar("newmark", "set Tolerance = 0", push));
  Run               none(bar("newmark", "", push));
  for (unsigned int step = 0; step < 10; ++step)
    {
      zero.advance();
      none.advance();
      CHECK(zero.report.dt == 0.5);
      CHECK(zero.displacement() == none.displacement());
    }
  CHECK(!zero.state.history.in_use());
  CHECK(!zero.report.error_in_time);
}


TEST_CASE("chosen steps land on the times of output", "[coupled][mpi]")
{
  Run run(swinging("newmark", 1e-2));
  run.state.clock.landing_interval = 0.3;
  run.state.clock.end_time         = 6;
  unsigned int landings            = 0;
  while (!run.state.clock.ended())
    {
      const double next = run.state.clock.next_landing();
      run.advance();
      CHECK(run.state.clock.time <= next);
      landings += run.state.clock.time == next;
    }
  CHECK(landings == 20);
}


TEST_CASE("a sudden load is met with shorter steps", "[coupled][mpi]")
{
  const auto load = boundary("end", "right", "traction", "set Traction = if(t > 5.2, 0.2, 0); 0");
  auto       text = bar("newmark", "set Tolerance = 1e-2", "");
  text.insert(text.find("subsection wall"), load);
  Run          loaded(text);
  double       longest = 0, shortest = 1;
  unsigned int rejections = 0;
  while (loaded.state.clock.time < 5.2)
    {
      loaded.advance();
      rejections += loaded.report.rejections;
      longest  = std::max(longest, loaded.report.dt);
      shortest = rejections > 0 ? std::min(shortest, loaded.report.dt) : shortest;
    }
  CHECK(longest == 0.5);
  CHECK(rejections > 1);
  CHECK(shortest < 0.05);
  CHECK(loaded.column("Rejected steps") == loaded.report.rejections);
}


TEST_CASE("a copied state continues with the same steps", "[coupled][mpi]")
{
  Run first(swinging("newmark", 1e-2));
  for (unsigned int step = 0; step < 60; ++step)
    first.advance();
  Run second(swinging("newmark", 1e-2));
  second.state = first.state;
  for (unsigned int step = 0; step < 60; ++step)
    {
      first.advance();
      second.advance();
      CHECK(second.report.dt == first.report.dt);
    }
  CHECK(second.displacement() == first.displacement());
}


TEST_CASE("steps that may not be as short as the tolerance takes are reported", "[coupled]")
{
  auto text = swinging("newmark", 1e-4);
  text.replace(text.find("cuts = 12"), 9, "cuts = 2");
  Run         run(text);
  std::string notes;
  while (!run.state.clock.ended())
    {
      const auto before = run.report.warnings;
      run.advance();
      for (const auto &text : new_warnings(run.report.warnings, before))
        notes += text;
    }
  CHECK(notes.find("Time/Maximum cuts") != std::string::npos);
  CHECK(notes.find("Time/Maximum cuts") == notes.rfind("Time/Maximum cuts"));
}
