// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  /// Deflection of the first mode of a clamped beam at 0 <= xi <= 1 [1].
  double
  first_mode(const double xi)
  {
    const double k = 1.8751041;
    return std::cosh(k * xi) - std::cos(k * xi) -
           (std::sinh(k) - std::sin(k)) / (std::cosh(k) + std::cos(k)) *
             (std::sinh(k * xi) - std::sin(k * xi));
  }


  /// Measured frequency of the first mode of a plate, ten times longer than thick, over that of
  /// Landau and Lifshitz, Theory of Elasticity, section 25.
  template <int dim>
  double
  relative_frequency(const int layers)
  {
    const double       l0 = .01, E = 1e5, density = 1000, nu = .3;
    const int          length = 10 * layers;
    ParticleScene<dim> scene(l0);
    scene.setup.has_fluid = false;
    BodySetup body;
    body.density        = density;
    body.youngs_modulus = E;
    body.poissons_ratio = nu;
    body.damping        = 0;
    scene.add_body(body);
    auto upper = cube<dim>(layers), lower = cube<dim>(0);
    lower[0] = -3;
    upper[0] = length;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      const double xi = x[0] / (length * l0);
      scene.add(x, Kind::solid, 1, along<dim>(dim - 1, xi > 0 ? 5e-4 * first_mode(xi) : 0.));
      scene.setup.clamped.back() = xi < 0 ? all_directions<dim> : 0;
    });
    scene.set_free_space(2 * length * l0);

    const double stiffness = dim == 2 ? E / (1 - nu * nu) : E; // plane strain, or a beam
    const double omega =
      std::pow(1.8751041 / (length * l0), 2) * layers * l0 * std::sqrt(stiffness / (12 * density));
    const double dt          = 2 * M_PI / omega / 200;
    const auto   engine      = scene.engine();
    const double before      = engine->balance().body_centres[0][dim - 1];
    double       half_period = 0, last = 0;
    for (int step = 1; step < 200 && half_period == 0; ++step)
      {
        engine->advance(dt);
        const double now = engine->balance().body_centres[0][dim - 1] - before;
        if (last * now < 0)
          half_period = (step - now / (now - last)) * dt;
        last = now;
      }
    REQUIRE(half_period > 0);
    return M_PI / half_period / omega;
  }


  /// A free block that spins: the angle by which its energy and spin go wrong.
  template <int dim>
  void
  check_spin()
  {
    const double       l0 = .01, omega = 20;
    ParticleScene<dim> scene(l0);
    scene.setup.has_fluid = false;
    BodySetup body;
    body.damping      = 0;
    body.bulk_damping = 0;
    scene.add_body(body);
    scene.for_each_point(cube<dim>(-4), cube<dim>(4), [&](const Point<dim> &x) {
      auto v = Point<dim>::zero();
      v[0]   = -omega * x[1];
      v[1]   = omega * x[0] * 1.02; // and vibrates a little
      scene.add(x, Kind::solid, 1, v);
    });
    scene.set_free_space(.3);
    const auto engine = scene.engine();
    const auto energy = [&] {
      const auto balance = engine->balance();
      return balance.kinetic_solid + balance.elastic;
    };
    const auto spin = [&] {
      ParticleState<dim> state;
      engine->fetch(state);
      return mean(state.tags.size(), [&](const std::size_t i) {
        return state.positions[i][0] * state.velocities[i][1] -
               state.positions[i][1] * state.velocities[i][0];
      });
    };
    const double energy_before = energy(), spin_before = spin();
    for (int frame = 0; frame < 60; ++frame) // two turns
      engine->advance(.01);
    CHECK(energy() == Approx(energy_before).epsilon(5e-3));
    CHECK(spin() == Approx(spin_before).epsilon(1e-10));
    CHECK(engine->balance().body_volumes[0] == Approx(1).epsilon(.05));
  }
} // namespace


TEST_CASE("A clamped plate of particles swings with its first frequency", "[particles]")
{
  CHECK(relative_frequency<2>(4) == Approx(1).epsilon(.03));
  CHECK(relative_frequency<2>(8) == Approx(1).epsilon(.03));
  CHECK(relative_frequency<3>(4) == Approx(1).epsilon(.03));
}


TEMPLATE_TEST_CASE_SIG(
  "A body that turns keeps energy and spin", "[particles]", ((int dim), dim), 2, 3)
{
  check_spin<dim>();
}


TEST_CASE("Elasticity has a potential however far particles reach", "[particles]")
{
  for (const double reach : {1.5, 2.1, 2.5, 2.8})
    {
      ParticleScene<2> scene(.01);
      scene.setup.numerics.reach = reach;
      scene.setup.has_fluid      = false;
      scene.set_free_space(.2);
      scene.add_body(BodySetup());
      scene.for_each_point(cube<2>(0), cube<2>(8), [&](const auto &x) { // sheared and stretched
        scene.add(x, Kind::solid, 1, {{x[1] - .04, (x[1] - .04) / -2}});
      });
      const auto   engine = scene.engine();
      const double before = engine->balance().kinetic_solid;
      for (int frame = 0; frame < 10; ++frame)
        {
          engine->advance(.01);
          const auto balance = engine->balance();
          INFO("reach " << reach << ", frame " << frame);
          CHECK(balance.kinetic_solid + balance.elastic < 1.05 * before);
        }
    }
}


TEST_CASE("A body of one layer of particles is refused", "[particles]")
{
  for (const int layers : {1, 2})
    {
      ParticleScene<2> scene(.01);
      scene.setup.has_fluid = false;
      scene.set_free_space(.2);
      scene.add_body(BodySetup());
      scene.for_each_point({{0, 0}}, {{10, layers}}, [&](const auto &x) {
        scene.add(x, Kind::solid, 1, Point<2>::zero());
      });
      if (layers == 1)
        CHECK_THROWS_AS(scene.engine(), InputError);
      else
        CHECK_NOTHROW(scene.engine());
    }
}


TEMPLATE_TEST_CASE_SIG(
  "Stiff bonds do not drive the motions that they resist", "[particles]", ((int dim), dim), 2, 3)
{
  // Particles of a block that fly into all directions have energy in all frequencies. Explicit
  // steps keep a sum near the energy, which swings by a share that grows with frequency times step.
  const double       alpha = GENERATE(4., 30.), nu = GENERATE(0., .45), l0 = .01;
  ParticleScene<dim> scene(l0);
  scene.set_free_space(.3);
  scene.setup.has_fluid = false;
  BodySetup body;
  body.poissons_ratio = nu;
  body.hourglass      = alpha;
  scene.add_body(body);
  unsigned int number = 1;
  const auto   random = [&] { // from -1 to 1
    number = 1664525u * number + 1013904223u;
    return 2 * (number / 4294967296.) - 1;
  };
  scene.for_each_point(cube<dim>(0), cube<dim>(dim == 2 ? 12 : 7), [&](const Point<dim> &x) {
    Point<dim> v;
    for (int axis = 0; axis < dim; ++axis)
      v[axis] = .03 * random();
    scene.add(x, Kind::solid, 1, v);
  });
  const auto   engine = scene.engine();
  const double before = engine->balance().kinetic_solid;
  double       after  = 0;
  for (int frame = 0; frame < 40; ++frame)
    {
      const auto control = engine->advance(.005);
      CHECK(control.sub_steps == 1); // a frame that gains energy is repeated in more
      after = engine->balance().kinetic_solid + engine->balance().elastic;
      CHECK(after < 1.25 * before);
    }
  CHECK(after < before);
}
