// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/elasticity/volume_law.h>
#include <undine/particles/math/rotation.h>

#include <catch2/catch.hpp>

#include "particle_scene.h"

#include <random>

using namespace particle_tests;

namespace
{
  constexpr double l0 = .01;

  template <int dim>
  Matrix<dim, double>
  random_matrix(std::mt19937 &random)
  {
    std::normal_distribution<double> number;
    Matrix<dim, double>              result;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        result[a][b] = number(random);
    return result;
  }


  template <int dim>
  Matrix<dim, double>
  transpose(const Matrix<dim, double> &m)
  {
    Matrix<dim, double> result;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        result[a][b] = m[b][a];
    return result;
  }


  template <int dim>
  double
  largest_difference(const Matrix<dim, double> &m, const Matrix<dim, double> &n)
  {
    double result = 0;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        result = std::max(result, std::abs(m[a][b] - n[a][b]));
    return result;
  }


  /// A soft ball of radius 4 l0 is thrown down in a dry tank, at 3 m/s.
  template <int dim>
  ParticleScene<dim>
  thrown_ball(const BodySetup &body)
  {
    ParticleScene<dim> scene(l0);
    scene.setup.has_fluid = false;
    scene.setup.gravity   = along<dim>(dim - 1, -9.81);
    scene.add_body(body);
    Point<dim> centre;
    for (int axis = 0; axis < dim; ++axis)
      centre[axis] = 8 * l0;
    centre[dim - 1] = 12 * l0;
    scene.for_each_point(cube<dim>(0), cube<dim>(20), [&](const Point<dim> &x) {
      if (norm_square(x - centre) < 16 * l0 * l0)
        scene.add(x, Kind::solid, 1, along<dim>(dim - 1, -3.));
    });
    auto walls     = cube<dim>(16);
    walls[dim - 1] = 30;
    scene.add_tank(walls, 10);
    return scene;
  }


  /// A single column of wall particles, 5 l0 high, in the middle of the floor.
  template <int dim>
  void
  add_spike(ParticleScene<dim> &scene)
  {
    auto lower     = cube<dim>(8);
    auto upper     = cube<dim>(9);
    lower[dim - 1] = 0;
    upper[dim - 1] = 5;
    scene.for_each_point(
      lower, upper, [&](const Point<dim> &x) { scene.add(x, Kind::wall, 0, Point<dim>::zero()); });
  }


  BodySetup
  jelly(const double modulus, const double density)
  {
    BodySetup body;
    body.youngs_modulus = modulus;
    body.density        = density;
    body.poissons_ratio = .49;
    return body;
  }


  /// Of two particles of bodies [m].
  template <int dim>
  double
  smallest_distance(const ParticleState<dim> &state)
  {
    double smallest = 1;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      for (std::size_t j = 0; j < i && state.tags[i].kind() == Kind::solid; ++j)
        if (state.tags[j].kind() == Kind::solid)
          smallest = std::min(smallest, norm_square(state.positions[i] - state.positions[j]));
    return std::sqrt(smallest);
  }


  template <int dim>
  void
  check_survival(const ParticleScene<dim> &scene)
  {
    const auto engine = scene.engine();
    const auto energy = [&] {
      const auto balance = engine->balance();
      return balance.kinetic_solid + balance.potential + balance.elastic;
    };
    const double before = energy(), speed = scene.state.velocities[0][dim - 1];
    const double kinetic = engine->balance().kinetic_solid;
    CHECK(speed == -3);
    ParticleState<dim> state;
    for (int frame = 0; frame < 40; ++frame)
      {
        engine->advance(.01);
        CHECK(energy() < before + 1e-3 * kinetic);
        engine->fetch(state);
        CHECK(smallest_distance(state) > .05 * l0); // neighbours, too, where the body is folded
      }
    double lowest = 1;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      if (state.tags[i].kind() == Kind::solid)
        lowest = std::min(lowest, state.positions[i][dim - 1]);
    CHECK(lowest > -.5 * l0); // not in the floor's particles
    CHECK(engine->balance().body_volumes[0] > .75);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "The rotation of any deformation is the nearest one", "[particles]", ((int dim), dim), 2, 3)
{
  std::mt19937 random(1);
  const auto   start    = Matrix<dim, double>::diagonal(1);
  int          inverted = 0;
  for (int k = 0; k < 200; ++k)
    {
      const auto F = random_matrix<dim>(random);
      auto       R = start;
      for (int step = 0; step < 50; ++step) // of a body that rests
        R = rotation_of(F, R);
      const auto S = transpose(R) * F;
      inverted += determinant(F) < 0;
      CHECK(determinant(R) == Approx(1));
      CHECK(largest_difference(transpose(R) * R, start) < 1e-7);
      CHECK(largest_difference(S, transpose(S)) < 1e-5);
      const auto other = rotation_of(random_matrix<dim>(random), start);
      CHECK(double_contraction(R, F) > double_contraction(other, F) - 1e-9);
    }
  CHECK(inverted > 50);
}


TEST_CASE("The tension of a volume is the slope of its energy", "[particles]")
{
  const VolumeLaw<double> law{2e4, 5e4};
  const double            h = 1e-6;
  for (double J = -.5; J < 2; J += .0137)
    {
      INFO("J = " << J);
      CHECK((law.energy(J + h) - law.energy(J - h)) / (2 * h) ==
            Approx(law.tension(J)).epsilon(1e-5).margin(1e-2));
      CHECK((law.tension(J + h) - law.tension(J - h)) / (2 * h) ==
            Approx(law.stiffness(J)).epsilon(1e-4));
    }
  CHECK(law.tension(1.01) == Approx(.01 * 2e4));
  CHECK(law.tension(.3) < -50 * 5e4);
}


TEMPLATE_TEST_CASE_SIG("A soft heavy ball survives a hard fall on a floor and on a spike",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const auto &body : {jelly(1e4, 8000), jelly(1e3, 1200)})
    {
      auto scene = thrown_ball<dim>(body);
      check_survival(scene);
      add_spike(scene);
      check_survival(scene);
    }
}
