// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .02;

  /// A jet of water falls at 5 m/s on the middle of a soft plate, two particles thick, that hangs
  /// between the walls of an empty tank.
  template <int dim>
  ParticleScene<dim>
  jet_on_plate(const int width)
  {
    const int          height = 6;
    ParticleScene<dim> scene(l0);
    scene.setup.gravity         = along<dim>(dim - 1, -9.81);
    scene.setup.depth           = width * l0;
    scene.setup.fluid_viscosity = 1e-6;
    BodySetup body;
    body.density        = 1200;
    body.youngs_modulus = 1e5;
    scene.add_body(body);
    auto lower = cube<dim>(0), upper = cube<dim>(width);
    lower[dim - 1] = height;
    upper[dim - 1] = height + 2;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      double margin = 1;
      for (int axis = 0; axis < dim - 1; ++axis)
        margin = std::min({margin, x[axis], width * l0 - x[axis]});
      scene.add(x, Kind::solid, 1, Point<dim>::zero());
      scene.setup.clamped.back() = margin < 2 * l0 ? all_directions<dim> : 0;
    });
    lower[dim - 1] = height + 3;
    upper[dim - 1] = height + 17;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      double square = 0;
      for (int axis = 0; axis < dim - 1; ++axis)
        square += std::pow(x[axis] - width * l0 / 2, 2);
      if (square < 9 * l0 * l0)
        scene.add(x, Kind::fluid, 0, along<dim>(dim - 1, -5.));
    });
    auto walls     = cube<dim>(width);
    walls[dim - 1] = 60;
    scene.add_tank(walls, 60);
    return scene;
  }


  /// Particles of water below the lowest one of the body.
  template <int dim>
  int
  count_leaked(const ParticleState<dim> &state)
  {
    double lowest = 1e30;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      if (state.tags[i].kind() == Kind::solid)
        lowest = std::min(lowest, state.positions[i][dim - 1]);
    int count = 0;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      count += state.tags[i].kind() == Kind::fluid && state.positions[i][dim - 1] < lowest;
    return count;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "A jet gets neither into a thin soft plate nor through it", "[particles]", ((int dim), dim), 2, 3)
{
  const auto         engine = jet_on_plate<dim>(dim == 2 ? 30 : 14).engine();
  ParticleState<dim> state;
  for (int frame = 0; frame < 25; ++frame)
    {
      engine->advance(.01);
      CHECK(engine->balance().fluid_in_bodies == 0);
    }
  engine->fetch(state);
  CHECK(count_leaked(state) == 0);
}
