// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

#include <random>

using namespace particle_tests;

namespace
{
  /// A block of fluid and an elastic block fly towards each other in free space.
  template <int dim>
  ParticleScene<dim>
  impact(const PairForce pair_force)
  {
    const int fluid = dim == 2 ? 20 : 10, solid = dim == 2 ? 10 : 6;

    ParticleScene<dim> scene(.01);
    scene.setup.numerics.pair_force = pair_force;
    scene.setup.fluid_viscosity     = 1e-6;
    BodySetup body;
    body.density        = 1500;
    body.youngs_modulus = 1e5;
    scene.add_body(body);
    auto lower = cube<dim>(fluid / 2 - 4), upper = cube<dim>(fluid / 2 - 4 + solid);
    lower[0] = fluid + 1;
    upper[0] = fluid + 1 + solid;
    scene.for_each_point(
      lower, upper, [&](const Point<dim> &x) { scene.add(x, Kind::solid, 1, along<dim>(0, -1.)); });
    std::mt19937                           random(3);
    std::uniform_real_distribution<double> shift(-.0005, .0005);
    scene.for_each_point(cube<dim>(0), cube<dim>(fluid), [&](Point<dim> x) {
      for (int axis = 0; axis < dim; ++axis)
        x[axis] += shift(random);
      scene.add(x, Kind::fluid, 0, along<dim>(0, 1.));
    });
    scene.set_free_space(.7);
    return scene;
  }


  template <int dim>
  Point<dim>
  momentum_of_bodies(const Balance<dim> &balance, const double mass)
  {
    return mass * balance.body_velocities[0];
  }


  /// Change of the whole momentum over what fluid and body have exchanged.
  template <int dim>
  double
  drift(const PairForce pair_force, const Precision precision)
  {
    const auto   scene  = impact<dim>(pair_force);
    const auto   engine = scene.engine(precision);
    const double mass   = 1500 * scene.setup.reference.size() * std::pow(.01, dim);
    const auto   before = engine->balance();
    const double energy = before.kinetic_fluid + before.kinetic_solid;
    for (int frame = 0; frame < (dim == 2 ? 20 : 8); ++frame)
      {
        engine->advance(.01);
        const auto now = engine->balance();
        if (pair_force == PairForce::balanced)
          CHECK(now.kinetic_fluid + now.kinetic_solid + now.elastic < energy);
      }
    const auto after     = engine->balance();
    const auto exchanged = momentum_of_bodies(after, mass) - momentum_of_bodies(before, mass);
    CHECK(std::sqrt(norm_square(exchanged)) > mass / 2); // by more than 0.5 m/s
    return std::sqrt(norm_square(after.momentum - before.momentum) / norm_square(exchanged));
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "Fluid and body exchange momentum exactly in an impact", "[particles]", ((int dim), dim), 2, 3)
{
  CHECK(drift<dim>(PairForce::balanced, Precision::double_precision) < 1e-12);
  CHECK(drift<dim>(PairForce::balanced, Precision::single_precision) < 1e-5);
  CHECK(drift<dim>(PairForce::conserving, Precision::double_precision) < 1e-12);
}
