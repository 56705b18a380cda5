// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

TEST_CASE("The friction velocity follows the law of the wall", "[particles]")
{
  const double nu = 1e-6, y = .005;
  for (const double u_star : {1e-4, 5e-4, 1e-3, .01, .1, 1.})
    for (const double roughness : {0., 1e-5, 1e-3})
      {
        const double plus  = y * u_star / nu;
        const double log   = std::log(plus / (1 + .26 * roughness * u_star / nu)) / .41 + 5.2;
        const double speed = u_star * std::min(plus, log);
        if (log < 3) // not next to such a rough wall: y is in the roughness
          continue;
        INFO("u* = " << u_star << ", roughness " << roughness);
        CHECK(WallFriction<double>{nu, roughness}.friction_velocity(speed, y) ==
              Approx(u_star).epsilon(1e-3));
      }
}


namespace
{
  constexpr double l0 = .01, nu = 1e-6, roughness = 1e-3; // [m], [m^2/s], [m]
  constexpr int    depth = 6;                             // [spacings]

  /// A layer of water that moves at 1 m/s over a bed, periodic along it.
  template <int dim>
  ParticleScene<dim>
  stream(const int length)
  {
    ParticleScene<dim> scene(l0);
    auto               lower = cube<dim>(0), upper = cube<dim>(length);
    lower[dim - 1]      = -3;
    upper[dim - 1]      = depth;
    scene.setup.gravity = along<dim>(dim - 1, -9.81);
    scene.setup.depth   = depth * l0;
    for (int axis = 0; axis < dim; ++axis)
      {
        scene.setup.lower[axis]    = axis == dim - 1 ? -4 * l0 : 0;
        scene.setup.upper[axis]    = (axis == dim - 1 ? depth + 4 : length) * l0;
        scene.setup.periodic[axis] = axis < dim - 1;
      }
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      const double below = -x[dim - 1];
      if (below > 0)
        scene.add(x, below < l0 ? Kind::wall : Kind::dummy, 0, Point<dim>::zero());
      else
        scene.add(x, Kind::fluid, 0, along<dim>(0, 1.));
    });
    return scene;
  }


  struct Lost
  {
    double found;    ///< momentum [kg m/s]
    double expected; ///< by the law of the wall, from the speed of the layer at the bed
  };


  template <int dim>
  Lost
  run(const ParticleScene<dim> &scene, const double area)
  {
    const WallFriction<double> friction{nu, roughness};
    const auto                 engine = scene.engine();
    ParticleState<dim>         state  = scene.state;
    const double               start = engine->balance().momentum[0], step = .005;
    Lost                       lost{0, 0};
    for (int k = 0; k < 30; ++k)
      {
        const double u = mean(state.tags.size(), [&](const std::size_t i) {
          const double height = state.positions[i][dim - 1];
          return state.tags[i].kind() == Kind::fluid && height < l0 ? state.velocities[i][0] : NAN;
        });
        lost.expected += step * area * 1000 * std::pow(friction.friction_velocity(u, l0 / 2), 2);
        engine->advance(step);
        engine->fetch(state);
      }
    lost.found = start - engine->balance().momentum[0];
    return lost;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("A stream loses to its bed the momentum that the law of the wall says",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  const int    length        = dim == 2 ? 20 : 8;
  const double area          = std::pow(length * l0, dim - 1);
  auto         scene         = stream<dim>(length);
  const auto   without       = run(scene, area);
  scene.setup.wall_viscosity = nu;
  scene.setup.wall_roughness = roughness;
  const auto with            = run(scene, area);
  INFO("without it " << without.found << " kg m/s are lost, with it " << with.found);
  CHECK(without.found < with.expected); // a bed of particles is a little rough by itself
  CHECK(with.found - without.found == Approx(with.expected).epsilon(.1));
}
