// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .02;


  /// A plane box of 20 by 20 spacings, periodic along x.
  ParticleScene<2>
  box()
  {
    ParticleScene<2> scene(l0);
    scene.setup.lower       = {{0, -4 * l0}};
    scene.setup.upper       = {{20 * l0, 20 * l0}};
    scene.setup.periodic[0] = true;
    return scene;
  }


  bool
  are_inside(const ParticleScene<2> &scene, const ParticleState<2> &state)
  {
    return std::all_of(state.positions.begin(), state.positions.end(), [&](const auto &x) {
      return x[0] >= scene.setup.lower[0] && x[0] <= scene.setup.upper[0];
    });
  }
} // namespace


TEST_CASE("A body goes around a periodic domain again and again", "[particles]")
{
  auto scene            = box();
  scene.setup.has_fluid = false;
  BodySetup soft;
  soft.youngs_modulus = 1e5;
  scene.add_body(soft);
  scene.for_each_point({{2, 6}}, {{8, 12}}, [&](const auto &x) {
    scene.add(x, Kind::solid, 1, Point<2>{{2, 0}});
  });
  const auto   engine = scene.engine();
  const double before = engine->balance().kinetic_solid;
  for (int frame = 0; frame < 15; ++frame) // four periods
    engine->advance(.05);
  ParticleState<2> state;
  engine->fetch(state);
  CHECK(are_inside(scene, state));
  CHECK(engine->balance().kinetic_solid == Approx(before).epsilon(1e-9));
  CHECK(engine->balance().elastic < 1e-9 * before);
}


TEST_CASE("A body that has gone around a periodic domain is resumed as it is", "[particles]")
{
  // In explicit steps, and in implicit ones, which begin with rigid motions about the body's
  // centre.
  const int  most  = GENERATE(0, 1);
  const auto v     = 2.;
  auto       scene = box();

  scene.setup.has_fluid                   = false;
  scene.setup.numerics.most_elastic_steps = most;
  BodySetup soft;
  soft.youngs_modulus = 1e5;
  scene.add_body(soft);
  scene.for_each_point({{2, 6}}, {{8, 12}}, [&](const auto &x) {
    // It turns and deforms, too.
    scene.add(x, Kind::solid, 1, Point<2>{{v + 5 * (x[1] - 9 * l0), -3 * (x[0] - 5 * l0)}});
  });
  const auto engine = scene.engine();
  double     time   = 0;
  const auto frame  = [&](Engine<2> &of) { of.advance(.005); };
  for (; time < .3495; time += .005) // until it lies across the side, for the second time
    frame(*engine);
  CHECK(engine->balance().body_centres[0][0] == Approx(5 * l0 + v * time).epsilon(1e-9));
  engine->fetch(scene.state);
  const auto resumed = scene.engine();
  CHECK(resumed->balance().body_centres[0][0] == engine->balance().body_centres[0][0]);
  for (int k = 0; k < 4; ++k)
    {
      frame(*engine);
      frame(*resumed);
    }
  ParticleState<2> expected, found;
  engine->fetch(expected);
  resumed->fetch(found);
  REQUIRE(found.positions.size() == expected.positions.size());
  double difference = 0;
  for (std::size_t i = 0; i < found.positions.size(); ++i)
    difference =
      std::max(difference, std::sqrt(norm_square(found.positions[i] - expected.positions[i])));
  CAPTURE(difference / l0);
  CHECK(difference == 0);
}


TEST_CASE("Fluid runs down along a periodic floor", "[particles]")
{
  auto scene          = box();
  scene.setup.gravity = {{1, -9.81}};
  scene.setup.depth   = 8 * l0;
  scene.for_each_point(
    {{0, 0}}, {{20, 8}}, [&](const auto &x) { scene.add(x, Kind::fluid, 0, Point<2>::zero()); });
  scene.for_each_point({{0, -3}}, {{20, 0}}, [&](const auto &x) {
    scene.add(x, x[1] > -l0 ? Kind::wall : Kind::dummy, 0, Point<2>::zero());
  });
  const auto engine = scene.engine();
  for (int frame = 0; frame < 25; ++frame) // through the domain's length once and a bit
    engine->advance(.04);
  ParticleState<2> state;
  engine->fetch(state);
  CHECK(are_inside(scene, state));
  const double speed = mean(state.tags.size(), [&](const std::size_t i) {
    return state.tags[i].kind() == Kind::fluid ? state.velocities[i][0] : NAN;
  });
  CHECK(speed == Approx(1.).epsilon(.02));
}
