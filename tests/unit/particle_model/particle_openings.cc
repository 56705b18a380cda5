// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <message_of.h>

#include <undine/particles/engine/engine.h>

#include "particle_scene.h"

using namespace undine_tests;
using particles::inflow_material;
using particles::Kind;

namespace
{
  std::string
  opening(const std::string &name, const std::string &keys)
  {
    return section(name, keys);
  }


  /// A box of 10 cubes along each axis, with fluid and these boundaries.
  template <int dim>
  std::string
  opened(const std::string &boundaries,
         const std::string &domain = "",
         const std::string &region = "1")
  {
    return particle_box<dim>(10, domain) + section("Fluid",
                                                   "set Density = 1000\n set Region = " + region +
                                                     "\n" + section("Boundaries", boundaries));
  }


  template <int dim>
  std::string
  inflow(const std::string &more = "")
  {
    return section("in",
                   std::string("set Sides = left\n set Kind = inflow\n set Velocity = ") +
                     (dim == 2 ? "2; 0\n" : "2; 0; 0\n") + more);
  }

  const std::string outflow = section("out", "set Sides = right\n set Kind = outflow\n");
} // namespace


TEMPLATE_TEST_CASE_SIG("particles: three layers stand behind an inflow, nothing behind an outflow",
                       "",
                       ((int dim), dim),
                       2,
                       3)
{
  const auto   model  = read_particles<dim>(opened<dim>(inflow<dim>() + outflow, "", "9 - x"));
  const auto   closed = read_particles<dim>(opened<dim>(""));
  const size_t side   = dim == 2 ? 10 : 100; // particles of a layer
  CHECK(count(closed, Kind::wall) - count(model, Kind::wall) == side);
  CHECK(count(closed, Kind::dummy) - count(model, Kind::dummy) == 2 * side);
  const auto &state    = model.initial_state();
  size_t      n_behind = 0;
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    if (state.tags[k].material() == inflow_material)
      {
        ++n_behind;
        CHECK(state.positions[k][0] < 0);
        CHECK(state.positions[k][1] > 0);
        CHECK(state.tags[k].kind() == (state.positions[k][0] > -1 ? Kind::wall : Kind::dummy));
        CHECK(state.velocities[k][0] == 2);
      }
  CHECK(n_behind == 3 * side);
  const auto &sides = model.setup().open_sides;
  REQUIRE(sides.size() == 2);
  CHECK(sides[0].is_inflow);
  CHECK(sides[0].axis == 0);
  CHECK(sides[0].plane == 0);
  CHECK(sides[0].inward == 1);
  CHECK(sides[0].depth == 3);
  CHECK_FALSE(sides[1].is_inflow);
  CHECK(sides[1].plane == 10);
  CHECK(sides[1].inward == -1);
  CHECK(model.setup().upper[0] > 10);
  // What flows in crosses at most this share of a spacing in the first sub-step, too.
  CHECK(model.setup().numerics.largest_sub_step == Approx(model.setup().numerics.speed_share / 2));
}


TEST_CASE("particles: the rest of a side beside an inflow is a wall, and later boundaries count")
{
  const auto model = read_particles<2>(
    opened<2>(inflow<2>("set Region = y - 4") +
                opening("hole", "set Sides = left, top\n set Kind = outflow\n set Region = y - 8"),
              "",
              "9 - y"));
  size_t n_behind = 0, n_wall = 0;
  for (std::size_t k = 0; k < model.initial_state().tags.size(); ++k)
    {
      const auto &x        = model.initial_state().positions[k];
      const auto  material = model.initial_state().tags[k].material();
      n_behind += material == inflow_material ? 1 : 0;
      n_wall += material == 0 && x[0] < 0 && x[1] > 0 && x[1] < 10 ? 1 : 0;
      CHECK_FALSE((x[1] > 10 && x[0] > 0 && x[0] < 10)); // all of the top is open
    }
  CHECK(n_behind == 3 * 4);
  CHECK(n_wall == 3 * 4);
}


TEST_CASE("particles: what leaves the room beyond an open side is taken out")
{
  const auto model = read_particles<2>(
    opened<2>("", "set Open sides = top, right\n set Room beyond open sides = 5"));
  const auto &setup = model.setup();
  REQUIRE(setup.open_sides.size() == 4);
  for (const auto &side : setup.open_sides)
    {
      CHECK_FALSE(side.is_inflow);
      CHECK(side.plane == (side.inward < 0 ? 15 : -3)); // over the walls, too
      CHECK(setup.lower[side.axis] < -3);
      CHECK(setup.upper[side.axis] > 15);
    }
}


TEST_CASE("particles: an empty box may fill, and the flow into it is as given")
{
  const auto model = read_particles<2>(
    opened<2>(inflow<2>("set Region = (y - 3) * (7 - y)"), "set Open sides = top", "-1"));
  CHECK(count(model, Kind::fluid) == 0);
  CHECK(model.has_fluid());
  const auto engine = Registry<particles::EngineFactory<2>>::instance().make("host")->make(
    model.numerics().precision, 0);
  engine->load(model.setup(), model.initial_state());
  for (int frame = 0; frame < 6; ++frame)
    engine->advance(0.5);
  auto state = model.initial_state();
  engine->fetch(state);
  const auto n_fluid = std::count_if(
    state.tags.begin(), state.tags.end(), [](const auto tag) { return tag.kind() == Kind::fluid; });
  CHECK(n_fluid == Approx(2 * 3. * 4).margin(4)); // speed, time, width; a particle of each row
}


TEST_CASE("particles: wrong inflows and outflows are refused")
{
  const auto check = [](const std::string &text, const std::vector<std::string> &expected) {
    const auto message = message_of([&] { read_particles<2>(text); });
    for (const auto &words : expected)
      CHECK_THAT(message, Catch::Matchers::Contains(words));
  };
  const auto left = [](const std::string &keys) {
    return opened<2>(section("in", "set Sides = left\n set Kind = inflow\n" + keys));
  };
  check(left(""), {"'Velocity'", "must be given"});
  check(left("set Velocity = -1; 0"), {"'Velocity'", "points out of the domain at (0, "});
  check(left("set Velocity = 1; 0.1"), {"'Velocity'", "not normal to the side 'left'"});
  check(left("set Velocity = 1/(y - 0.5); 0"), {"'Velocity'", "not a number at (0, 0.5)"});
  check(left("set Velocity = 1; 0"), {"full and closed"});
  check(left("set Velocity = 0; 0"), {"'Velocity'", "nothing flows in"});
  check(left("set Velocity = 1 + sin(t); 0"), {"'Velocity'", "names the time"});
  check(left("set Velocity = 1; 0\n set Region = y - 20"), {"'Region'", "leaves nothing"});
  check(left("set Velocity = 1; 0\n set Region = log(-y)"), {"'Region'", "not a number"});
  check(opened<2>(section("out", "set Sides = left\n set Kind = outflow\n set Velocity = 1; 0")),
        {"'Velocity'", "not used by an opening of this kind"});
  check(opened<2>(section("out", "set Sides = left\n set Kind = no-slip wall")),
        {"'Kind'", "inflow | outflow | pressure"});
  check(opened<2>(inflow<2>(), "set Periodic sides = left, right"),
        {"'Sides'", "'left', which is periodic"});
  check(opened<2>(inflow<2>(), "set Open sides = left"), {"'Sides'", "'left', which is open"});
  check(opened<2>(inflow<2>() + section("rain",
                                        "set Sides = top\n set Kind = inflow\n set Velocity = 0; "
                                        "-1")),
        {"'Region'", "reaches to the edge", "leave 1.5 m"});
  check(opened<2>(inflow<2>()) +
          section("Bodies",
                  section("beam",
                          "set Lower corner = -3, 4\n set Upper corner = 5, 6\n set Density = 1\n "
                          "set Young's modulus = 1e5\n set Poisson's ratio = 0.3\n" +
                            section("Boundaries", section("all", "set Where = 1 - x")))),
        {"'beam' stands in an inflow"});
  check(
    opened<2>(inflow<2>()) +
      section("Obstacles", section("plug", "set Lower corner = -1, 4\n set Upper corner = 2, 6")),
    {"an obstacle closes an inflow"});
}
