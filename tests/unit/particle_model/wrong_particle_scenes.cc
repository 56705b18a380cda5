// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <message_of.h>

#include "particle_scene.h"

using namespace undine_tests;

namespace
{
  const std::string fluid_section = section("Fluid", "set Density = 1000");
  const std::string material =
    "set Density = 700\n set Young's modulus = 2e5\n set Poisson's ratio = "
    "0.4\n";

  std::string
  block(const std::string &name, const std::string &centre, const std::string &more = "")
  {
    return section(name, material + "set Centre = " + centre + "\n set Size = 2, 2\n" + more);
  }


  void
  check_message(const std::string &text, const std::vector<std::string> &expected)
  {
    const auto message = message_of([&] { read_particles<2>(text); });
    for (const auto &words : expected)
      CHECK_THAT(message, Catch::Matchers::Contains(words));
  }
} // namespace


TEST_CASE("particles: wrong domains are refused with what would do")
{
  const auto domain = [](const std::string &spacing, const std::string &keys) {
    return section("Particles", "set Spacing = " + spacing) +
           section("Domain", "set Lower corner = 0, 0\n set Upper corner = 1, 1\n" + keys) +
           fluid_section;
  };
  check_message(domain("0.3", ""), {"'Upper corner'", "3.33333 spacings", "0.9, 0.9"});
  check_message(domain("-0.1", ""), {"'Spacing'", "> 0"});
  check_message(domain("1e-6", ""), {"cubes", "larger spacing"});
  check_message(domain("0.1", "set Periodic sides = left"), {"'left'", "opposite 'right'"});
  check_message(domain("0.1", "set Periodic sides = left, right\n set Open sides = left"),
                {"'left'", "open as well"});
  check_message(domain("0.1", "set Open sides = back"), {"'Open sides'", "left"});
}


TEST_CASE("particles: wrong fluids are refused")
{
  const auto fluid = [](const std::string &keys) {
    return particle_box<2>(10) + section("Fluid", "set Density = 1000\n" + keys);
  };
  check_message(fluid("set Region = sqrt(x - 5)"), {"'Region'", "not a number at (0.5, 0.5)"});
  check_message(fluid("set Region = -1"), {"leaves no fluid"});
  check_message(fluid("set Initial velocity = 1/(x - 0.5); 0"),
                {"'Initial velocity'", "not a number at (0.5, 0.5)"});
  check_message(
    fluid(
      section("Shapes", section("column", "set Lower corner = 5, 5\n set Upper corner = 11, 7"))),
    {"out of the domain", "to (11, 5)"});
}


TEST_CASE("particles: wrong void regions are refused")
{
  const auto voids = [](const std::string &text) {
    return particle_box<2>(10) +
           section("Fluid", "set Density = 1000\n" + section("Void regions", text)) +
           section("Bodies", block("one", "5, 5"));
  };
  check_message(voids(section("air", "set Seed = 11, 5")),
                {"'Fluid/Void regions/air'", "'Seed'", "outside the domain"});
  check_message(voids(section("air", "set Seed = 5, 5")), {"'Seed'", "in a body"});
  check_message(voids(section("air", "set Seed = 1, 1\n set Pressure = 10")),
                {"'Pressure'", "there is no pressure", "Allowed: 0"});
  check_message(voids(section("air", "set Seed = 1, 1")), {"no fluid left"});
  check_message(voids(section("air", "set Seed = 1, 1") + section("more", "set Seed = 8, 8")),
                {"'Fluid/Void regions/more'", "same room"});
}


TEST_CASE("particles: wrong bodies are refused")
{
  const auto bodies = [](const std::string &text) {
    return particle_box<2>(10) + section("Bodies", text);
  };
  check_message(bodies(block("one", "3, 3") + block("two", "4, 4")),
                {"'Bodies/two'", "on the body 'one'"});
  check_message(bodies(block("one", "3, 3") + block("two", "3.5, 3.5")), {"the body 'one'"});
  check_message(bodies(block("one", "0.5, 5")), {"reaches into a wall", "hold it there"});
  check_message(bodies(block("one", "-1, 5")), {"outside the domain"});
  check_message(
    bodies(block("one", "5, -20", section("Boundaries", section("all", "set Kind = clamp")))),
    {"outside the domain", "may reach into walls"});
  check_message(
    bodies(block("one", "5, 5", section("Boundaries", section("all", "set Where = x - 9")))),
    {"'Where'", "holds no particle"});
  check_message(
    bodies(block("one", "5, 5", section("Boundaries", section("all", "set Sides = rim")))),
    {"'Sides'", "'rim'", "left"});
  check_message(
    bodies(block("one",
                 "5, 5",
                 section("Boundaries", section("all", "set Kind = pressure\n set Pressure = 1")))),
    {"'Kind'", "clamp"});
  check_message(bodies(block("one", "5, 5", "set Initial velocity = log(-x); 0")),
                {"'Initial velocity'", "not a number"});
}


TEST_CASE("particles: wrong obstacles and effects are refused")
{
  const auto obstacle = [](const std::string &keys) {
    return particle_box<2>(10) + fluid_section + section("Obstacles", section("pillar", keys));
  };
  check_message(obstacle("set Centre = 5, 5\n set Size = 0.001, 4"), {"thinner than a spacing"});
  check_message(obstacle("set Shape = ball\n set Displacement = log(-1-t); 0"),
                {"'Displacement'", "not a number at the start"});
  check_message(particle_box<2>(10) + fluid_section +
                  section("Obstacles",
                          section("one", "set Displacement = t; 0") +
                            section("other", "set Displacement = 0; t")),
                {"'Obstacles/other'", "another one that moves"});
  check_message(obstacle("set Surface = there_is_no_such_file.stl"),
                {"'Surface'", "cannot be read"});
  check_message(particle_box<2>(10) + fluid_section +
                  section("Effects", section("sleep", "set Speed = 1\n set Time = 1")),
                {"'Effects/sleep'", "'gravity', 'viscosity', 'wall friction'"});
  check_message(particle_box<2>(10) + fluid_section +
                  section("Effects", section("vorticity confinement", "set Strength = 1")),
                {"'Effects/vorticity confinement'", "particles smooth nothing"});
}
