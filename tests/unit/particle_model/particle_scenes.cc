// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

using namespace undine_tests;
using particles::Kind;

namespace
{
  const std::string water = section("Fluid", "set Density = 1000");

  std::size_t
  power(const std::size_t base, const int exponent)
  {
    std::size_t result = 1;
    for (int k = 0; k < exponent; ++k)
      result *= base;
    return result;
  }


  /// A body of water's density with these keys.
  std::string
  body(const std::string &name, const std::string &keys)
  {
    return section("Bodies",
                   section(name,
                           "set Density = 1000\n set Young's modulus = 1e5\n "
                           "set Poisson's ratio = 0.3\n" +
                             keys));
  }


  template <int dim>
  double
  least_distance(const particles::ParticleState<dim> &state)
  {
    double least = 1e100;
    for (std::size_t i = 0; i < state.positions.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        least = std::min(least, norm_square(state.positions[i] - state.positions[j]));
    return std::sqrt(least);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "particles: a full box is a lattice with three layers of walls", "", ((int dim), dim), 2, 3)
{
  const auto  model = read_particles<dim>(particle_box<dim>(4) + water);
  const auto &state = model.initial_state();
  CHECK(count(model, Kind::fluid) == power(4, dim));
  CHECK(count(model, Kind::wall) == power(6, dim) - power(4, dim));
  CHECK(count(model, Kind::dummy) == power(10, dim) - power(6, dim));
  CHECK(least_distance(state) == Approx(1).epsilon(1e-12));
  CHECK(model.setup().is_full);
  std::set<int> identities(state.identities.begin(), state.identities.end());
  CHECK(identities.size() == state.positions.size());
  CHECK(*identities.rbegin() + 1 == int(state.positions.size()));
  for (std::size_t k = 0; k < state.positions.size(); ++k)
    for (int axis = 0; axis < dim; ++axis)
      {
        CHECK(state.positions[k][axis] - std::floor(state.positions[k][axis]) == Approx(0.5));
        CHECK(state.positions[k][axis] > model.setup().lower[axis]);
        CHECK(state.positions[k][axis] < model.setup().upper[axis]);
      }
}


TEST_CASE("particles: open and periodic sides have no walls")
{
  const auto model = read_particles<2>(
    particle_box<2>(10, "set Open sides = top\n set Periodic sides = left, right") + water);
  CHECK(count(model, Kind::fluid) == 100);
  CHECK(count(model, Kind::wall) == 10);
  CHECK(count(model, Kind::dummy) == 20);
  const auto &setup = model.setup();
  CHECK(setup.periodic[0]);
  CHECK_FALSE(setup.periodic[1]);
  CHECK(setup.lower[0] == 0);
  CHECK(setup.upper[0] == 10);
  CHECK(setup.upper[1] > 19);
}


TEST_CASE("particles: region, initial velocity, gravity, viscosity and depth")
{
  const auto model = read_particles<2>(
    particle_box<2>(10) +
    section("Fluid", "set Density = 500\n set Region = 4 - y\n set Initial velocity = y; 2") +
    section("Effects",
            section("gravity", "set Acceleration = 0, -9.81") +
              section("viscosity", "set Dynamic viscosity = 2")));
  CHECK(count(model, Kind::fluid) == 40);
  CHECK(model.setup().gravity[1] == -9.81);
  CHECK(model.setup().fluid_viscosity == Approx(2. / 500));
  CHECK(model.setup().depth == Approx(4));
  const auto &state = model.initial_state();
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    if (state.tags[k].kind() == Kind::fluid)
      {
        CHECK(state.velocities[k][0] == Approx(state.positions[k][1]));
        CHECK(state.velocities[k][1] == 2);
      }
}


TEST_CASE("particles: fluid fills shapes")
{
  const auto model = read_particles<2>(
    particle_box<2>(10) +
    section("Fluid",
            "set Density = 1000\n set Region = 5 - x\n" +
              section("Shapes",
                      section("low", "set Lower corner = 0, 0\n set Upper corner = 10, 2") +
                        section("high", "set Lower corner = 4, 6\n set Upper corner = 10, 7"))));
  CHECK(count(model, Kind::fluid) == 11);
}


TEMPLATE_TEST_CASE_SIG(
  "particles: a box of whole spacings is filled wherever it is", "", ((int dim), dim), 2, 3)
{
  const std::string shifted = dim == 2 ? "4.3, 5.2" : "4.3, 5.2, 4.9";
  const std::string size    = dim == 2 ? "3, 2" : "3, 2, 4";
  const auto        model =
    read_particles<dim>(particle_box<dim>(10) + water +
                        body("block",
                             "set Centre = " + shifted + "\n set Size = " + size +
                               "\n set Initial velocity = " + (dim == 2 ? "x; 0" : "x; 0; 0") +
                               "\n" + section("Boundaries", section("left", "set Sides = left"))));
  const auto  &setup = model.setup();
  const auto  &state = model.initial_state();
  const size_t n     = dim == 2 ? 6 : 24;
  REQUIRE(setup.reference.size() == n);
  CHECK(count(model, Kind::solid) == n);
  CHECK(model.notes().empty());
  for (std::size_t k = 0; k < n; ++k)
    {
      CHECK(state.identities[k] == int(k));
      CHECK(state.tags[k].material() == 1);
      CHECK(setup.clamped[k] ==
            (setup.reference[k][0] < 4.3 - 0.9 ? particles::all_directions<dim> : 0));
      CHECK(state.velocities[k][0] == Approx(setup.clamped[k] ? 0. : setup.reference[k][0]));
    }
  for (std::size_t k = n; k < state.positions.size(); ++k)
    if (state.tags[k].kind() == Kind::fluid)
      for (std::size_t j = 0; j < n; ++j)
        CHECK(norm_square(state.positions[k] - state.positions[j]) >= 0.9 * 0.9);
}


TEMPLATE_TEST_CASE_SIG("particles: a ball has its volume", "", ((int dim), dim), 2, 3)
{
  const auto model = read_particles<dim>(
    particle_box<dim>(20) + body("ball",
                                 dim == 2 ? "set Shape = ball\n set Centre = 10, 10\n "
                                            "set Radius = 8"
                                          : "set Shape = ball\n set Centre = 10, 10, 10\n "
                                            "set Radius = 8"));
  const double volume = dim == 2 ? M_PI * 64 : 4. / 3 * M_PI * 512;
  CHECK(model.setup().reference.size() == Approx(volume).epsilon(0.04));
}


TEST_CASE("particles: what is clamped in a wall takes the place of the wall's particles")
{
  const auto with = read_particles<2>(
    particle_box<2>(10) + body("plate",
                               "set Lower corner = 4, -3\n set Upper corner = 6, 5\n" +
                                 section("Boundaries", section("root", "set Where = -y"))));
  const auto without = read_particles<2>(particle_box<2>(10) + water);
  CHECK(count(with, Kind::solid) == 16);
  CHECK(count(without, Kind::wall) - count(with, Kind::wall) == 2);
  CHECK(count(without, Kind::dummy) - count(with, Kind::dummy) == 4);
  const auto &setup = with.setup();
  for (std::size_t k = 0; k < setup.reference.size(); ++k)
    CHECK(setup.clamped[k] == (setup.reference[k][1] < 0 ? particles::all_directions<2> : 0));
  CHECK(least_distance(with.initial_state()) == Approx(1));
}


TEST_CASE("particles: two bodies have materials of their own")
{
  const std::string material =
    "set Density = 700\n set Young's modulus = 2e5\n set Poisson's ratio = 0.4\n";
  const auto model =
    read_particles<2>(particle_box<2>(10) +
                      section("Bodies",
                              section("one", material + "set Centre = 2, 2\n set Size = 2, 2") +
                                section("two", material + "set Centre = 7, 2\n set Size = 2, 4")));
  CHECK(model.body_names() == std::vector<std::string>{"one", "two"});
  REQUIRE(model.setup().bodies.size() == 2);
  CHECK(model.setup().bodies[1].density == 700);
  CHECK(model.setup().bodies[1].youngs_modulus == 2e5);
  CHECK(model.setup().body_of == std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1});
  CHECK(model.initial_state().tags[4].material() == 2);
}


TEST_CASE(
  "particles: what is full goes on behind openings, what has a surface is open to air there")
{
  const auto read = [](const std::string &keys) {
    return read_particles<2>(particle_box<2>(8) + section("Fluid", "set Density = 1000\n" + keys));
  };
  const auto boundaries = [](const std::string &keys) {
    return section("Boundaries", section("side", "set Sides = right\n" + keys));
  };
  const auto count_layers = [](const ParticleModel<2> &model) {
    const auto &tags = model.initial_state().tags;
    return std::count_if(tags.begin(), tags.end(), [](const particles::Tag tag) {
      return tag.material() == particles::opening_material;
    });
  };
  const auto full = read(boundaries("set Kind = pressure\n set Pressure = 5"));
  CHECK(count_layers(full) == 3 * 8);
  REQUIRE(full.setup().open_sides.size() == 1);
  CHECK(full.setup().open_sides[0].is_opening);
  CHECK(full.setup().open_sides[0].pressure == 5);
  CHECK(full.setup().open_sides[0].plane == 8);
  CHECK(!full.setup().open_sides[0].enters_from_rest);
  CHECK(full.setup().numerics.faces_tolerance == 1e-3);
  CHECK(read(boundaries("set Kind = outflow")).setup().open_sides[0].enters_from_rest);

  const auto with_surface =
    read("set Region = 7 - y\n" + boundaries("set Kind = pressure\n set Pressure = 0"));
  CHECK(!with_surface.setup().is_full);
  CHECK(count_layers(with_surface) == 0);
  CHECK(with_surface.domain().sides[1] == ParticleSide::open);

  CHECK_THROWS_WITH(
    read("set Region = 7 - y\n" + boundaries("set Kind = pressure\n set Pressure = 3")),
    Catch::Contains("'Pressure': is not zero") && Catch::Contains("beyond the air's"));
  CHECK_THROWS_WITH(
    read(
      section("Boundaries",
              section("low", "set Sides = right\n set Kind = outflow\n set Region = 3 - y") +
                section("high", "set Sides = right\n set Kind = pressure\n set Region = y - 5"))),
    Catch::Contains("differs from that of another opening"));
  CHECK_THROWS_WITH(read(boundaries("set Kind = outflow\n set Pressure = 3")),
                    Catch::Contains("'Pressure': is not used"));
}


TEST_CASE("particles: a domain is full if no cube in it is free and nothing can leave it")
{
  const auto is_full = [](const std::string &domain, const std::string &rest) {
    return read_particles<2>(particle_box<2>(8, domain) + rest).setup().is_full;
  };
  const auto fluid = [](const std::string &keys) {
    return section("Fluid", "set Density = 1000\n" + keys);
  };
  const std::string ball = "set Shape = ball\n set Centre = 4.2, 4\n set Radius = 2";
  const std::string lid =
    section("Obstacles",
            section("lid", "set Shape = box\n set Lower corner = 0, 3\n set Upper corner = 8, 5"));
  CHECK(is_full("", water));
  CHECK(is_full("set Periodic sides = left, right, bottom, top", water));
  CHECK(is_full("", water + body("one", ball)));
  CHECK(is_full("", fluid("set Region = 3 - y") + lid));
  CHECK(!is_full("", fluid("set Region = 7 - y")));
  CHECK(!is_full("set Open sides = top", water));
  const auto opening = [](const std::string &keys) {
    return section("Boundaries", section("drain", "set Sides = left\n" + keys));
  };
  CHECK(is_full("", fluid(opening("set Kind = outflow"))));
  CHECK(!is_full("", fluid("set Region = 7 - y\n" + opening("set Kind = outflow"))));
  // With fluid above the lid that has a surface, and with none that has.
  CHECK_THROWS_WITH(is_full("", fluid("set Region = 7 - y") + lid), Catch::Contains("close"));
  CHECK_THROWS_WITH(is_full("", water + lid), Catch::Contains("close"));
  CHECK_THROWS_WITH(
    read_particles<2>(
      section("Particles", "set Spacing = 1\n" + section("Pressure", "set Pair force = minimum")) +
      section("Domain", "set Lower corner = 0, 0\n set Upper corner = 8, 8") + water),
    Catch::Contains("balanced"));
}


TEMPLATE_TEST_CASE_SIG("particles: a void region is as far empty as bodies and walls close it",
                       "",
                       ((int dim), dim),
                       2,
                       3)
{
  const auto room = [](const double lower, const double upper) {
    std::string text = fmt::format("set Lower corner = {}, 4", lower);
    std::string end  = fmt::format("set Upper corner = {}, 6", upper);
    if (dim == 3)
      {
        text += ", 0";
        end += ", 10";
      }
    return body("plate",
                text + "\n" + end + "\n" +
                  section("Boundaries", section("ends", "set Sides = left, right")));
  };
  const auto with_void = [&](const std::string &plate, const std::string &seed) {
    return read_particles<dim>(
      particle_box<dim>(10) + plate +
      section(
        "Fluid",
        "set Density = 1000\n" +
          section("Void regions", section("air", "set Seed = " + seed + (dim == 3 ? ", 5" : "")))));
  };
  const std::size_t layer = power(10, dim - 1);
  for (const std::string seed : {"5, 1.5", "0.6, 0.6"})
    {
      const auto model = with_void(room(0, 10), seed);
      CHECK(count(model, Kind::fluid) == 4 * layer);
      CHECK(!model.setup().is_full);
      for (std::size_t k = 0; k < model.initial_state().tags.size(); ++k)
        if (model.initial_state().tags[k].kind() == Kind::fluid)
          CHECK(model.initial_state().positions[k][1] > 6);
    }
  CHECK(count(with_void(room(0, 10), "5, 9"), Kind::fluid) == 4 * layer);
  // Where the plate does not reach the wall, nothing is left for the fluid.
  CHECK_THROWS_WITH(with_void(room(0, 8), "5, 1.5"), Catch::Matchers::Contains("no fluid left"));
}


TEST_CASE("particles: what is clamped deeper in walls than they are thick is left out")
{
  const auto beam = [](const std::string &end) {
    return read_particles<2>(particle_box<2>(10) +
                             body("beam",
                                  "set Lower corner = 4, " + end + "\n set Upper corner = 6, 5\n" +
                                    section("Boundaries", section("foot", "set Where = -y"))));
  };
  const auto short_one = beam("-3"), long_one = beam("-6");
  CHECK(count(short_one, Kind::solid) == 16);
  CHECK(count(long_one, Kind::solid) == 16);
  CHECK(short_one.setup().clamped == long_one.setup().clamped);
}
