// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  std::string
  pushed_ball(const std::string &name, const std::string &where, const std::string &displacement)
  {
    return section(name,
                   "set Shape = ball\nset Centre = " + where + "\nset Radius = .15\n" +
                     "set Displacement = " + displacement);
  }


  std::string
  tank(const std::string &cells)
  {
    return section("Domain", "set Upper corner = 2, 1\nset Cells = " + cells);
  }
} // namespace


TEST_CASE("A region without a compliant body keeps its fluid beside coupled bodies",
          "[coupled][mpi]")
{
  // Behind a wall a ball stirs fluid that has no outlet.
  CoupledRun<2> run(
    steps_of(.05) + section("Output", "set Budget = true") + tank("16, 8") +
    section("Fluid",
            "set Density = 1000\n" + section("Boundaries", boundary("out", "left", "outflow"))) +
    section("Bodies",
            body("sheet",
                 "set Lower corner = .5, -.05\nset Upper corner = .55, .5\nset Cells = 1, 4\nset "
                 "Density = 1000\nset Young's modulus = 1e6\nset Poisson's ratio = .3",
                 clamp("foot", "-y"))) +
    section("Obstacles",
            section("wall", "set Lower corner = 1, -1\nset Upper corner = 1.1, 2") +
              pushed_ball("stirrer", "1.55, .5", ".1*sin(5*t); 0")) +
    section("Effects", convection()));
  for (unsigned int n = 0; n < 6; ++n)
    {
      run.step();
      CHECK(run.column("Fluid divergence") <= 1e-7);
      CHECK(run.column("energy closure") <= 1e-8);
      CHECK(run.column("momentum closure") <= 1e-9);
    }
  CHECK(std::abs(run.column("energy by obstacles")) > 1e-3);
}


TEST_CASE("Supports hold what pressure does, with every integrator", "[coupled]")
{
  for (const auto &name : Registry<TimeIntegrator>::instance().names())
    {
      INFO(name);
      CoupledRun<2> run(
        steps_of(.02) + stream_to_the_right<2>("12, 12", 1, 1) +
        section("Bodies",
                body("block",
                     "set Lower corner = .6, .3\nset Upper corner = .9, .6\nset Cells = 2, 2\nset "
                     "Density = 10\nset Young's modulus = 1e4\nset Poisson's ratio = .3",
                     clamp("all", "1", "set Sides = left, right, bottom, top"))) +
        section("Effects", convection()) +
        section("Solid numerics", "set Element degree = 1\nset Linear solver = direct") +
        section("Time", "set Integrator = " + name));
      run.step();
      run.step();
      const double force = run.column("pressure force block x");
      CHECK(std::abs(force) > 1e-3);
      CHECK(run.column("reaction block/all x") == Approx(-force).epsilon(1e-6));
    }
}


TEST_CASE("A step that cannot be cut into open air ends with the reason, however often it is tried",
          "[coupled][mpi]")
{
  CoupledRun<2> run(
    steps_of(.05) + tank("32, 16") +
    section("Fluid",
            "set Density = 1000\n" + section("Boundaries", boundary("out", "left", "outflow")) +
              section("Void regions", section("air", "set Seed = 1.7, .5"))) +
    section("Obstacles",
            section("wall", "set Lower corner = .95, -1\nset Upper corner = 1.05, .5") +
              section("door",
                      "set Lower corner = .9, .4\nset Upper corner = 1.1, 2\nset Displacement = 0; "
                      ".5*t") +
              pushed_ball("stirrer", "1.35, .25", ".02*sin(4*t); 0")));
  const auto open_the_door = [&] {
    for (unsigned int n = 0; n < 12; ++n)
      run.step();
  };
  CHECK_THROWS_WITH(open_the_door(), Catch::Matchers::Contains("void region 'air'"));
}


TEST_CASE("Nothing remembers the motion of an obstacle that has stopped", "[coupled][mpi]")
{
  const auto force = [](const std::string &creep) {
    CoupledRun<2> run(
      steps_of(.05) + stream_to_the_right<2>("16, 16", 1, 1) +
      section("Obstacles", pushed_ball("ball", ".3, .43", "2*min(t, .1) + " + creep + "*t; 0")) +
      section("Effects", convection()));
    for (unsigned int n = 0; n < 20; ++n)
      run.step();
    return run.column("pressure force ball x");
  };
  const double stopped = force("0");
  CHECK(std::abs(stopped) > .01);
  CHECK(stopped == Approx(force("1e-13")).epsilon(.03));
}
