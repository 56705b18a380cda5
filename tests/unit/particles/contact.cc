// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;

  BodySetup
  rubber()
  {
    BodySetup body;
    body.density        = 1000;
    body.youngs_modulus = 1e5;
    return body;
  }


  /// A ball of the next body.
  template <int dim>
  void
  add_ball(ParticleScene<dim> &scene,
           const Point<dim>   &centre,
           const double        radius,
           const Point<dim>   &velocity)
  {
    const int material = scene.add_body(rubber()) + 1;
    scene.for_each_point(cube<dim>(-20), cube<dim>(40), [&](const Point<dim> &x) {
      if (norm_square(x - centre) < radius * radius)
        scene.add(x, Kind::solid, material, velocity);
    });
  }


  /// In a dry tank, its centre `height` [m] above the floor, with a downward `speed` [m/s].
  template <int dim>
  ParticleScene<dim>
  falling_ball(const double height, const double speed)
  {
    ParticleScene<dim> scene(l0);
    scene.setup.has_fluid = false;
    scene.setup.gravity   = along<dim>(dim - 1, -9.81);
    Point<dim> centre;
    for (int axis = 0; axis < dim; ++axis)
      centre[axis] = axis == dim - 1 ? height : 6 * l0;
    add_ball(scene, centre, 4 * l0, along<dim>(dim - 1, -speed));
    scene.add_tank(cube<dim>(12), 10);
    return scene;
  }


  /// Between particles that are not of one body [m].
  template <int dim>
  double
  smallest_distance(const ParticleState<dim> &state)
  {
    double square = 1e30;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (state.tags[i].code != state.tags[j].code && state.tags[i].kind() != Kind::dummy &&
            state.tags[j].kind() != Kind::dummy)
          square = std::min(square, norm_square(state.positions[i] - state.positions[j]));
    return std::sqrt(square);
  }


  template <int dim>
  double
  energy(const Balance<dim> &balance)
  {
    return balance.kinetic_solid + balance.potential + balance.elastic;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "Two balls collide without passing through each other", "[particles]", ((int dim), dim), 2, 3)
{
  ParticleScene<dim> scene(l0);
  scene.setup.has_fluid = false;
  const double radius   = 4 * l0;
  auto         second   = along<dim>(0, 9.5 * l0);
  second[1]             = 2 * l0; // not head-on
  add_ball(scene, Point<dim>::zero(), radius, along<dim>(0, 1.));
  add_ball(scene, second, radius, along<dim>(0, -1.));
  scene.set_free_space(.3);
  const auto         engine  = scene.engine();
  const auto         before  = engine->balance();
  double             closest = 1;
  ParticleState<dim> state;
  for (int frame = 0; frame < 12; ++frame)
    {
      engine->advance(.005);
      engine->fetch(state);
      closest = std::min(closest, smallest_distance(state));
      CHECK(energy(engine->balance()) < energy(before) * (1 + 1e-3));
    }
  const auto after = engine->balance();
  CHECK(closest > .6 * l0);
  CHECK(after.body_velocities[0][0] < 0); // they parted
  CHECK(after.body_velocities[1][0] > 0);
  CHECK(std::sqrt(norm_square(after.momentum - before.momentum)) <
        1e-12 * 1000 * scene.state.tags.size() * std::pow(l0, dim));
}


TEMPLATE_TEST_CASE_SIG("A ball released at rest meets a wall within one long frame",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  const auto   scene  = falling_ball<dim>(7.2 * l0, 0);
  const auto   engine = scene.engine();
  const double before = energy(engine->balance());
  engine->advance(.1); // it could fall by five spacings
  CHECK(energy(engine->balance()) < before + 1e-3 * std::abs(before));
  CHECK(engine->balance().body_centres[0][dim - 1] > 3 * l0);
}


TEMPLATE_TEST_CASE_SIG(
  "A ball that falls on a wall stays above it", "[particles]", ((int dim), dim), 2, 3)
{
  const auto         scene  = falling_ball<dim>(6 * l0, 1);
  const auto         engine = scene.engine();
  const double       before = energy(engine->balance());
  ParticleState<dim> state;
  for (int frame = 0; frame < 30; ++frame)
    {
      engine->advance(.01);
      CHECK(energy(engine->balance()) < before + 1e-3 * std::abs(before));
      CHECK(engine->balance().body_centres[0][dim - 1] > 3 * l0);
    }
  engine->fetch(state);
  CHECK(smallest_distance(state) > .5 * l0);
}
