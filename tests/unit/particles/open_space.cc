// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "particle_scene.h"

using namespace particle_tests;

namespace
{
  /// Semi-axes of a drop that deforms under an attraction B^2 towards its centre, with the velocity
  /// (A x, -A y): dA/dt = (A^2 + B^2) (b^2 - a^2) / (a^2 + b^2), da/dt = A a, db/dt = -A b.
  struct Ellipse
  {
    double a = 1, b = 1, A = 1;

    void
    advance(const double dt, const double B)
    {
      const auto rate = [B](const Ellipse &e) {
        return (e.A * e.A + B * B) * (e.b * e.b - e.a * e.a) / (e.a * e.a + e.b * e.b);
      };
      Ellipse middle = *this;
      middle.a *= std::exp(A * dt / 2);
      middle.b *= std::exp(-A * dt / 2);
      middle.A += dt / 2 * rate(*this);
      a *= std::exp(middle.A * dt);
      b *= std::exp(-middle.A * dt);
      A += dt * rate(middle);
    }
  };
} // namespace


TEST_CASE("A drop under a central attraction keeps its exact ellipse", "[particles]")
{
  const double     l0 = 1. / 24;
  ParticleScene<2> scene(l0);
  scene.setup.attraction = 1;
  scene.for_each_point(cube<2>(-31), cube<2>(31), [&](const Point<2> &x) {
    if (norm_square(x) < 1)
      scene.add(x, Kind::fluid, 0, Point<2>{x[0], -x[1]});
  });
  scene.set_free_space(3);
  const auto       engine = scene.engine();
  ParticleState<2> state;
  Ellipse          exact;
  for (int frame = 1; frame <= 50; ++frame)
    {
      engine->advance(.05);
      for (int part = 0; part < 100; ++part)
        exact.advance(.05 / 100, 1.);
      if (frame % 10 != 0)
        continue;
      engine->fetch(state);
      Point<2> axes;
      for (int axis = 0; axis < 2; ++axis)
        axes[axis] = 2 * std::sqrt(mean(state.tags.size(), [&](const std::size_t i) {
                       return state.positions[i][axis] * state.positions[i][axis];
                     }));
      INFO("time " << frame * .05);
      CHECK(axes[0] == Approx(exact.a).epsilon(.025));
      CHECK(axes[1] == Approx(exact.b).epsilon(.025));
    }
}


TEST_CASE("Water flows through a channel as it flows in", "[particles]")
{
  const double     l0 = .01, speed = .5;
  const int        length = 40, height = 12;
  ParticleScene<2> scene(l0);
  OpenSide         inflow, outflow;
  inflow.is_inflow            = true;
  inflow.depth                = 3 * l0;
  outflow.plane               = length * l0;
  outflow.inward              = -1;
  scene.setup.open_sides      = {inflow, outflow};
  scene.setup.lower           = {-5 * l0, -4 * l0};
  scene.setup.upper           = {(length + 4) * l0, (height + 4) * l0};
  scene.setup.fluid_viscosity = 1e-6;
  scene.for_each_point({-3, -3}, {length + 3, height + 3}, [&](const Point<2> &x) {
    const double outside = std::max(-x[1], x[1] - height * l0);
    if (outside > 0)
      scene.add(x, outside < l0 ? Kind::wall : Kind::dummy, 0, Point<2>::zero());
    else if (x[0] < 0)
      scene.add(x, x[0] > -l0 ? Kind::wall : Kind::dummy, inflow_material, along<2>(0, speed));
    else if (x[0] < length * l0 / 4) // the front has yet to fill the channel
      scene.add(x, Kind::fluid, 0, along<2>(0, speed));
  });
  const auto       engine = scene.engine();
  ParticleState<2> state;
  for (int frame = 0; frame < 150; ++frame)
    engine->advance(.01);
  engine->fetch(state);
  const auto n_fluid = std::count_if(
    state.tags.begin(), state.tags.end(), [](const Tag tag) { return tag.kind() == Kind::fluid; });
  CHECK(n_fluid == Approx(length * height).epsilon(.03));
  CHECK(mean(state.tags.size(), [&](const std::size_t i) {
          return state.tags[i].kind() == Kind::fluid ? state.velocities[i][0] : NAN;
        }) == Approx(speed).epsilon(.03));
}


TEMPLATE_TEST_CASE_SIG(
  "A uniform stream through a periodic box stays one", "[particles]", ((int dim), dim), 2, 3)
{
  const int          size = dim == 2 ? 20 : 10;
  ParticleScene<dim> scene(.01);
  scene.setup.fluid_bulk_modulus = 2.2e9; // nothing else fixes the pressure
  for (int axis = 0; axis < dim; ++axis)
    {
      scene.setup.lower[axis]    = 0;
      scene.setup.upper[axis]    = size * .01;
      scene.setup.periodic[axis] = true;
    }
  Point<dim> v;
  for (int axis = 0; axis < dim; ++axis)
    v[axis] = 1 + .3 * axis;
  scene.for_each_point(
    cube<dim>(0), cube<dim>(size), [&](const Point<dim> &x) { scene.add(x, Kind::fluid, 0, v); });
  const auto         engine = scene.engine();
  ParticleState<dim> state;
  // Not for long: a perfect cubic lattice is an unstable arrangement, which rounding upsets.
  for (int frame = 0; frame < 5; ++frame)
    engine->advance(.01);
  engine->fetch(state);
  for (const auto &velocity : state.velocities)
    REQUIRE(norm_square(velocity - v) < 1e-12);
}
