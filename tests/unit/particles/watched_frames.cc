// SPDX-License-Identifier: LGPL-2.1-or-later
// Somebody may look at a frame while it goes on, and abandon it; nobody changes it by looking.
#include "executors.h"

#include <catch2/catch.hpp>

#include <cstring>

using namespace particle_tests;

namespace
{
  constexpr double frame = 0.02; // [s], of many sub-steps


  /// A column of water that falls over, with an elastic ball in it.
  template <int dim>
  ParticleScene<dim>
  falling_column()
  {
    ParticleScene<dim>   scene(0.01);
    std::array<int, dim> size = cube<dim>(6);
    size[0]                   = 12;
    BodySetup ball;
    ball.youngs_modulus = 1e4;
    const int  body     = scene.add_body(ball);
    const auto centre   = [&] {
      auto result = Point<dim>::zero();
      for (int axis = 0; axis < dim; ++axis)
        result[axis] = 3 * scene.setup.spacing;
      return result;
    }();
    const auto in_ball = [&](const Point<dim> &x) {
      return norm_square(x - centre) < 2.2 * 2.2 * scene.setup.spacing * scene.setup.spacing;
    };
    scene.for_each_point(cube<dim>(0), cube<dim>(6), [&](const Point<dim> &x) {
      if (in_ball(x))
        scene.add(x, Kind::solid, body + 1, Point<dim>::zero());
    });
    scene.add_tank(size, 10);
    scene.for_each_point(cube<dim>(0), cube<dim>(6), [&](const Point<dim> &x) {
      if (!in_ball(x))
        scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    });
    scene.setup.gravity = along<dim>(dim - 1, -9.81);
    scene.setup.depth   = 6 * scene.setup.spacing;
    return scene;
  }


  template <class T>
  bool
  same_bits(const std::vector<T> &a, const std::vector<T> &b)
  {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  }

  template <int dim>
  bool
  same_bits(const ParticleState<dim> &a, const ParticleState<dim> &b)
  {
    return same_bits(a.positions, b.positions) && same_bits(a.velocities, b.velocities) &&
           same_bits(a.pressures, b.pressures) && same_bits(a.identities, b.identities);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("looking at frames does not change them", "", ((int dim), dim), 2, 3)
{
  const auto scene = falling_column<dim>();
  for (const auto &executor : executors<dim>())
    {
      CAPTURE(executor);
      const auto   alone = engine_on(executor, scene), watched = engine_on(executor, scene);
      unsigned int looks = 0, sub_steps = 0;
      double       so_far = 0;
      watched->watch(
        [&](const StepControl &control) {
          ++looks;
          CHECK(control.elapsed > so_far);
          CHECK(control.elapsed < control.frame * (1 + 1e-12));
          so_far = control.elapsed;
          return true;
        },
        1e-9); // shorter than any sub-step
      for (unsigned int k = 0; k < 3; ++k)
        {
          so_far            = 0;
          const auto first  = alone->advance(frame);
          const auto second = watched->advance(frame);
          CHECK(first.sub_steps == second.sub_steps);
          CHECK(first.pressure.iterations == second.pressure.iterations);
          sub_steps += second.sub_steps;
        }
      // Each frame ends with a batch that nobody needs to look at; the device's first one may be
      // as long as the frame before.
      CHECK(looks >= 3);
      if (executor == "host")
        CHECK(looks + 2 * 3 >= sub_steps);
      CHECK(same_bits(state_of(*alone), state_of(*watched)));
    }
}


TEMPLATE_TEST_CASE_SIG("a frame that is abandoned has not been", "", ((int dim), dim), 2, 3)
{
  const auto scene = falling_column<dim>();
  for (const auto &executor : executors<dim>())
    {
      CAPTURE(executor);
      const auto alone = engine_on(executor, scene), stopped = engine_on(executor, scene);
      alone->advance(frame);
      stopped->advance(frame);
      const auto   before = state_of(*stopped);
      unsigned int looks  = 0;
      stopped->watch([&](const StepControl &) { return ++looks < 3; }, 1e-9);
      REQUIRE_THROWS_AS(stopped->advance(frame), FrameAbandoned);
      CHECK(looks == 3);
      CHECK(same_bits(before, state_of(*stopped)));

      stopped->watch({}, 1);
      alone->advance(frame);
      stopped->advance(frame);
      CHECK(same_bits(state_of(*alone), state_of(*stopped)));
    }
}
