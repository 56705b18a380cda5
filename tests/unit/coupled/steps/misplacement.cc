// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/misplacement.h>

#include <coupled/coupled_run.h>
#include <message_of.h>

using namespace undine_tests;
using Catch::Matchers::Contains;

namespace
{
  /// A block in water, with a pillar beside it that does not move.
  template <int dim>
  CoupledRun<dim>
  block_and_pillar(const double density)
  {
    return CoupledRun<dim>(
      steps_of(.01) +
      section("Domain", plane_or_space<dim>("set Cells = 8, 8", "set Cells = 8, 8, 8")) +
      section("Fluid",
              "set Density = 1000\n" + section("Boundaries", boundary("top", "top", "outflow"))) +
      section("Obstacles",
              obstacle("pillar",
                       "box",
                       plane_or_space<dim>("set Lower corner = .7, .2\nset Upper corner = .9, .6",
                                           "set Lower corner = .7, .2, .2\nset Upper corner = .9, "
                                           ".6, .6"))) +
      section("Bodies",
              body("block",
                   plane_or_space<dim>("set Lower corner = .2, .2\nset Upper corner = .5, .5\n"
                                       "set Cells = 1, 1\n",
                                       "set Lower corner = .2, .2, .2\nset Upper corner = .5, .5, "
                                       ".5\nset Cells = 1, 1, 1\n") +
                     fmt::format("set Density = {}\nset Young's modulus = 1e5\nset Poisson's "
                                 "ratio = .3",
                                 density))));
  }


  /// What is said of the first node, of the block, and of the last one, of the pillar.
  template <int dim>
  void
  check_complaints()
  {
    const auto complaint = [](const double density, const bool of_block) {
      const auto         run    = block_and_pillar<dim>(density);
      const auto         places = run.models.surface->positions(run.state.solid, 0);
      const unsigned int node   = of_block ? 0 : places.size() - 1;
      return misplacement_complaint(run.models, places, {{.62, 0}, {.5, 0}, {.41, node}});
    };
    for (const double density : {1., 1000.})
      CHECK_THAT(complaint(density, true),
                 Contains("'block'") && Contains("0.62, then 0.5, then 0.41 cells") &&
                   Contains(density == 1 ? "0.001 of the fluid's density" : "It has 1 of") &&
                   Contains("as well as better") && Contains("Theta = 1"));
    const auto of_dense = complaint(1001, true);
    CHECK_THAT(of_dense, Contains("'block'") && Contains("Try: a smaller 'Time / Step'"));
    CHECK_THAT(of_dense, Contains("square") && !Contains("density"));
    CHECK_THAT(complaint(1, false), Contains("'pillar'") && !Contains("density"));
  }
} // namespace


TEST_CASE("What ends a step elsewhere than the grid was cut is named, with what helps", "[coupled]")
{
  check_complaints<2>();
  check_complaints<3>();
}


TEST_CASE("A light block that shakes rises in long steps, none of which is cut", "[coupled]")
{
  const auto rise = [](const std::string &integrator) {
    return message_of([&] {
      CoupledRun<2> run(
        section("Time", "set Step = 1/10\nset Maximum cuts = 0\n" + integrator) +
        section("Domain", "set Cells = 20, 20") +
        section("Fluid",
                "set Density = 1000\n" +
                  section("Boundaries", boundary("top", "top", "pressure", "set Pressure = 0"))) +
        section("Bodies",
                body("block",
                     "set Lower corner = .3, .1\nset Upper corner = .7, .3\nset Cells = 8, "
                     "4\nset Density = 1\nset Young's modulus = 1e5\nset Poisson's ratio = .3")) +
        section("Effects", section("gravity", "set Acceleration = 0, -9.81") + convection()));
      while (run.column("centre of mass block y") < .9) // then its top is at the surface
        run.step();
    });
  };
  CHECK(rise("") == "no error"); // the grid is cut where it comes to, after some rounds
  CHECK(rise("set Integrator = theta\nset Theta = 1") == "no error");
}
