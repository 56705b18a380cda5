// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;


  /// Part of a cylinder or ball of radius 1 that is below a plane which is `depth` above its
  /// centre.
  template <int dim>
  double
  submerged(const double depth)
  {
    const double h = 1 + depth;
    if (dim == 3)
      return h * h * (3 - h) / 4;
    const double angle = std::acos(-depth);
    return (angle - std::sin(angle) * std::cos(angle)) / M_PI;
  }


  template <int dim>
  double
  depth_of(const double density_ratio)
  {
    double lower = -1, upper = 1;
    for (int k = 0; k < 60; ++k)
      (submerged<dim>((lower + upper) / 2) < density_ratio ? lower : upper) = (lower + upper) / 2;
    return lower;
  }


  /// Mean depth of the centre below the level of the same volume of water, in the second half of a
  /// run that starts half a spacing at most from it [radii].
  template <int dim>
  double
  floats(const double density_ratio, const double radius, const int width, const double end)
  {
    const int          depth = static_cast<int>(2.5 * radius + .5);
    ParticleScene<dim> scene(l0);
    scene.setup.gravity         = along<dim>(dim - 1, -9.81);
    scene.setup.depth           = depth * l0;
    scene.setup.fluid_viscosity = 1e-6;
    BodySetup body;
    body.density        = 1000 * density_ratio;
    body.youngs_modulus = 3e5;
    scene.add_body(body);
    Point<dim> centre;
    for (int axis = 0; axis < dim; ++axis)
      centre[axis] = width * l0 / 2;
    centre[dim - 1]   = (depth - std::round(depth_of<dim>(density_ratio) * radius)) * l0;
    const auto inside = [&](const Point<dim> &x) {
      return norm_square(x - centre) < radius * radius * l0 * l0;
    };
    auto corner     = cube<dim>(width);
    corner[dim - 1] = depth + static_cast<int>(2 * radius);
    scene.for_each_point(cube<dim>(0), corner, [&](const Point<dim> &x) {
      if (inside(x))
        scene.add(x, Kind::solid, 1, Point<dim>::zero());
    });
    const std::size_t n_body = scene.state.tags.size();
    corner[dim - 1]          = depth;
    scene.for_each_point(cube<dim>(0), corner, [&](const Point<dim> &x) {
      if (!inside(x))
        scene.add(x, Kind::fluid, 0, Point<dim>::zero());
    });
    const double fluid = scene.state.tags.size() - n_body;
    corner[dim - 1]    = depth + static_cast<int>(2 * radius);
    scene.add_tank(corner, 6);

    const auto   engine = scene.engine();
    const double level  = (fluid + density_ratio * n_body) / std::pow(width, dim - 1);
    double       sum = 0, count = 0;
    for (double time = .01; time < end; time += .01)
      {
        engine->advance(.01);
        if (time < end / 2)
          continue;
        sum += level - engine->balance().body_centres[0][dim - 1] / l0;
        ++count;
      }
    return sum / count / radius;
  }
} // namespace


TEST_CASE("A cylinder floats at its depth", "[particles]")
{
  for (const double ratio : {.1, .3, .5, .8})
    {
      INFO("density ratio " << ratio);
      CHECK(floats<2>(ratio, 5, 24, 2.) == Approx(depth_of<2>(ratio)).margin(.05));
    }
}


TEST_CASE("A ball floats at its depth", "[particles]")
{
  CHECK(floats<3>(.8, 4, 12, .5) == Approx(depth_of<3>(.8)).margin(.05));
}
