// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "executors.h"

#include <limits>

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;


  /// Discs of two sizes and densities in rows, one above the other, in a tank without fluid; more
  /// than those that share out their sums among all workers.
  ParticleScene<2>
  falling_discs(const int rows, const int in_a_row)
  {
    ParticleScene<2> scene(l0);
    const int        pitch = 6; // [spacings]
    scene.setup.has_fluid  = false;
    scene.setup.gravity    = along<2>(1, -9.81);
    for (int k = 0; k < rows * in_a_row; ++k)
      {
        BodySetup body;
        body.density        = k % 2 == 0 ? 500 : 2000;
        body.youngs_modulus = 1e5;
        scene.add_body(body);
        const double   radius = k % 3 == 0 ? 1.3 : 2.3;
        const int      row    = k / in_a_row;
        const Point<2> centre = {
          {(pitch * (k % in_a_row) + 3 + row % 2 * 1.) * l0, (pitch * row + 3.) * l0}};
        const std::array<int, 2> lower = {{pitch * (k % in_a_row), pitch * row}};
        scene.for_each_point(lower, {{lower[0] + 8, lower[1] + 7}}, [&](const Point<2> &x) {
          if (norm_square(x - centre) < radius * radius * l0 * l0)
            scene.add(x, Kind::solid, k + 1, Point<2>::zero());
        });
      }
    scene.add_tank({{pitch * in_a_row + 2, pitch * rows + 4}}, 10);
    return scene;
  }


  /// Between particles of different bodies [spacings].
  double
  smallest_distance(const ParticleScene<2> &scene, const ParticleState<2> &state)
  {
    double square = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (state.tags[i].kind() == Kind::solid && state.tags[j].kind() == Kind::solid &&
            state.tags[i].code != state.tags[j].code)
          square = std::min(square, norm_square(state.positions[i] - state.positions[j]));
    return std::sqrt(square) / scene.setup.spacing;
  }
} // namespace


TEST_CASE("Many bodies of mixed sizes and densities settle on each other", "[particles]")
{
  for (const auto &executor : executors<2>())
    {
      const auto scene  = falling_discs(6, 5);
      const auto engine = engine_on<2>(executor, scene);
      const auto total  = [](const Balance<2> &balance) {
        return balance.kinetic_solid + balance.potential + balance.elastic;
      };
      const auto   before = engine->balance();
      const double start  = total(before);
      CHECK(before.body_volumes.size() == 30);
      for (int frame = 0; frame < 60; ++frame)
        {
          engine->advance(.01);
          const auto now = engine->balance();
          CHECK(total(now) <= start + 1e-3 * std::abs(start));
        }
      const auto after = engine->balance();
      INFO(executor << ": " << smallest_distance(scene, state_of(*engine)));
      CHECK(smallest_distance(scene, state_of(*engine)) > .7);
      CHECK(after.kinetic_solid < .05 * (start - total(after)));
      for (const double volume : after.body_volumes)
        CHECK(volume == Approx(1).margin(.03));
      // The sum of the bodies is what all particles say.
      double momentum = 0;
      for (std::size_t b = 0; b < after.body_velocities.size(); ++b)
        {
          const auto size = std::count(scene.setup.body_of.begin(), scene.setup.body_of.end(), b);
          momentum += size * l0 * l0 * scene.setup.bodies[b].density * after.body_velocities[b][1];
        }
      CHECK(momentum == Approx(after.momentum[1]).margin(1e-6));
    }
}
