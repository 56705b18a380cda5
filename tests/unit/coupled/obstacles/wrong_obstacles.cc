// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  /// A stream along x; all speeds are of order 1.
  template <int dim>
  std::string
  stream(const std::string &cells, const double speed = 1)
  {
    return stream_to_the_right<dim>(cells, 1, speed);
  }


  template <int dim>
  std::string
  grid()
  {
    return plane_or_space<dim>("20, 20", "10, 10, 9");
  }


  template <int dim>
  std::string
  ball(const std::string &name, const double centre, const double radius, const double speed)
  {
    return obstacle(name,
                    "ball",
                    fmt::format(plane_or_space<dim>("set Centre = {0}, .5\nset Radius = {1}\nset "
                                                    "Displacement = {2}*t; 0",
                                                    "set Centre = {0}, .5, .5\nset Radius = "
                                                    "{1}\nset Displacement = {2}*t; 0; 0"),
                                centre,
                                radius,
                                speed) +
                      "\nset Refinements = 3");
  }


  template <int dim>
  std::string
  beam(const double left, const double speed)
  {
    return obstacle(
      "beam",
      "box",
      fmt::format(plane_or_space<dim>("set Lower corner = {0}, .3\nset Upper corner = .9, .6\nset "
                                      "Displacement = {1}*t; 0",
                                      "set Lower corner = {0}, .3, .3\nset Upper corner = .9, .6, "
                                      ".6\nset Displacement = {1}*t; 0; 0"),
                  left,
                  speed));
  }


  /// Over single pieces: means over faces would hide what comes out of a slit.
  template <int dim>
  double
  largest_speed(const ObstacleRun<dim> &run)
  {
    return largest_on_faces(run.state.fluid.velocity,
                            [](const double v, const auto &, unsigned int) { return std::abs(v); });
  }


  /// Obstacles 'pillar' and 'beam' or 'ball' that overlap all the time. Returns the largest speed.
  template <int dim>
  double
  speed_among(const std::string &obstacles, const double stream_speed)
  {
    ObstacleRun<dim> run(stream<dim>(grid<dim>(), stream_speed),
                         obstacles,
                         convection() +
                           section("scalar transport", section("smoke", "set Initial value = 1")),
                         .01);
    const auto       first   = run.report.warnings;
    auto             said    = first;
    double           largest = 0;
    REQUIRE(first.size() == 1);
    for (const std::string word : {"'b", "near (", "Try: "})
      CHECK(first.front().text.find(word) != std::string::npos);
    for (unsigned int n = 0; n < (dim == 2 ? 10 : 4); ++n)
      {
        run.step();
        CHECK(run.column("Flagged cells") > 0);
        // Not said again as long as the same overlap.
        for (const auto &text : new_warnings(run.report.warnings, said))
          CHECK(text != first.front().text);
        said = run.report.warnings;
        CHECK(run.column("Fluid divergence") <= 1e-10);
        largest = std::max(largest, largest_speed(run));
      }
    return largest;
  }


  template <int dim>
  void
  check_overlaps()
  {
    // Between surfaces that meet at an angle the fluid is pressed out with the speed of one over
    // the angle: nothing here is sharper than about a third.
    const double allowed = 6;
    const auto   pillar  = [](const double speed) { return ball<dim>("pillar", .45, .2, speed); };
    for (const double stream : {0., 1.})
      {
        INFO(dim << "D, stream " << stream);
        const auto speed = [&](const std::string &obstacles) {
          return speed_among<dim>(obstacles, stream);
        };
        CHECK(speed(pillar(0) + beam<dim>(.5, -1)) < allowed);
        CHECK(speed(pillar(1) + beam<dim>(.6, -1)) < allowed);
        CHECK(speed(pillar(0) + beam<dim>(.5, 1)) < allowed);
        CHECK(speed(pillar(-1) + beam<dim>(.5, -1)) < allowed);
        CHECK(speed(pillar(0) + ball<dim>("ball", .6, .1, -1)) < allowed);
        // At rest, or one in the other: nothing pushes the fluid.
        CHECK(speed(pillar(0) + beam<dim>(.5, 0)) <= allowed * stream);
        CHECK(speed(pillar(0) + ball<dim>("ball", .4, .07, 1)) <= allowed * stream);
      }
  }


  /// A box moves into another that covers its front but for a strip above: the union shrinks by
  /// what is covered, which the stream lacks at the outlet.
  template <int dim>
  void
  check_flux(const double overlap)
  {
    INFO(dim << "D, overlap " << overlap);
    const auto box = [](const std::string &name,
                        const double       left,
                        const double       right,
                        const double       upper,
                        const double       speed) {
      return obstacle(
        name,
        "box",
        fmt::format(plane_or_space<dim>("set Lower corner = {0}, .31\nset Upper corner = {1}, "
                                        "{2}\nset Displacement = {3}*t; 0",
                                        "set Lower corner = {0}, .31, .31\nset Upper corner = {1}, "
                                        "{2}, .61\nset Displacement = {3}*t; 0; 0"),
                    left,
                    right,
                    upper,
                    speed));
    };
    ObstacleRun<dim> run(stream<dim>(grid<dim>()),
                         box("front", .2, .5 + overlap, .61, 0) + box("back", .5, .7, .71, -1),
                         "",
                         .002);
    const double     depth = std::pow(.3, dim - 2), cell = dim == 2 ? .05 : .1;
    for (unsigned int n = 0; n < 3; ++n)
      {
        run.step();
        CHECK(run.column("Flagged cells") > 0);
        CHECK(largest_speed(run) < 6);
        CHECK(run.column("Flux through out") == Approx(1 - .3 * depth).margin(cell * depth / 4));
      }
  }
} // namespace


TEST_CASE("Obstacles that overlap push the fluid no faster than they move, but for a modest factor",
          "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_overlaps<2>();
  }
  SECTION("3D")
  {
    check_overlaps<3>();
  }
}


TEST_CASE("Both obstacles that overlap are named", "[coupled][mpi]")
{
  ObstacleRun<2> run(
    stream<2>(grid<2>()), ball<2>("pillar", .45, .2, 0) + beam<2>(.5, -1), "", .01);
  const std::string said  = "'beam' and 'pillar' overlap near (";
  const auto        first = run.report.warnings;
  REQUIRE(first.size() == 1);
  CHECK(first.front().text.find(said) == 0);
  run.step();
  CHECK(new_warnings(run.report.warnings, first).empty());
}


TEST_CASE("What moves inside another obstacle pushes no fluid", "[coupled][mpi]")
{
  for (const double overlap : {1e-8, .001, .02, .06})
    {
      check_flux<2>(overlap);
      check_flux<3>(overlap);
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
