// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/contact/contact_course.h>

#include <message_of.h>

using namespace undine_tests;

namespace
{
  /// A block of `velocity` in a thin fluid in a box, open at the right; `aside` [m] moves it
  /// against the grid.
  template <int dim>
  std::string
  flying_block(const std::string &velocity,
               const double       aside,
               const std::string &contact,
               const std::string &boundaries = "",
               const std::string &openings   = "set Sides = right\nset Kind = outflow")
  {
    const auto corners = [&](const double x, const double y) {
      return fmt::format(plane_or_space<dim>("{}, {}", "{}, {}, {}"), x, y, y);
    };
    return elements<dim>() + section("Output", "set Budget = true") +
           section("Domain", plane_or_space<dim>("set Cells = 10, 10", "set Cells = 8, 8, 8")) +
           section("Fluid",
                   "set Density = 1\n" + section("Boundaries", section("openings", openings))) +
           section("Bodies",
                   body("block",
                        "set Lower corner = " + corners(.2 + aside, .3 + aside) +
                          "\nset Upper corner = " + corners(.5 + aside, .6 + aside) +
                          "\nset Cells = " + plane_or_space<dim>("3, 3", "2, 2, 2") +
                          "\nset Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = "
                          ".3\nset Initial velocity = " +
                          velocity + "\n",
                        boundaries)) +
           section("Effects", contact);
  }


  template <int dim>
  void
  check_bounce(const double dt, const double aside)
  {
    INFO(dim << "D, steps of " << dt << ", moved by " << aside);
    CoupledRun<dim> run(steps_of(dt) + flying_block<dim>(plane_or_space<dim>("-2; 0", "-2; 0; 0"),
                                                         aside,
                                                         section("contact", "")));
    const double    before   = run.column("solid momentum x");
    const auto      in_all   = [&] { return energy(run) + run.column("Fluid kinetic energy"); };
    const double    start    = in_all();
    double          touching = 0;
    for (int n = std::lround(.32 / dt); n > 0; --n)
      {
        run.step();
        touching = std::max(touching, run.column("nodes in contact"));
        CHECK(run.column("least gap") > 0);
        CHECK(in_all() <= start * (1 + 1e-9));
      }
    CHECK(touching > 0);
    CHECK(run.column("centre of mass block x") > .1);
    // It flies back, with what vibrations have left of its speed.
    CHECK(run.column("solid momentum x") > -.2 * before);
  }
} // namespace


TEST_CASE("a block bounces off a side of the domain and gains no energy", "[contact]")
{
  for (const double aside : {0., .0137})
    {
      check_bounce<2>(.04, aside);
      check_bounce<2>(.02, aside);
      check_bounce<2>(.01, aside);
    }
  check_bounce<3>(.04, .0137);
}


TEST_CASE("what ends on a side of symmetry stays there, with contact and without", "[contact]")
{
  const auto shifted = [](const std::string &contact) {
    CoupledRun<2> run(
      steps_of(.02) +
      flying_block<2>("0; -1",
                      -.2,
                      contact,
                      section("end", "set Kind = clamp\nset Sides = left\nset Components = x")));
    for (unsigned int n = 0; n < (contact.empty() ? 3 : 12); ++n)
      run.step();
    const BodySurface<2> surface(*run.models.solid);
    const auto           rest  = surface.positions(run.models.solid->vector());
    const auto           now   = surface.positions(run.state.solid.displacement);
    double               least = 1;
    for (unsigned int node = 0; node < rest.size(); ++node)
      {
        if (std::abs(rest[node][0]) < 1e-12)
          CHECK(now[node][0] == rest[node][0]);
        else
          CHECK(now[node][0] > 0);
        least = std::min(least, now[node][1]);
      }
    return least;
  };
  shifted("");
  CHECK(shifted(section("contact", "")) > 0);
}


TEST_CASE("a body that passes a wall or enters an obstacle without contact is an error",
          "[contact]")
{
  using Catch::Contains;
  const auto message = [](const std::string &scene, const std::string &more = "") {
    CoupledRun<2> run(steps_of(.04) + scene + more);
    return message_of([&] {
      for (unsigned int n = 0; n < 12; ++n)
        run.step();
    });
  };
  CHECK_THAT(message(flying_block<2>("-2; 0", 0, "")),
             Contains("body 'block' passes the wall at side 'left'") && Contains("by 0.12 s") &&
               Contains("Try: a subsection 'Effects/contact'"));
  const std::string pillar =
    section("Obstacles", obstacle("pillar", "ball", "set Centre = .08, .42\nset Radius = .05"));
  CHECK_THAT(message(flying_block<2>("-2; 0", 0, ""), pillar),
             Contains("body 'block' runs into obstacle 'pillar'"));
  CHECK(message(flying_block<2>("-2; 0", 0, section("contact", "")), pillar) == "no error");

  // Sides that are open in part: through the opening, and beside it.
  const std::string open = "set Sides = left\nset Kind = outflow\nset Region = ";
  CHECK(message(flying_block<2>("-2; 0", 0, "", "", open + "y-.2")) == "no error");
  CHECK_THAT(message(flying_block<2>("-2; 0", 0, section("contact", ""), "", open + "y-.75")),
             Contains("passes the wall at side 'left'") && Contains("'Effects/contact/Walls'"));
}


/// A soft strip that stands in the floor, by `foot` if that is a boundary, bent over by `angle`, is
/// thrown down, or slides down through the floor, with the vertical velocity `thrown` [m/s].
template <int dim>
std::string
strip_in_floor(const double       angle,
               const std::string &thrown,
               const std::string &foot    = "",
               const std::string &effects = "")
{
  const double radius = .6 / angle;
  const auto   arc    = [&](const std::string &what) {
    return fmt::format(fmt::runtime("if(y>0, " + what + ", 0)"), fmt::arg("R", radius));
  };
  return steps_of(.01) +
         section("Domain", "set Cells = " + plane_or_space<dim>("16, 16", "16, 16, 4")) +
         section("Fluid",
                 "set Density = 1\n" +
                   section("Boundaries",
                           section("openings", "set Sides = right, top\nset Kind = outflow"))) +
         section("Bodies",
                 body("strip",
                      "set Lower corner = " + plane_or_space<dim>(".3, -.1", ".3, -.1, .4") +
                        "\nset Upper corner = " + plane_or_space<dim>(".35, .6", ".35, .6, .6") +
                        "\nset Cells = " + plane_or_space<dim>("1, 14", "1, 14, 1") +
                        "\nset Density = 1000\nset Young's modulus = 1e3\nset Poisson's ratio = .3"
                        "\nset Initial displacement = " +
                        arc("({R}-x+.325)*(1-cos(y/{R}))") + "; " +
                        arc("({R}-x+.325)*sin(y/{R})-y") + plane_or_space<dim>("", "; 0") +
                        "\nset Initial velocity = 0; " + thrown + plane_or_space<dim>("", "; 0"),
                      foot)) +
         effects;
}


template <int dim>
static void
check_strip_in_floor()
{
  using Catch::Contains;
  const auto message = [](const std::string &scene) {
    CoupledRun<dim> run(scene);
    return message_of([&] {
      for (unsigned int n = 0; n < 10; ++n)
        run.step();
    });
  };
  CHECK_THAT(message(strip_in_floor<dim>(2.6, "if(y>.4, -3, 0)")),
             Contains("body 'strip' passes the wall at side 'bottom'"));
  CHECK(message(strip_in_floor<dim>(1e-3, "-2")) == "no error");
}


/// With contact a strip that is thrown at the floor in which it is clamped bounces off, and one
/// that a support draws down slides through.
template <int dim>
static void
check_foot_in_floor()
{
  const auto             contact = section("Effects", section("contact", ""));
  const auto             foot    = section("foot", "set Kind = clamp\nset Where = -y");
  CoupledRun<dim>        thrown(strip_in_floor<dim>(2.6, "if(y>.4, -1, 0)", foot, contact));
  const BodySurface<dim> surface(*thrown.models.solid);
  const auto             rest    = surface.positions(thrown.models.solid->vector());
  double                 touches = 0, least = 1;
  const auto   in_all = [&] { return energy(thrown) + thrown.column("Fluid kinetic energy"); };
  const double start  = in_all();
  for (unsigned int n = 0; n < 20; ++n)
    {
      thrown.step();
      CHECK(in_all() <= start * (1 + 1e-9));
      touches        = std::max(touches, thrown.column("nodes in contact"));
      const auto now = surface.positions(thrown.state.solid.displacement);
      for (unsigned int node = 0; node < rest.size(); ++node)
        if (rest[node][1] > 1e-9)
          least = std::min(least, now[node][1]);
    }
  CHECK(touches > 0);
  CHECK(least > 0);

  CoupledRun<dim> drawn(strip_in_floor<dim>(
    1e-3,
    "-2",
    section("foot",
            "set Kind = prescribed motion\nset Where = -y\nset Displacement = 0; -2*t" +
              plane_or_space<dim>("", "; 0")),
    contact));
  for (unsigned int n = 0; n < 5; ++n)
    drawn.step();
  CHECK(drawn.column("centre of mass strip y") == Approx(.25 - 2 * .05).margin(.01));
}


TEST_CASE("a body that is clamped in a wall is in contact with that elsewhere", "[contact]")
{
  check_foot_in_floor<2>();
  check_foot_in_floor<3>();
}


TEST_CASE("a body that stands in a wall passes it there and nowhere else", "[contact]")
{
  check_strip_in_floor<2>();
  check_strip_in_floor<3>();
}
