// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;

  /// A ball in the middle of a tank of water that is `size` spacings wide and deep.
  template <int dim>
  ParticleScene<dim>
  ball_in_tank(const int size, const double radius, const BodySetup &body)
  {
    ParticleScene<dim> scene(l0);
    scene.setup.gravity         = along<dim>(dim - 1, -9.81);
    scene.setup.depth           = size * l0;
    scene.setup.fluid_viscosity = 1e-6;
    scene.add_body(body);
    Point<dim> centre;
    for (int axis = 0; axis < dim; ++axis)
      centre[axis] = size * l0 / 2;
    const auto inside = [&](const Point<dim> &x) {
      return norm_square(x - centre) < radius * radius * l0 * l0;
    };
    scene.for_each_point(cube<dim>(0), cube<dim>(size), [&](const Point<dim> &x) {
      if (inside(x))
        scene.add(x, Kind::solid, 1, Point<dim>::zero());
    });
    scene.for_each_point(cube<dim>(0), cube<dim>(size), [&](const Point<dim> &x) {
      if (!inside(x))
        scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    });
    auto walls = cube<dim>(size);
    walls[dim - 1] += 6;
    scene.add_tank(walls, 4);
    return scene;
  }


  /// Released from rest: the way it has gone over a t^2 / 2 with the acceleration a of potential
  /// flow, after 5 % and after 50 % of its radius.
  struct Travel
  {
    double start, half_radius;
  };

  BodySetup
  stiff_body(const double density_ratio)
  {
    BodySetup body;
    body.density        = 1000 * density_ratio;
    body.youngs_modulus = 1e6;
    body.poissons_ratio = .49;
    return body;
  }


  /// Added mass over displaced mass of a ball in the middle of a cubic tank, open at the top,
  /// `share`: its radius over the tank's width. The ball is a dipole, whose images in the walls
  /// (which reflect the flow) and in the surface (where the potential is zero) make a lattice of
  /// dipoles; they give the water around the ball a velocity S (U - w) = w. Exact but for the
  /// images' gradients, which matter to share^5.
  template <int dim>
  double
  added_mass(const double share)
  {
    const int reach = dim == 2 ? 80 : 20;
    double    S     = 0;
    auto      k     = cube<dim>(-reach);
    for (bool more = true; more;)
      {
        double square = 0;
        for (const int index : k)
          square += index * index;
        const int up = ((k[dim - 1] % 4) + 4) % 4;
        if (square > 0)
          S += (up < 2 ? 1 : -1) * (dim * k[dim - 1] * k[dim - 1] / square - 1) *
               std::pow(share, dim) / ((dim - 1) * std::pow(square, dim / 2.));
        more = false;
        for (int axis = 0; axis < dim && !more; ++axis)
          {
            more    = k[axis] < reach;
            k[axis] = more ? k[axis] + 1 : -reach;
          }
      }
    return (1 - dim * S / (1 + S)) / (dim - 1);
  }


  template <int dim>
  Travel
  released(const double density_ratio, const ParticleScene<dim> &scene, const int size)
  {
    const auto   engine = scene.engine();
    const double volume = scene.setup.reference.size() * std::pow(l0, dim);
    const double R      = dim == 2 ? std::sqrt(volume / M_PI) : std::cbrt(3 * volume / (4 * M_PI));
    const double a =
      (1 - density_ratio) * 9.81 / (density_ratio + added_mass<dim>(R / (size * l0)));
    const double x0 = engine->balance().body_centres[0][dim - 1];
    Travel       travel{0, 0};
    for (double time = .002; travel.half_radius == 0 && time < .4; time += .002)
      {
        engine->advance(.002);
        const double way   = engine->balance().body_centres[0][dim - 1] - x0;
        const double ratio = way / (a * time * time / 2);
        if (travel.start == 0 && std::abs(way) > .05 * R)
          travel.start = ratio;
        if (std::abs(way) > .5 * R)
          travel.half_radius = ratio;
      }
    return travel;
  }
} // namespace


TEST_CASE("A cylinder released in water accelerates with its added mass", "[particles]")
{
  for (const double ratio : {.1, .5, 2., 8.})
    {
      const auto travel = released<2>(ratio, ball_in_tank<2>(50, 5, stiff_body(ratio)), 50);
      INFO("density ratio " << ratio << ": " << travel.start << ", " << travel.half_radius);
      CHECK(travel.start == Approx(1).epsilon(.1));
      CHECK(travel.half_radius == Approx(1).epsilon(.12));
    }
}


TEST_CASE("A ball released in water accelerates with its added mass", "[particles]")
{
  for (const double ratio : {.1, 8.})
    {
      const auto travel = released<3>(ratio, ball_in_tank<3>(16, 4, stiff_body(ratio)), 16);
      INFO("density ratio " << ratio << ": " << travel.start << ", " << travel.half_radius);
      CHECK(travel.start == Approx(1).epsilon(.1));
      CHECK(travel.half_radius == Approx(1).epsilon(.12));
    }
}


TEST_CASE("A very stiff cylinder takes implicit steps and accelerates alike", "[particles]")
{
  auto body           = stiff_body(2);
  body.youngs_modulus = 1e9;
  auto scene          = ball_in_tank<2>(50, 5, body);

  scene.setup.numerics.most_elastic_steps = 20;
  CHECK(scene.engine()->advance(.002).elastic_steps_total == 2);
  const auto travel = released<2>(2, scene, 50);
  CHECK(travel.start == Approx(1).epsilon(.1));
  CHECK(travel.half_radius == Approx(1).epsilon(.12));
}


TEST_CASE("With surface pressures a cylinder in water is stable, but not accurate", "[particles]")
{
  auto scene = ball_in_tank<2>(40, 5, stiff_body(2));

  scene.setup.numerics.coupling = Coupling::surface_pressure;
  const auto engine             = scene.engine();
  for (int frame = 0; frame < 10; ++frame)
    engine->advance(.01);
  CHECK(engine->balance().body_velocities[0][1] < 0);
  CHECK(engine->balance().body_volumes[0] == Approx(1).epsilon(.01));
}


TEST_CASE("A compressible cylinder is squeezed as its bulk modulus says", "[particles]")
{
  BodySetup body;
  body.density          = 1000;
  body.youngs_modulus   = 1e5;
  body.poissons_ratio   = .3;
  const auto   scene    = ball_in_tank<2>(40, 5, body);
  const auto   engine   = scene.engine();
  const double bulk     = body.youngs_modulus / (2 * (1 + .3) * (1 - 2 * .3)); // lambda + mu
  double       squeezed = 0, expected = 0;
  for (int frame = 0; frame < 80; ++frame)
    {
      engine->advance(.01);
      if (frame < 40)
        continue;
      const auto balance = engine->balance();
      squeezed += 1 - balance.body_volumes[0];
      expected += 9810 * (40 * l0 - balance.body_centres[0][1]) / bulk;
    }
  CHECK(squeezed / expected == Approx(1).epsilon(.05));
}
