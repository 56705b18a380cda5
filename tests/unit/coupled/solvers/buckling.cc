// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A slender column, light as a straw, stands in water between a fixed foot and a head that
  /// `motion` [m] moves. At the start it is shortened by `shortening` of its length, without having
  /// bent by more than a trace: far beyond Euler's load its tangent is indefinite, inertia
  /// included.
  std::string
  slender_column(const double       shortening,
                 const std::string &motion,
                 const std::string &cells,
                 const std::string &numerics)
  {
    const auto moved = fmt::format("1e-4 * sin(pi * y / .7)^2; -{:.17g} * (y + .05)", shortening);
    return steps_of(1. / 60) +
           section("Domain",
                   "set Lower corner = -.5, 0\nset Upper corner = .5, 1\nset Cells = 16, 16") +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries", boundary("open", "left, right", "outflow"))) +
           section("Bodies",
                   body("column",
                        "set Lower corner = -.01, -.05\nset Upper corner = .01, .7\nset Cells = " +
                          cells +
                          "\nset Density = 10\nset Young's modulus = 1e6\nset Poisson's ratio = "
                          ".3\nset Initial displacement = " +
                          moved,
                        clamp("foot", "-y") +
                          section("head",
                                  "set Sides = top\nset Kind = prescribed motion\nset Displacement "
                                  "= 0; " +
                                    motion))) +
           section("Effects", convection()) + section("Solid numerics", numerics) +
           section("Time", "set Integrator = theta\nset Theta = 1");
  }


  struct Buckled
  {
    double       sideways, energy_left;
    std::string  notes;
    unsigned int most_iterations = 0;
  };


  /// The column leaves its straight shape: two steps. By backward Euler.
  Buckled
  buckle(const std::string &numerics)
  {
    CoupledRun<2> run(slender_column(.1, "-.075", "4, 64", numerics));
    const double  start = run.column("solid elastic energy");
    Buckled       result;
    for (unsigned int n = 0; n < 2; ++n)
      {
        run.step();
        CHECK(run.report.cuts == 0);
        CHECK(run.column("Fluid divergence") <= 1e-10);
        CHECK(run.column("momentum residual column") <= 1e-9);
        for (const auto &warning : run.report.warnings)
          result.notes += warning.text;
        result.most_iterations =
          std::max(result.most_iterations,
                   static_cast<unsigned int>(run.column("Most iterations of a solve")));
      }
    result.sideways    = run.column("max speed column");
    result.energy_left = run.column("solid elastic energy") / start;
    return result;
  }
} // namespace


TEST_CASE("A column buckles in water: factors of an indefinite tangent do, multigrid gives way",
          "[coupled][mpi]")
{
  const std::string exact  = "\nset Inexact Newton = false";
  const auto        direct = buckle("set Linear solver = direct" + exact);
  CHECK(direct.notes == "");
  CHECK(direct.most_iterations <= 30);
  CHECK(direct.sideways > .2);
  CHECK(direct.energy_left < .9);

  const auto multigrid = buckle("set Linear solver = multigrid" + exact);
  CHECK(multigrid.notes.find("factorised") != std::string::npos);
  CHECK(multigrid.most_iterations <= 30);
  CHECK(multigrid.sideways == Approx(direct.sideways).epsilon(1e-6));
  CHECK(multigrid.energy_left == Approx(direct.energy_left).epsilon(1e-6));

  const auto inexact = buckle("");
  CHECK(inexact.notes == "");
  CHECK(inexact.most_iterations <= 30);
  CHECK(inexact.sideways == Approx(direct.sideways).epsilon(1e-6));
  CHECK(inexact.energy_left == Approx(direct.energy_left).epsilon(1e-6));
}


TEST_CASE("Supports that move by more than a cell in a step draw bodies in a fluid with them",
          "[coupled][mpi]")
{
  // Each of 16 cells is 47 mm long; the first step shortens the column by 60 mm.
  CoupledRun<2> run(slender_column(0, "-3.6 * t", "1, 16", ""));
  run.step();
  CHECK(run.report.cuts == 0);
  CHECK(run.column("momentum residual column") <= 1e-9);
}


TEST_CASE("What no step can do to a body in a fluid is cut, and said", "[coupled][mpi]")
{
  // The head passes the foot after 0.01 s.
  CoupledRun<2> run(slender_column(0, "-75 * t", "1, 16", "") +
                    section("Time", "set Maximum cuts = 3"));
  try
    {
      for (unsigned int n = 0; n < 100; ++n)
        run.step();
      FAIL("went through");
    }
  catch (const SolveError &error)
    {
      const std::string message = error.what();
      CHECK(message.find("inverted") != std::string::npos);
      CHECK(message.find("Maximum cuts = 3") != std::string::npos);
    }
  CHECK(run.state.clock.time < .01);
  CHECK(std::isfinite(run.column("solid elastic energy")));
}
