// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>
#include <message_of.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  turn(const double speed, const dealii::Point<dim> &centre)
  {
    return fmt::format("(cos({0}*t)-1)*(x-{1}) - sin({0}*t)*(y-{2}); sin({0}*t)*(x-{1}) + "
                       "(cos({0}*t)-1)*(y-{2})",
                       speed,
                       centre[0],
                       centre[1]) +
           plane_or_space<dim>("", "; 0");
  }


  template <int dim>
  ObstacleRun<dim>
  in_closed_box(const std::string &obstacles, const std::string &boundaries = "")
  {
    return ObstacleRun<dim>(
      section("Domain", "set Cells = " + std::string(plane_or_space<dim>("16, 16", "8, 8, 8"))) +
        section("Fluid", "set Density = 1\n" + section("Boundaries", boundaries)),
      obstacles,
      convection(),
      .05);
  }


  /// Obstacles without a change of volume.
  template <int dim>
  void
  check_runs(const std::string &shape, const std::string &keys)
  {
    INFO(dim << "D, " << shape << ' ' << keys);
    auto run = in_closed_box<dim>(obstacle("thing", shape, keys));
    for (unsigned int n = 0; n < 3; ++n)
      run.step();
    CHECK(run.column("Fluid divergence") <= 1e-10);
  }


  template <int dim>
  std::string
  corners(const double left, const double right)
  {
    return fmt::format(plane_or_space<dim>("set Lower corner = {}, -1\nset Upper corner = {}, 2\n",
                                           "set Lower corner = {}, -1, -1\nset Upper corner = {}, "
                                           "2, 2\n"),
                       left,
                       right);
  }
} // namespace


TEST_CASE("Rounding is no flux out of a closed region", "[coupled][mpi]")
{
  const std::string centre = "set Centre = .5, .5\n", in_space = "set Centre = .5, .5, .5\n";
  for (const double radius : {1e-3, 1e-7, 1e-8})
    {
      const auto size = fmt::format("set Radius = {}\nset Refinements = 3\n", radius);
      check_runs<2>("ball", centre + size + "set Displacement = .5*t; .1*t");
      check_runs<3>("ball", in_space + size + "set Displacement = .5*t; .1*t; 0");
    }
  for (const double speed : {1e-15, 1e-12, 1e-6})
    {
      const auto slowly = fmt::format("set Radius = .2\nset Displacement = {}*t; 0", speed);
      check_runs<2>("ball", centre + slowly);
      check_runs<3>("ball", in_space + "set Refinements = 2\n" + slowly + "; 0");
    }
  check_runs<2>("ball",
                "set Centre = .6875, .8125\nset Radius = .0625\nset Displacement = " +
                  turn<2>(1, {.6875, .8125}));
  check_runs<2>("box",
                "set Centre = .8125, .375\nset Size = 1e-6, .125\nset Displacement = " +
                  turn<2>(5, {.8125, .375}));
}


TEST_CASE("A rank whose cells an obstacle fills takes part in what all must do", "[coupled][mpi]")
{
  // On two and three ranks the obstacle has the whole block of one.
  for (const unsigned int axis : {0, 1})
    {
      INFO("the lower part along axis " << axis);
      const std::string upper = axis == 0 ? ".7, 2" : "2, .7";
      auto              run   = in_closed_box<2>(
        obstacle("pillar", "box", "set Lower corner = -1, -1\nset Upper corner = " + upper));
      run.step();
      CHECK(run.column("Fluid divergence") <= 1e-10);
      CHECK(run.column("Fluid largest speed") < 1e-10);
    }
}


TEST_CASE("A piston that retreats balances an inflow", "[coupled][mpi]")
{
  const auto check = [](auto dimension) {
    constexpr int     dim  = decltype(dimension)::value;
    const std::string zero = plane_or_space<dim>("; 0", "; 0; 0");
    auto              run  = in_closed_box<dim>(
      obstacle("piston", "box", corners<dim>(.8, 1.5) + "set Displacement = .3*t" + zero),
      boundary("in", "left", "inflow", "set Velocity = .3" + zero));
    run.step();
    run.step();
    CHECK(run.column("Fluid largest speed") == Approx(.3));
    CHECK(run.column("Flux through in") == Approx(-.3));
  };
  check(std::integral_constant<int, 2>());
  check(std::integral_constant<int, 3>());
}


TEST_CASE("Obstacles that push fluid which cannot leave are named with their fluxes",
          "[coupled][mpi]")
{
  using Catch::Matchers::Contains;
  const auto still = obstacle("wall", "box", corners<2>(.4, .45));
  const auto why   = message_of([&] {
    in_closed_box<2>(
      still + obstacle("piston", "box", corners<2>(.8, 1.5) + "set Displacement = -.3*t; 0") +
      obstacle(
        "elsewhere", "ball", "set Centre = .2, .5\nset Radius = .1\nset Displacement = 0; .1*t"));
  });
  CHECK_THAT(why,
             Contains("-0.3 m^2/s") && Contains("through 'Obstacles/piston' -0.3") &&
               Contains("through 'Obstacles/wall' 0,") && Contains("through boundaries 0") &&
               Contains("around (0.625, 0.5)") && Contains("Try:"));
  CHECK_THAT(why, !Contains("elsewhere"));
}
