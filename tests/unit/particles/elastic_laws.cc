// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

#include <undine/particles/elasticity/elastic_law.h>

using namespace particle_tests;

namespace
{
  const std::vector<Law> laws = {Law::corotated,
                                 Law::linear_elastic,
                                 Law::saint_venant_kirchhoff,
                                 Law::neo_hookean,
                                 Law::nearly_incompressible_rubber};


  /// One plus something irregular, with a determinant of about J.
  template <int dim>
  Matrix<dim, double>
  sample(const double J)
  {
    auto F = Matrix<dim, double>::diagonal(std::pow(J, 1. / dim));
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        F[a][b] += .15 * std::sin(1 + 2 * a + 5 * b);
    return F;
  }


  /// A block in free space, or with gravity, without numerical viscosity.
  ParticleScene<2>
  block(const Law law)
  {
    ParticleScene<2> scene(.01);
    scene.setup.has_fluid = false;
    BodySetup body;
    body.law          = law;
    body.damping      = 0;
    body.bulk_damping = 0;
    scene.add_body(body);
    scene.set_free_space(.5);
    return scene;
  }


  double
  energy(const Engine<2> &engine)
  {
    const auto balance = engine.balance();
    return balance.kinetic_solid + balance.elastic;
  }


  template <int dim>
  void
  check_derivative(const Law law, const double J)
  {
    const ElasticMaterial<double> material{3., 2., 1., 1., 0., 0., 1., 0., 0., law};
    const ElasticLaw<dim, double> W{material};
    const Matrix<dim, double>     F = sample<dim>(J), one = Matrix<dim, double>::diagonal(1);
    const double                  small = 1e-5;
    const auto                    C     = cofactors(F);
    const auto                    D     = W.distortion_stress(F, W.rotation(F, one));
    const auto                    moved = [&](const int a, const int b, const double by) {
      auto other = F;
      other[a][b] += by;
      return W.energy(other, W.rotation(other, one));
    };
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        CHECK(D[a][b] + W.tension(F) * C[a][b] ==
              Approx((moved(a, b, small) - moved(a, b, -small)) / (2 * small)).margin(1e-6));
  }


  /// Of a vibration.
  struct Mode
  {
    double omega; ///< [rad/s]
    double ratio; ///< of damping [1]
  };


  /// The first axial mode of a bar of unit speed of sound and about the given length, measured over
  /// half a period.
  Mode
  axial_mode(const BodyDamping &damping, const bool is_implicit)
  {
    const int    length      = 20;
    const double l           = length * .01;
    auto         scene       = block(Law::saint_venant_kirchhoff);
    auto        &body        = scene.setup.bodies[0];
    body.density             = 1000;
    body.youngs_modulus      = 1000;
    body.poissons_ratio      = 0;
    scene.setup.body_damping = damping;
    scene.for_each_point({{-1, 0}}, {{length, 4}}, [&](const Point<2> &x) {
      const double v = x[0] > 0 ? .001 * std::sin(M_PI * x[0] / (2 * l)) : 0.;
      scene.add(x, Kind::solid, 1, along<2>(0, v));
      scene.setup.clamped.back() = x[0] < 0 ? all_directions<2> : 0;
    });
    scene.setup.numerics.most_elastic_steps = is_implicit ? 1 : 0;
    if (is_implicit)
      scene.setup.numerics.elastic_share = 1e-3; // so that the step may be short
    const double        dt     = 4 * l / 600;
    const auto          engine = scene.engine();
    const double        rest   = engine->balance().body_centres[0][0];
    std::vector<double> places = {0., 0.}, times, extremes;
    while (extremes.size() < 2)
      {
        const auto control = engine->advance(dt);
        CHECK((control.elastic_steps_total == control.sub_steps || !is_implicit));
        places.push_back(engine->balance().body_centres[0][0] - rest);
        const double *last = &places[places.size() - 3];
        const double  rise = last[1] - last[0], next = last[2] - last[1];
        if (rise * next < 0)
          {
            times.push_back((places.size() + (rise + next) / (2 * (rise - next))) * dt);
            extremes.push_back(last[1] + (next + rise) * (next + rise) / (8 * (rise - next)));
          }
        REQUIRE(places.size() < 1000);
      }
    const double decrement = std::log(-extremes[0] / extremes[1]);
    return {std::hypot(M_PI, decrement) / (times[1] - times[0]),
            decrement / std::hypot(M_PI, decrement)};
  }
} // namespace


TEST_CASE("The stress of each law of particles is the derivative of its energy", "[particles]")
{
  for (const Law law : laws)
    for (const double J : {.1, .5, .9, 1.6})
      {
        CAPTURE(static_cast<int>(law), J);
        check_derivative<2>(law, J);
        check_derivative<3>(law, J);
      }
}


TEST_CASE("Forces between particles belong to the energy of each law", "[particles]")
{
  for (const Law law : laws)
    {
      CAPTURE(static_cast<int>(law));
      auto scene = block(law);
      scene.for_each_point({{0, 0}}, {{8, 8}}, [&](const Point<2> &x) {
        scene.add(x, Kind::solid, 1, {{-30 * (x[0] - .04), 40 * (x[1] - .04)}});
      });
      scene.setup.numerics.elastic_share = .02;
      const auto   engine                = scene.engine();
      const double start                 = energy(*engine);
      double       stored                = 0;
      for (int frame = 0; frame < 20; ++frame)
        {
          engine->advance(5e-4);
          stored = std::max(stored, engine->balance().elastic);
          CHECK(energy(*engine) == Approx(start).epsilon(.005));
        }
      CHECK(stored > start / 2);
    }
}


TEST_CASE("Bodies that are only turned rest, but for the linear law", "[particles]")
{
  for (const Law law : laws)
    {
      CAPTURE(static_cast<int>(law));
      auto scene                         = block(law);
      scene.setup.body_damping.stiffness = 1e-4;
      scene.for_each_point({{0, 0}}, {{8, 4}}, [&](const Point<2> &x) {
        scene.add(x, Kind::solid, 1, Point<2>::zero());
        scene.state.positions.back() = {{.6 * x[0] - .8 * x[1], .8 * x[0] + .6 * x[1]}};
      });
      const auto engine = scene.engine();
      engine->advance(1e-3);
      const double moved = engine->balance().kinetic_solid;
      if (law == Law::linear_elastic)
        CHECK(moved > 1e-3);
      else
        CHECK(moved < 1e-8);
    }
}


TEST_CASE("Damping has the ratio that its coefficients say", "[particles]")
{
  const bool   is_implicit = GENERATE(false, true);
  const Mode   free        = axial_mode({}, is_implicit);
  const double eta = .2 / free.omega, alpha = .2 * free.omega;
  CHECK(free.omega == Approx(M_PI / (2 * .2)).epsilon(.03));
  CHECK(axial_mode({0, eta}, is_implicit).ratio - free.ratio == Approx(.1).epsilon(.02));
  CHECK(axial_mode({alpha, 0}, is_implicit).ratio - free.ratio == Approx(.1).epsilon(.02));
}


TEST_CASE("Damping only takes energy", "[particles]")
{
  for (const Law law : laws)
    for (const int most : {0, 1})
      {
        CAPTURE(static_cast<int>(law), most);
        auto scene                              = block(law);
        scene.setup.numerics.most_elastic_steps = most;
        scene.setup.body_damping                = {10, 1e-2}; // overdamped
        scene.for_each_point({{0, 0}}, {{8, 4}}, [&](const Point<2> &x) {
          scene.add(x, Kind::solid, 1, {{-3 * x[1], 10 * x[0] + 5 * x[1]}});
        });
        const auto engine = scene.engine();
        double     last   = energy(*engine);
        for (int frame = 0; frame < 20; ++frame)
          {
            engine->advance(2e-3);
            const double now = energy(*engine);
            CHECK(now < last);
            last = now;
          }
      }
}


TEST_CASE("A roller lets slide and does not lift", "[particles]")
{
  const int most                          = GENERATE(0, 1);
  auto      scene                         = block(Law::neo_hookean);
  scene.setup.numerics.most_elastic_steps = most;
  scene.setup.bodies[0].youngs_modulus    = 1e6;
  scene.for_each_point({{0, 0}}, {{8, 6}}, [&](const Point<2> &x) {
    const bool on_floor = x[1] < .01;
    scene.add(x, Kind::solid, 1, {{1., on_floor ? 0 : 1.}});
    scene.setup.clamped.back() = on_floor ? 2 : 0;
  });
  const auto   engine = scene.engine();
  const double before = engine->balance().body_centres[0][0];
  for (int frame = 0; frame < 10; ++frame)
    engine->advance(1e-2);
  CHECK(engine->balance().body_centres[0][0] - before == Approx(.1).epsilon(1e-3));
  ParticleState<2> state;
  engine->fetch(state);
  for (std::size_t i = 0; i < state.tags.size(); ++i)
    if (scene.setup.clamped[state.identities[i]] != 0)
      {
        CHECK(state.positions[i][1] == Approx(.005));
        CHECK(state.velocities[i][1] == 0);
      }
}
