// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "executors.h"

#include <undine/base/core/errors.h>
#include <undine/particles/engine/energy_bound.h>

using namespace particle_tests;

namespace
{
  template <int dim>
  double
  total(const Balance<dim> &balance)
  {
    return balance.kinetic_fluid + balance.kinetic_solid + balance.potential + balance.elastic;
  }


  /// A disc of radius 0.1 m falls at 2 m/s on water 0.4 m deep.
  ParticleScene<2>
  disc_above_water(const double density, const double youngs_modulus)
  {
    const double     l0    = .02;
    const int        width = 50;
    ParticleScene<2> scene(l0);
    scene.setup.gravity = along<2>(1, -9.81);
    scene.setup.depth   = .4;
    BodySetup body;
    body.density        = density;
    body.youngs_modulus = youngs_modulus;
    body.poissons_ratio = .45;
    scene.add_body(body);
    scene.for_each_point(cube<2>(0), cube<2>(width), [&](const Point<2> &x) {
      if (std::hypot(x[0] - .5, x[1] - .55) < .1)
        scene.add(x, Kind::solid, 1, along<2>(1, -2.));
    });
    scene.add_tank(cube<2>(width), 30);
    scene.for_each_point(cube<2>(0), {{width, 20}}, [&](const Point<2> &x) {
      scene.add(x, Kind::fluid, 0, Point<2>::zero());
    });
    return scene;
  }
} // namespace


TEST_CASE("A stiff body takes implicit steps without gaining energy", "[particles]")
{
  for (const auto &executor : executors<2>())
    {
      auto scene                              = disc_above_water(800, 1e9);
      scene.setup.numerics.most_elastic_steps = 20;
      const auto   engine                     = engine_on<2>(executor, scene);
      const double start                      = total(engine->balance());
      const double moved                      = engine->balance().kinetic_solid;
      for (int frame = 0; frame < 10; ++frame)
        {
          engine->advance(.01);
          CHECK(total(engine->balance()) < start + .005 * moved);
        }
      // As with 1e7 Pa, and 1e6 Pa by explicit steps: 1.31 and 1.30 m/s. Before rigid motions came
      // first the body had 1.43 m/s.
      CHECK(engine->balance().body_velocities[0][1] == Approx(-1.29).margin(.05));
    }
}


TEST_CASE("Implicit steps turn a body", "[particles]")
{
  for (const auto &executor : executors<2>())
    {
      const double     l0 = .01, rate = 20;
      ParticleScene<2> scene(l0);
      BodySetup        body;
      body.youngs_modulus = 1e9;
      scene.add_body(body);
      scene.for_each_point({{0, 0}}, {{12, 6}}, [&](const Point<2> &x) {
        scene.add(x, Kind::solid, 1, {{-rate * (x[1] - 3 * l0), rate * (x[0] - 6 * l0)}});
      });
      scene.set_free_space(.3);
      scene.setup.has_fluid                   = false;
      scene.setup.numerics.most_elastic_steps = 20;
      scene.setup.numerics.largest_sub_step   = 5e-4;
      const auto   engine                     = engine_on<2>(executor, scene);
      const double start                      = engine->balance().kinetic_solid;
      const auto   control                    = engine->advance(.1);
      CHECK(control.elastic_steps_total == control.sub_steps);
      // 0.81 after two radians in 200 steps; with rotations held it does not turn at all.
      const double left = engine->balance().kinetic_solid / start;
      CHECK(left > .75);
      CHECK(left < 1);
      CHECK(engine->balance().body_volumes[0] == Approx(1).margin(1e-3));
    }
}


TEST_CASE("Energy out of nothing is refused", "[particles]")
{
  const auto scene = disc_above_water(800, 1e3);
  Balance<2> before;
  before.kinetic_fluid = 72;
  auto after           = before;

  SECTION("without sources")
  {
    const EnergyBound<2> bound(scene.setup, scene.state);
    CHECK(bound.reason_of_excess(before, after, .01).empty());
    after.kinetic_solid = -.9 * before.kinetic_fluid;
    CHECK(bound.reason_of_excess(before, after, .01).empty());
    after.kinetic_solid = 2 * before.kinetic_fluid;
    CHECK_THAT(bound.reason_of_excess(before, after, .01), Catch::Contains("144 J"));
  }
  SECTION("nor little by little")
  {
    EnergyBound<2> bound(scene.setup, scene.state);
    bound.accept(before, before);
    after.kinetic_solid = 10;
    CHECK(bound.reason_of_excess(before, after, .01).empty());
    bound.accept(before, after);
    auto later = after;
    later.kinetic_solid += 10;
    CHECK_THAT(bound.reason_of_excess(after, later, .01),
               Catch::Contains("20 J since the start") && Catch::Contains("92 J in motion"));
    later.mass = -1; // something has left the domain, whatever potential energy it had
    CHECK(bound.reason_of_excess(after, later, .01).empty());
    bound.accept(after, later);
    later.kinetic_solid += 10;
    auto now = later;
    CHECK(bound.reason_of_excess(later, now, .01).empty());
  }
  SECTION("walls that move do work, but not without bounds")
  {
    EnergyBound<2> bound(scene.setup, scene.state);
    bound.wall_speed    = 1;
    after.kinetic_solid = 2 * before.kinetic_fluid;
    CHECK(bound.reason_of_excess(before, after, .01).empty());
    after.kinetic_solid = 2e20;
    CHECK(!bound.reason_of_excess(before, after, .01).empty());
  }
}


// Much softer than the water's impact and weight: it may give up, but not with an absurd result.
// The device, which sums in another order, was seen to gain 0.8 % on the way there, the host
// nothing.
TEST_CASE(
  "Whatever becomes of a body that is too soft, no frame has 2 % more energy than the start",
  "[particles]")
{
  for (const auto &executor : executors<2>())
    {
      const auto   scene  = disc_above_water(2000, 1e3);
      const auto   engine = engine_on<2>(executor, scene);
      const double most   = 1.02 * total(engine->balance());
      try
        {
          for (int frame = 0; frame < 60; ++frame)
            {
              engine->advance(.01);
              CHECK(total(engine->balance()) < most);
            }
        }
      catch (const SolveError &error)
        {
          INFO(error.what());
          CHECK(total(engine->balance()) < most); // that before the frame
        }
    }
}


// With pressures that were held for a sub-step while the body deformed, its vibrations had 0.9 J in
// the plane by then.
TEST_CASE("A soft ball that rests in water does not begin to shake", "[particles]")
{
  for (const auto &executor : executors<2>())
    {
      const double     l0    = .01;
      const int        width = 30, depth = 20;
      ParticleScene<2> scene(l0);
      scene.setup.gravity         = along<2>(1, -9.81);
      scene.setup.depth           = depth * l0;
      scene.setup.fluid_viscosity = 1e-6;
      BodySetup body;
      body.density        = 1000;
      body.youngs_modulus = 1e4;
      body.poissons_ratio = .3;
      scene.add_body(body);
      const auto inside = [&](const Point<2> &x) {
        return std::hypot(x[0] - .15, x[1] - .15) < .05;
      };
      for (const Kind kind : {Kind::solid, Kind::fluid})
        scene.for_each_point(cube<2>(0), {{width, depth}}, [&](const Point<2> &x) {
          if (inside(x) == (kind == Kind::solid))
            scene.add(x, kind, kind == Kind::solid ? 1 : 0, Point<2>::zero());
        });
      scene.add_tank({{width, depth + 6}}, 4);
      const auto   engine = engine_on<2>(executor, scene);
      const double start  = total(engine->balance());
      for (int frame = 0; frame < 125; ++frame)
        engine->advance(.02);
      const auto balance = engine->balance();
      CHECK(balance.kinetic_solid < .02);
      CHECK(total(balance) < start);
      CHECK(balance.body_volumes[0] == Approx(.953).margin(.01)); // 1 - rho g .05 m / (lambda + mu)
    }
}
