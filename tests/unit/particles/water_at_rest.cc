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


  /// Mean from `begin` to `end` [s] of a run of water at rest in a tank.
  template <int dim>
  Hydrostatics
  rest(const int width, const int depth, const double begin, const double end)
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
        if (time < begin)
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


  /// Largest deviations from one, in `Hydrostatics`, and largest values of the others.
  void
  check(const Hydrostatics &found, const Hydrostatics &allowed)
  {
    INFO("mean " << found.mean << ", rms " << found.rms << ", level " << found.level
                 << ", kinetic energy " << found.kinetic);
    CHECK(std::abs(found.mean - 1) < allowed.mean);
    CHECK(found.rms < allowed.rms);
    CHECK(std::abs(found.level - 1) < allowed.level);
    CHECK(found.kinetic < allowed.kinetic);
  }
} // namespace


TEST_CASE("Water at rest in the plane has its hydrostatic pressure", "[particles]")
{
  // 1.0008, 0.10 %, 0.9986 and 1.1e-4, and a tenth of that from run to run.
  check(rest<2>(30, 30, 3, 4), {.002, .0015, .002, 2e-4});
}


// In its first second the lattice is about to dissolve, and its pressure grows 1 % slower with
// depth.
TEST_CASE("Water that settles has nearly its hydrostatic pressure", "[particles]")
{
  SECTION("2D")
  {
    check(rest<2>(30, 60, .4, .8), {.006, .006, .003, 5e-5});
  }
  SECTION("3D")
  {
    check(rest<3>(8, 16, .25, .5), {.007, .005, .006, 3e-4});
  }
}
