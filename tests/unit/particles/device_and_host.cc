// SPDX-License-Identifier: LGPL-2.1-or-later
// The device computes what the host computes. Where there is no device, comparisons with it are
// skipped and say so; what holds for each executor is tried for those that there are.
#include "executors.h"
#include "state_differences.h"

#include <catch2/catch.hpp>

using namespace particle_tests;

namespace
{
  /// A drop with a ball in it that crosses free space.
  template <int dim>
  ParticleScene<dim>
  drifting()
  {
    ParticleScene<dim> scene(0.02);
    BodySetup          ball;
    ball.youngs_modulus = 1e5;
    const int  body     = scene.add_body(ball);
    const auto velocity = along<dim>(0, 1);
    const auto within   = [&](const Point<dim> &x, const double radius) {
      return norm_square(x) < radius * radius * scene.setup.spacing * scene.setup.spacing;
    };
    scene.for_each_point(cube<dim>(-8), cube<dim>(8), [&](const Point<dim> &x) {
      if (within(x, 3))
        scene.add(x, Kind::solid, body + 1, velocity);
    });
    scene.for_each_point(cube<dim>(-8), cube<dim>(8), [&](const Point<dim> &x) {
      if (!within(x, 3) && within(x, 8))
        scene.add(x, Kind::fluid, 0, velocity);
    });
    scene.set_free_space(1);
    return scene;
  }

  enum class Ball
  {
    above,
    without
  };

  /// A tank with water that covers a part of its floor, `length` of 12 spacings, and a ball above.
  template <int dim>
  ParticleScene<dim>
  tank(const int length, const int depth, const Ball with = Ball::above)
  {
    ParticleScene<dim>   scene(0.02);
    std::array<int, dim> size = cube<dim>(12), end = cube<dim>(12), none = cube<dim>(0);
    end[0]       = length;
    end[dim - 1] = depth;
    BodySetup ball;
    ball.density        = 500;
    ball.youngs_modulus = 1e5;
    const int body      = with == Ball::above ? scene.add_body(ball) : -1;
    auto      centre    = along<dim>(dim - 1, (depth + 5.5) * scene.setup.spacing);
    for (int axis = 0; axis < dim - 1; ++axis)
      centre[axis] = 6 * scene.setup.spacing;
    std::array<int, dim> above = cube<dim>(12);
    above[dim - 1]             = depth + 12;
    scene.for_each_point(none, above, [&](const Point<dim> &x) {
      if (body >= 0 && norm_square(x - centre) < 9 * scene.setup.spacing * scene.setup.spacing)
        scene.add(x, Kind::solid, body + 1, Point<dim>::zero());
    });
    scene.add_tank(size, 30);
    scene.for_each_point(
      none, end, [&](const Point<dim> &x) { scene.add(x, Kind::fluid, 0, Point<dim>::zero()); });
    scene.setup.gravity = along<dim>(dim - 1, -9.81);
    scene.setup.depth   = depth * scene.setup.spacing;
    return scene;
  }

  template <int dim>
  double
  energy(const Balance<dim> &balance)
  {
    return balance.kinetic_fluid + balance.kinetic_solid + balance.potential + balance.elastic;
  }

  template <int dim>
  double
  mean_pressure(const ParticleState<dim> &state)
  {
    return mean(state.tags.size(), [&](const std::size_t i) {
      return state.tags[i].kind() == Kind::fluid ? state.pressures[i] : std::nan("");
    });
  }

  template <int dim>
  double
  mean_advance(const ParticleState<dim> &state)
  {
    return mean(state.tags.size(), [&](const std::size_t i) {
      return state.tags[i].kind() == Kind::fluid ? state.positions[i][0] : std::nan("");
    });
  }

  /// Executors precondition in different ways: what they find is the same only as far as they
  /// solve.
  template <int dim>
  void
  solve_tightly(ParticleScene<dim> &scene)
  {
    scene.setup.numerics.tolerance       = 1e-6;
    scene.setup.numerics.faces_tolerance = 1e-5;
  }

  /// After a second on the host: a cubic lattice of water is not stable, and its disorder would
  /// start from rounding.
  template <int dim>
  ParticleScene<dim>
  settled(ParticleScene<dim> scene)
  {
    const auto engine = scene.engine();
    for (int frame = 0; frame < 100; ++frame)
      engine->advance(0.01);
    engine->fetch(scene.state);
    return scene;
  }

  template <int dim>
  void
  check_hundred_steps(ParticleScene<dim> scene)
  {
    solve_tightly(scene);
    const auto   host = engine_on("host", scene), device = engine_on("device", scene);
    unsigned int steps = 0;
    while (steps < 100)
      {
        steps += host->advance(0.005).sub_steps;
        device->advance(0.005);
      }
    CHECK(largest_distance(state_of(*host), state_of(*device)) < 1e-2 * scene.setup.spacing);
  }
} // namespace


/// What the solvers find differs by more than what their equations do, which are stiff: it may be
/// as far from the solution in double precision as on the host, and no farther.
TEMPLATE_TEST_CASE_SIG("Each pass on the device computes what it does on the host",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  if (is_skipped<dim>())
    return;
  auto scene                           = tank<dim>(6, 10);
  scene.setup.numerics.tolerance       = 1e-7;
  scene.setup.numerics.faces_tolerance = 1e-7;
  const auto exact                     = scene.engine();
  exact->advance(0.03);
  exact->fetch(scene.state);
  scene.state.guesses.clear();
  const auto reference = scene.engine(Precision::double_precision);
  const auto host = engine_on("host", scene), device = engine_on("device", scene);
  for (const auto &engine : {reference.get(), host.get(), device.get()})
    CHECK(engine->advance(1e-4).sub_steps == 1);
  const auto expected = reference->pass_results(), on_host = host->pass_results(),
             on_device = device->pass_results();
  REQUIRE(on_device.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    {
      INFO(expected[k].name);
      const double of_host = relative_difference(on_host[k].values, expected[k].values);
      INFO("single precision on the host differs from double by " << of_host);
      CHECK(relative_difference(on_device[k].values, on_host[k].values) <
            std::max(1e-5, 2 * of_host));
      CHECK(of_host < 1e-3);
    }
}


TEMPLATE_TEST_CASE_SIG("After a hundred steps at rest particles are where they are on the host",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  if (!is_skipped<dim>())
    check_hundred_steps(settled(tank<dim>(12, 8, Ball::without)));
}


/// Whatever decides between the inside and the free surface must not let rounding decide.
TEMPLATE_TEST_CASE_SIG("After a hundred steps at rest particles are where they are in double",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const int depth : {8, 10})
    {
      auto scene = settled(tank<dim>(12, depth, Ball::without));
      solve_tightly(scene);
      const auto exact = scene.engine(Precision::double_precision);
      for (const auto &executor : executors<dim>())
        {
          INFO(executor << ", depth " << depth);
          const auto   engine = engine_on(executor, scene);
          unsigned int steps  = 0;
          while (steps < 100)
            {
              if (executor == executors<dim>().front())
                exact->advance(0.005);
              steps += engine->advance(0.005).sub_steps;
            }
          CHECK(largest_distance(state_of(*engine), state_of(*exact)) < 1e-2 * scene.setup.spacing);
        }
    }
}


TEMPLATE_TEST_CASE_SIG("After a hundred steps of a drift particles are where they are on the host",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  if (!is_skipped<dim>())
    check_hundred_steps(settled(drifting<dim>()));
}


TEMPLATE_TEST_CASE_SIG("One frame on the device is that on the host, particle by particle",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  if (is_skipped<dim>())
    return;
  auto scene = tank<dim>(12, 8);
  solve_tightly(scene);
  const auto host = engine_on("host", scene), device = engine_on("device", scene);
  host->advance(0.002);
  device->advance(0.002);
  CHECK(largest_distance(state_of(*host), state_of(*device)) < 1e-4 * scene.setup.spacing);
  CHECK(mean_pressure(state_of(*device)) == Approx(mean_pressure(state_of(*host))).epsilon(1e-4));
}


TEMPLATE_TEST_CASE_SIG("One frame in single precision is that in double, particle by particle",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  auto scene = tank<dim>(12, 8);
  solve_tightly(scene);
  const auto exact = scene.engine(Precision::double_precision);
  exact->advance(0.002);
  for (const auto &executor : executors<dim>())
    {
      const auto engine = engine_on(executor, scene);
      engine->advance(0.002);
      INFO(executor);
      CHECK(largest_distance(state_of(*exact), state_of(*engine)) < 1e-3 * scene.setup.spacing);
    }
}


TEMPLATE_TEST_CASE_SIG("A splash on the device is that on the host: energy, front, mean pressure",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  if (is_skipped<dim>())
    return;
  const auto   scene = tank<dim>(6, 10);
  const auto   host = engine_on("host", scene), device = engine_on("device", scene);
  const double before = energy(device->balance());
  for (int frame = 0; frame < 8; ++frame)
    {
      host->advance(0.01);
      device->advance(0.01);
    }
  const double lost = before - energy(host->balance());
  CHECK(before - energy(device->balance()) == Approx(lost).epsilon(0.05));
  CHECK(mean_advance(state_of(*device)) == Approx(mean_advance(state_of(*host))).epsilon(0.01));
  CHECK(mean_pressure(state_of(*device)) == Approx(mean_pressure(state_of(*host))).epsilon(0.1));
}


TEMPLATE_TEST_CASE_SIG("Two runs give the same bits", "[particles]", ((int dim), dim), 2, 3)
{
  auto       scene = tank<dim>(6, 10);
  const auto preconditioner =
    GENERATE(Numerics::Preconditioner::jacobi, Numerics::Preconditioner::multigrid);
  scene.setup.numerics.preconditioner = preconditioner;
  scene.setup.numerics.threads        = 0; // all of them
  for (const auto &executor : executors<dim>())
    {
      INFO(executor);
      const auto a = engine_on(executor, scene), b = engine_on(executor, scene);
      for (int frame = 0; frame < 3; ++frame)
        {
          a->advance(0.01);
          b->advance(0.01);
        }
      CHECK(largest_distance(state_of(*a), state_of(*b)) == 0);
      CHECK(state_of(*a).pressures == state_of(*b).pressures);
    }
}


/// Blocks of the device work on equally many rows each, and some of them together on an aggregate.
TEMPLATE_TEST_CASE_SIG(
  "Solvers of the device converge about as fast as those of the host, at any size",
  "[particles]",
  ((int dim), dim),
  2,
  3)
{
  if (is_skipped<dim>())
    return;
  const int          first = dim == 2 ? 80 : 12;
  const int          size  = first + (dim == 2 ? 2 : 1) * GENERATE(range(0, 10));
  ParticleScene<dim> scene(0.02);
  scene.add_tank(cube<dim>(size), 2);
  scene.for_each_point(cube<dim>(0), cube<dim>(size), [&](const Point<dim> &x) {
    scene.add(x, Kind::fluid, 0, Point<dim>::zero());
  });
  scene.setup.gravity = along<dim>(dim - 1, -9.81);
  scene.setup.depth   = size * scene.setup.spacing;
  INFO(size);
  const auto host   = engine_on("host", scene)->advance(0.001).pressure;
  const auto device = engine_on("device", scene)->advance(0.001).pressure;
  CHECK(device.not_converged == 0);
  CHECK(device.most_iterations < 1.6 * host.most_iterations);
}


TEMPLATE_TEST_CASE_SIG("Multigrid and Jacobi's method find the same pressures, one in fewer steps",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  auto scene                     = tank<dim>(12, 10);
  scene.setup.numerics.tolerance = 1e-6;
  for (const auto &executor : executors<dim>())
    {
      INFO(executor);
      unsigned int       iterations[2];
      ParticleState<dim> states[2];
      for (const int k : {0, 1})
        {
          scene.setup.numerics.preconditioner =
            k == 0 ? Numerics::Preconditioner::jacobi : Numerics::Preconditioner::multigrid;
          const auto engine = engine_on(executor, scene);
          iterations[k]     = engine->advance(0.002).pressure.iterations;
          states[k]         = state_of(*engine);
        }
      CHECK(iterations[1] < iterations[0]);
      CHECK(largest_distance(states[0], states[1]) < 1e-3 * scene.setup.spacing);
      CHECK(mean_pressure(states[1]) == Approx(mean_pressure(states[0])).epsilon(1e-4));
    }
}
