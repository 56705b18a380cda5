// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  /// A chamber of 2 x 1 (x 1) with an outlet at the right.
  template <int dim>
  std::string
  chamber()
  {
    return section("Domain",
                   plane_or_space<dim>("set Upper corner = 2, 1\nset Cells = 27, 13",
                                       "set Upper corner = 2, 1, 1\nset Cells = 18, 9, 7")) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Pressure solver", "set Divergence tolerance = 1e-13") +
                     section("Boundaries", boundary("out", "right", "outflow")));
  }


  template <int dim>
  double
  fluid_volume(const ObstacleRun<dim> &run)
  {
    auto one = run.state.fluid.pressure;
    for_each_value(one, [](double &value, const auto &, const auto &) { value = 1; });
    // Where no fluid is there is no volume either.
    set_means(one, run.models.fluid->grid());
    return integral(*run.models.fluid, one);
  }


  /// What leaves through the outlet in each step is what the thing has swept: `lost` [m^dim], given
  /// begin and end of the step.
  template <int dim, class Lost>
  void
  check_swept(const std::string &shape,
              const std::string &keys,
              const double       tolerance,
              const Lost        &lost)
  {
    ObstacleRun<dim> run(chamber<dim>(),
                         obstacle("thing", shape, keys),
                         convection() + section("scalar transport", section("smoke", "")),
                         .02);
    double           largest = 0;
    for (unsigned int n = 0; n < 25; ++n)
      {
        const double begin = run.state.clock.time;
        run.step();
        const double swept = lost(begin, begin + run.dt);
        INFO("step " << n + 1 << " of " << shape << " " << keys);
        REQUIRE(std::abs(run.column("Flux through out") * run.dt - swept) <= tolerance);
        REQUIRE(run.column("Flagged cells") == 0);
        largest = std::max(largest, std::abs(swept));
      }
    CHECK((largest > 1e-3 || tolerance > largest));
  }


  double
  path(const double time)
  {
    return .4 * std::pow(std::sin(2 * time), 2);
  }
} // namespace


TEST_CASE("A piston pushes out what it sweeps", "[coupled][mpi]")
{
  const auto lost = [](const double begin, const double end) { return path(end) - path(begin); };
  SECTION("2D")
  {
    check_swept<2>("box",
                   "set Lower corner = -1, -.1\nset Upper corner = .3, 1.1\nset Displacement = "
                   ".4*sin(2*t)^2; 0",
                   1e-13,
                   lost);
  }
  SECTION("3D")
  {
    check_swept<3>("box",
                   "set Lower corner = -1, -.1, -.1\nset Upper corner = .3, 1.1, 1.1\nset "
                   "Displacement = .4*sin(2*t)^2; 0; 0",
                   1e-13,
                   lost);
  }
}


TEST_CASE("A paddle inside moves fluid to and fro, but pushes none out", "[coupled][mpi]")
{
  const auto nothing = [](double, double) { return 0.; };
  SECTION("2D, translating")
  {
    check_swept<2>("box",
                   "set Lower corner = .3, -.1\nset Upper corner = .35, .8\nset Displacement = "
                   ".4*sin(2*t)^2; 0",
                   1e-13,
                   nothing);
  }
  SECTION("2D, turning about its middle")
  {
    check_swept<2>("box",
                   "set Centre = .8, .5\nset Size = .02, .7\nset Rotation = 10\nset Cells = 1, 6\n"
                   "set Displacement = (cos(3*t)-1)*(x-.8) - sin(3*t)*(y-.5); sin(3*t)*(x-.8) + "
                   "(cos(3*t)-1)*(y-.5)",
                   1e-13,
                   nothing);
  }
  SECTION("3D")
  {
    check_swept<3>("box",
                   "set Lower corner = .3, -.1, .2\nset Upper corner = .35, .8, .9\nset "
                   "Displacement = .4*sin(2*t)^2; 0; 0",
                   1e-13,
                   nothing);
  }
}


TEST_CASE("A stirrer turns in a closed chamber", "[coupled][mpi]")
{
  const auto check = [](auto &&run) {
    for (unsigned int n = 0; n < 20; ++n)
      {
        run.step();
        REQUIRE(run.column("Fluid divergence") <= 1e-10);
        REQUIRE(run.column("Fluid largest speed") < 5);
      }
    CHECK(run.column("Fluid largest speed") > .1);
    CHECK(run.column("Integral of smoke") == Approx(.5).epsilon(.1));
  };
  const std::string smoke =
    convection() +
    section("scalar transport", section("smoke", "set Initial value = if(y>.5,1,0)"));
  const std::string turn = "(cos(4*t)-1)*(x-.5) - sin(4*t)*(y-.5); sin(4*t)*(x-.5) + "
                           "(cos(4*t)-1)*(y-.5)";
  SECTION("2D")
  {
    check(
      ObstacleRun<2>(section("Domain", "set Cells = 24, 24") + section("Fluid", "set Density = 1"),
                     obstacle("bar",
                              "box",
                              "set Centre = .5, .5\nset Size = .03, .7\nset Cells = 1, 8\nset "
                              "Displacement = " +
                                turn),
                     smoke,
                     .04));
  }
  SECTION("3D")
  {
    check(ObstacleRun<3>(section("Domain", "set Cells = 14, 14, 10") +
                           section("Fluid", "set Density = 1"),
                         obstacle("bar",
                                  "box",
                                  "set Centre = .5, .5, .5\nset Size = .05, .7, .4\nset Rotation = "
                                  "0, 30, 0\nset Cells = 1, 4, 3\nset Displacement = " +
                                    turn + "; 0"),
                         smoke,
                         .04));
  }
}
