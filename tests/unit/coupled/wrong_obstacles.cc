// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  stream(const std::string &cells)
  {
    const std::string right = plane_or_space<dim>("1; 0", "1; 0; 0");
    return section("Domain", "set Cells = " + cells) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " + right + "\n" +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow")));
  }


  template <int dim>
  std::string
  beam_through_ball()
  {
    return obstacle("pillar",
                    "ball",
                    plane_or_space<dim>("set Centre = .45, .5", "set Centre = .45, .5, .5") +
                      "\nset Radius = .2\nset Refinements = 3") +
           obstacle(
             "beam",
             "box",
             plane_or_space<dim>(
               "set Lower corner = .5, .3\nset Upper corner = .9, .6\nset Displacement = -t; 0",
               "set Lower corner = .5, .3, .3\nset Upper corner = .9, .6, .6\nset "
               "Displacement = -t; 0; 0"));
  }


  template <int dim>
  void
  check_overlap(const std::string &cells)
  {
    ObstacleRun<dim> run(stream<dim>(cells),
                         beam_through_ball<dim>(),
                         convection() +
                           section("scalar transport", section("smoke", "set Initial value = 1")),
                         .01);
    for (unsigned int n = 0; n < 10; ++n)
      {
        run.step();
        CHECK(run.column("Flagged cells") > 0);
        for (const std::string word : {"'pillar'", "'beam'", "near ("})
          CHECK(run.report.note.find(word) != std::string::npos);
        REQUIRE(run.column("Fluid largest speed") < 1e4);
        CHECK(run.column("Fluid divergence") < 1e-6);
      }
  }
} // namespace


TEST_CASE("Obstacles that overlap are named, and the run goes on", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_overlap<2>("20, 20");
  }
  SECTION("3D")
  {
    check_overlap<3>("10, 10, 9");
  }
}


TEST_CASE("A motion that is no number is refused before the step", "[coupled][mpi]")
{
  ObstacleRun<2> run(stream<2>("8, 8"),
                     obstacle("pillar",
                              "ball",
                              "set Centre = .5, .5\nset Radius = .2\nset Displacement = "
                              ".1*sqrt(.06-t); 0"),
                     "",
                     .05);
  run.step();
  const auto message = message_of([&] { run.step(); });
  CHECK(message.find("'pillar'") != std::string::npos);
  CHECK(message.find("not a number") != std::string::npos);
}
