// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;

  /// A scene with one wall that moves along x; its particles come before all others.
  template <int dim>
  struct SceneWithPiston : ParticleScene<dim>
  {
    std::vector<Point<dim>>       rest;
    std::vector<Kind>             kinds;
    std::function<double(double)> place; ///< x(t) - x(0) [m]
    double                        time = 0;

    SceneWithPiston()
      : ParticleScene<dim>(l0)
    {
    }

    void
    add_moving(const Point<dim> &x, const Kind kind)
    {
      rest.push_back(x);
      kinds.push_back(kind);
      this->add(x, kind, moving_material, Point<dim>::zero());
      ++this->setup.n_moving;
    }

    StepControl
    advance(Engine<dim> &engine, const double dt)
    {
      const double   e = 1e-6;
      WallPaths<dim> paths;
      const auto     speed = [&](const double t) {
        return along<dim>(0, (place(t + e) - place(t - e)) / (2 * e));
      };
      for (std::size_t k = 0; k < rest.size(); ++k)
        paths.push_back({rest[k] + along<dim>(0, place(time)),
                         along<dim>(0, place(time + dt) - place(time)),
                         speed(time),
                         speed(time + dt),
                         kinds[k]});
      engine.move_walls(paths);
      time += dt;
      return engine.advance(dt);
    }
  };


  /// Mean over the fluid of f(i).
  template <int dim, class Function>
  double
  fluid_mean(const ParticleState<dim> &state, const Function &f)
  {
    return mean(state.tags.size(), [&](const std::size_t i) {
      return state.tags[i].kind() == Kind::fluid ? f(i) : NAN;
    });
  }


  /// A block of fluid in a channel without weight, periodic across in space, and a piston that
  /// fills the channel behind it.
  template <int dim>
  SceneWithPiston<dim>
  channel_with_piston(const int length, const int height)
  {
    SceneWithPiston<dim> scene;
    auto                 lower = cube<dim>(0), upper = cube<dim>(8);
    lower[0] = lower[dim - 1] = -3;
    upper[0]                  = 3 * length;
    upper[dim - 1]            = height + 3;
    for (int axis = 0; axis < dim; ++axis)
      {
        const bool is_across       = axis != 0 && axis != dim - 1;
        scene.setup.periodic[axis] = is_across;
        scene.setup.lower[axis]    = (lower[axis] - (is_across ? 0 : 2)) * l0;
        scene.setup.upper[axis]    = (upper[axis] + (is_across ? 0 : 2)) * l0;
      }
    const auto is_inside = [&](const Point<dim> &x) {
      return x[dim - 1] > 0 && x[dim - 1] < height * l0;
    };
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      if (is_inside(x) && x[0] < 0)
        scene.add_moving(x, x[0] > -l0 ? Kind::wall : Kind::dummy);
    });
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      const double outside = std::max(-x[dim - 1], x[dim - 1] - height * l0);
      if (outside > 0)
        scene.add(x, outside < l0 ? Kind::wall : Kind::dummy, 0, Point<dim>::zero());
      else if (x[0] > 0 && x[0] < length * l0)
        scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    });
    return scene;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "A piston pushes a block of water as a rigid one", "[particles]", ((int dim), dim), 2, 3)
{
  const int    length = 20, height = dim == 2 ? 10 : 8;
  const double a            = 2; // [m/s^2]
  auto         scene        = channel_with_piston<dim>(length, height);
  scene.place               = [=](const double t) { return t < 0 ? 0 : a * t * t / 2; };
  const auto         engine = scene.engine();
  ParticleState<dim> state;
  double             impulse = 0; // of the pressure on the piston [Pa s]
  for (int frame = 1; frame <= 200; ++frame)
    {
      scene.advance(*engine, .001);
      engine->fetch(state);
      const auto piston = Tag::of(Kind::wall, moving_material).code;
      impulse += .001 * mean(state.tags.size(), [&](const std::size_t i) {
                   return state.tags[i].code == piston ? state.pressures[i] : NAN;
                 });
    }
  const double t = scene.time;
  CHECK(fluid_mean(state, [&](const std::size_t i) { return state.velocities[i][0]; }) ==
        Approx(a * t).epsilon(.05));
  CHECK(fluid_mean(state, [&](const std::size_t i) { return state.positions[i][0]; }) ==
        Approx(length * l0 / 2 + a * t * t / 2).margin(.15 * l0));
  CHECK(impulse == Approx(1000 * length * l0 * a * t).epsilon(.06));
}


TEMPLATE_TEST_CASE_SIG(
  "Water rises by what a piston displaces", "[particles]", ((int dim), dim), 2, 3)
{
  const int            width = dim == 2 ? 40 : 16, depth = dim == 2 ? 20 : 10;
  const double         way = (dim == 2 ? 10 : 4) * l0, duration = 1;
  SceneWithPiston<dim> scene;
  auto                 size = cube<dim>(dim == 2 ? width : 8);
  size[0]                   = width;
  size[dim - 1]             = 2 * depth;
  scene.setup.gravity       = along<dim>(dim - 1, -9.81);
  scene.setup.depth         = 1.5 * depth * l0;
  auto lower = cube<dim>(0), upper = size;
  lower[0] = -3;
  upper[0] = 0;
  // The piston is the left wall, which does not move with it but stays behind.
  scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
    scene.add_moving(x, x[0] > -l0 ? Kind::wall : Kind::dummy);
  });
  auto tank = ParticleScene<dim>(l0);
  tank.add_tank(size, 10);
  scene.setup.lower = tank.setup.lower;
  scene.setup.upper = tank.setup.upper;
  for (std::size_t i = 0; i < tank.state.tags.size(); ++i)
    scene.add(tank.state.positions[i], tank.state.tags[i].kind(), 0, Point<dim>::zero());
  auto wet     = size;
  wet[dim - 1] = depth;
  scene.for_each_point(cube<dim>(0), wet, [&](const Point<dim> &x) {
    scene.add(x, Kind::fluid, 0, Point<dim>::zero());
  });
  scene.place = [=](const double t) {
    const double s = std::clamp(t / duration, 0., 1.);
    return way * s * s * (3 - 2 * s);
  };
  const auto engine = scene.engine();
  for (int frame = 0; frame < 150; ++frame)
    scene.advance(*engine, .01);
  ParticleState<dim> state;
  engine->fetch(state);
  const double level = depth * l0 * width * l0 / (width * l0 - way);
  CHECK(2 * fluid_mean(state, [&](const std::size_t i) { return state.positions[i][dim - 1]; }) ==
        Approx(level).epsilon(.02));
  CHECK(fluid_mean(
          state, [&](const std::size_t i) { return state.positions[i][0] > way ? 0. : 1.; }) == 0);
}


TEMPLATE_TEST_CASE_SIG("A cylinder or ball that is set in motion takes its added mass along",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  // Around it a drop of radius b: on its surface the potential is zero.
  const double         a = dim == 2 ? 10 * l0 : 6 * l0, b = 2 * a, speed = .1, duration = .05;
  SceneWithPiston<dim> scene;
  scene.set_free_space(4 * a);
  int        n_moved = 0, n_fluid = 0;
  const int  reach    = static_cast<int>(b / l0) + 1;
  const auto for_each = [&](const double from, const double to, const auto &f) {
    scene.for_each_point(cube<dim>(-reach), cube<dim>(reach), [&](const Point<dim> &x) {
      const double r = std::sqrt(norm_square(x));
      if (r >= from && r < to)
        f(x, r);
    });
  };
  for_each(0, a, [&](const Point<dim> &x, const double r) {
    scene.add_moving(x, r > a - 1.5 * l0 ? Kind::wall : Kind::dummy);
    ++n_moved;
  });
  for_each(a, b, [&](const Point<dim> &x, double) {
    scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    ++n_fluid;
  });
  scene.setup.attraction = 100; // so that no suction is needed
  scene.place            = [=](const double t) { return t < 0 ? 0 : speed / duration * t * t / 2; };
  const auto   engine    = scene.engine();
  const double mass = 1000 * std::pow(l0, dim), A = n_moved * mass, B = A + n_fluid * mass;
  const double added = A * (B - A) / (A + (dim - 1) * B);
  for (int frame = 0; frame < 50; ++frame)
    scene.advance(*engine, duration / 50);
  CHECK(engine->balance().momentum[0] == Approx(added * speed).epsilon(.1));
}


TEST_CASE("A paddle pushes an elastic block along", "[particles]")
{
  const double       speed = .5;
  SceneWithPiston<2> scene;
  scene.set_free_space(1);
  scene.setup.has_fluid = false;
  BodySetup body;
  body.youngs_modulus = 1e5;
  body.damping        = .5;
  const int number    = scene.add_body(body);
  scene.for_each_point({{4, 0}}, {{12, 8}}, [&](const Point<2> &x) {
    scene.add(x, Kind::solid, number + 1, Point<2>::zero());
  });
  scene.for_each_point({{-3, -1}}, {{0, 9}}, [&](const Point<2> &x) {
    scene.add_moving(x, x[0] > -l0 ? Kind::wall : Kind::dummy);
  });
  scene.place       = [=](const double t) { return speed * t; };
  const auto engine = scene.engine();
  for (int frame = 0; frame < 60; ++frame)
    scene.advance(*engine, .005);
  ParticleState<2> state;
  engine->fetch(state);
  double least = 1;
  for (std::size_t i = 0; i < state.tags.size(); ++i)
    if (state.tags[i].kind() == Kind::solid)
      least = std::min(least, state.positions[i][0]);
  CHECK(least > speed * scene.time); // in front of the paddle, whose face is there
  CHECK(engine->balance().body_velocities[0][0] >= .95 * speed);
}


namespace
{
  /// How a paddle that starts at once with `speed` [m/s] sets a block in motion that it touches.
  struct Push
  {
    double fastest = 0; ///< particle of the block, at the end of any frame [m/s]
    double leaves  = 0; ///< the block, as a whole [m/s]
  };

  template <int dim>
  Push
  pushed_block(const double speed, const double frame)
  {
    SceneWithPiston<dim> scene;
    scene.set_free_space(1);
    scene.setup.has_fluid = false;
    BodySetup body;
    body.youngs_modulus = 1e5; // waves of 12 m/s
    const int number    = scene.add_body(body);
    auto      lower = cube<dim>(0), upper = cube<dim>(6);
    upper[0] = 12;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      scene.add(x, Kind::solid, number + 1, Point<dim>::zero());
    });
    lower    = cube<dim>(-1);
    upper    = cube<dim>(7);
    lower[0] = -3;
    upper[0] = 0;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      scene.add_moving(x, x[0] > -l0 ? Kind::wall : Kind::dummy);
    });
    scene.place       = [=](const double t) { return speed * t; };
    const auto engine = scene.engine();
    Push       result;
    while (scene.time < .2)
      {
        scene.advance(*engine, frame);
        ParticleState<dim> state;
        engine->fetch(state);
        for (std::size_t i = 0; i < state.tags.size(); ++i)
          if (state.tags[i].kind() == Kind::solid)
            result.fastest = std::max(result.fastest, std::sqrt(norm_square(state.velocities[i])));
      }
    result.leaves = engine->balance().body_velocities[0][0];
    return result;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "A slow paddle does not kick a block that it touches", "[particles]", ((int dim), dim), 2, 3)
{
  // The block has the paddle's speed behind the first wave and twice that once the wave has come
  // back from its free end, less what is left in vibrations; rows that swing after the wave are
  // faster. While the paddle goes by a twentieth or a fifth of a spacing, which is a sub-step,
  // waves go by 12 or 46 spacings: how long sub-steps are makes no difference.
  const double speed = .05;
  const auto   push = pushed_block<dim>(speed, .01), longer = pushed_block<dim>(speed, .04);
  CHECK(push.fastest < 3 * speed);
  CHECK(push.leaves > 1.7 * speed);
  CHECK(push.leaves < 2 * speed);
  CHECK(longer.leaves == Approx(push.leaves).epsilon(.01));
}


TEST_CASE("Runs with moving walls resume with the same bits", "[particles]")
{
  auto scene        = channel_with_piston<2>(10, 8);
  scene.place       = [](const double t) { return .02 * std::sin(10 * t); };
  const auto engine = scene.engine();
  for (int frame = 0; frame < 5; ++frame)
    scene.advance(*engine, .01);
  engine->fetch(scene.state);
  const auto resumed = scene.engine();
  const auto before  = scene.time;
  scene.advance(*engine, .01);
  scene.time = before;
  scene.advance(*resumed, .01);
  ParticleState<2> expected, found;
  engine->fetch(expected);
  resumed->fetch(found);
  REQUIRE(found.positions.size() == expected.positions.size());
  for (std::size_t i = 0; i < found.positions.size(); ++i)
    REQUIRE(norm_square(found.positions[i] - expected.positions[i]) == 0);
}


TEST_CASE("Frames of moving walls need their paths", "[particles]")
{
  auto scene        = channel_with_piston<2>(10, 8);
  scene.place       = [](const double t) { return .1 * t; };
  const auto engine = scene.engine();
  scene.advance(*engine, .01);
  CHECK_THROWS_WITH(engine->advance(.01), Catch::Contains("how walls move"));
  CHECK_THROWS_WITH(engine->move_walls({}), Catch::Contains("another number"));
}
