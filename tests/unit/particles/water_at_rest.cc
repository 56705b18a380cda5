// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  struct Hydrostatics
  {
    double mean;    ///< of the pressure over that of the water above
    double rms;     ///< of the difference over that at the bottom
    double level;   ///< over the initial depth
    double kinetic; ///< energy over the potential one above the floor
  };


  template <int dim>
  double
  level_of(const ParticleState<dim> &state)
  {
    return 2 * mean(state.tags.size(), [&](const std::size_t i) {
             return state.tags[i].kind() == Kind::fluid ? state.positions[i][dim - 1] : NAN;
           });
  }


  /// Mean over the second half of a run of water at rest in a tank.
  template <int dim>
  Hydrostatics
  rest(const int width, const int depth, const double end)
  {
    const double       l0 = .01;
    ParticleScene<dim> scene(l0);
    auto               size     = cube<dim>(width);
    size[dim - 1]               = depth + 8;
    scene.setup.gravity         = along<dim>(dim - 1, -9.81);
    scene.setup.depth           = depth * l0;
    scene.setup.fluid_viscosity = 1e-6;
    scene.add_tank(size, 4);
    size[dim - 1] = depth;
    scene.for_each_point(cube<dim>(0), size, [&](const Point<dim> &x) {
      scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    });

    const auto         engine = scene.engine();
    ParticleState<dim> state;
    double             pressure = 0, expected = 0, square = 0, count = 0, level = 0, kinetic = 0;
    for (double time = .01; time < end; time += .01)
      {
        engine->advance(.01);
        if (time < end / 2)
          continue;
        engine->fetch(state);
        level   = level_of(state);
        kinetic = mean(state.tags.size(),
                       [&](const std::size_t i) {
                         return state.tags[i].kind() == Kind::fluid
                                  ? norm_square(state.velocities[i])
                                  : NAN;
                       }) /
                  (9.81 * level);
        for (std::size_t i = 0; i < state.tags.size(); ++i)
          {
            const double below = level - state.positions[i][dim - 1];
            if (state.tags[i].kind() != Kind::fluid || below < 2 * l0)
              continue;
            pressure += state.pressures[i];
            expected += 9810 * below;
            square += std::pow(state.pressures[i] - 9810 * below, 2);
            ++count;
          }
      }
    return {pressure / expected,
            std::sqrt(square / count) / (9810 * depth * l0),
            level / (depth * l0),
            kinetic};
  }
} // namespace


TEST_CASE("Water at rest in the plane has its hydrostatic pressure", "[particles]")
{
  for (const int depth : {30, 60})
    {
      const auto result = rest<2>(30, depth, depth == 30 ? 1.5 : .8);
      INFO("depth " << depth << ": mean " << result.mean << ", rms " << result.rms << ", level "
                    << result.level << ", kinetic energy " << result.kinetic);
      CHECK(result.mean == Approx(1).epsilon(.01));
      CHECK(result.rms < .02);
      CHECK(result.level == Approx(1).epsilon(.01));
      CHECK(result.kinetic < 3e-4);
    }
}


TEST_CASE("Water at rest in space has its hydrostatic pressure", "[particles]")
{
  const auto result = rest<3>(8, 16, .5);
  INFO("mean " << result.mean << ", rms " << result.rms << ", level " << result.level);
  CHECK(result.mean == Approx(1).epsilon(.01));
  CHECK(result.rms < .02);
  CHECK(result.level == Approx(1).epsilon(.01)); // it settles from the lattice into disorder
}
