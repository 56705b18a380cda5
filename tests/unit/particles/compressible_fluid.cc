// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01, gravity = 9.81, density = 1000;
  constexpr int    depth = 30;


  /// Mean height of a column of water at rest [m].
  double
  mean_height(const double bulk_modulus, const double longest)
  {
    ParticleScene<2> scene(l0);
    scene.setup.gravity                   = along<2>(1, -gravity);
    scene.setup.depth                     = depth * l0;
    scene.setup.fluid_density             = density;
    scene.setup.fluid_viscosity           = 1e-3;
    scene.setup.fluid_bulk_modulus        = bulk_modulus;
    scene.setup.numerics.largest_sub_step = longest;
    scene.for_each_point({{0, 0}}, {{12, depth}}, [&](const auto &x) {
      scene.add(x, Kind::fluid, 0, Point<2>::zero());
    });
    scene.add_tank({{12, depth}}, 6);
    const auto engine = scene.engine();
    double     sum    = 0;
    for (int frame = 0; frame < 30; ++frame)
      {
        engine->advance(.05);
        if (frame < 20)
          continue;
        ParticleState<2> state;
        engine->fetch(state);
        sum += mean(state.tags.size(), [&](const std::size_t i) {
          return state.tags[i].kind() == Kind::fluid ? state.positions[i][1] : NAN;
        });
      }
    return sum / 10;
  }
} // namespace


TEST_CASE("A column of compressible fluid sinks under its own weight", "[particles]")
{
  // What is at the height y sinks by rho g (H y - y^2 / 2) / K: in the mean by rho g H^2 / (3 K).
  const double K        = 1e5;
  const double H        = depth * l0;
  const double expected = density * gravity * H * H / (3 * K);
  for (const double longest : {0., 1e-3})
    {
      const double sinks = mean_height(0, longest) - mean_height(K, longest);
      INFO("sub-steps of " << longest << " s at most: " << sinks << " m for " << expected);
      CHECK(sinks == Approx(expected).epsilon(.2));
    }
}
