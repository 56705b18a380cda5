// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "particle_run.h"

using namespace undine_tests;
using particles::Kind;

namespace
{
  std::string
  scalars(const std::string &fields, const std::string &more = "")
  {
    return section("Effects", section("scalar transport", fields) + more);
  }


  /// A tank in which a column of water falls down.
  std::string
  falling_column(const std::string &effects)
  {
    return section("Time", "set Step = 0.2") + particle_box<2>(10) +
           section("Fluid", "set Density = 1000\n set Region = if(x < 4, 8 - y, -1)") + effects;
  }
} // namespace


TEST_CASE("carried scalars: a particle keeps its value, also in a run that is taken up again")
{
  const auto gravity = section("gravity", "set Acceleration = 0, -9.81");
  const auto text =
    falling_column(scalars(section("smoke", "set Initial value = x*y + 0.1"), gravity));
  ParticleRun<2> run(text);
  const auto     start = run.state.particles.scalars.at("smoke");
  double         sum   = 0;
  for (double x = 0.5; x < 4; ++x)
    for (double y = 0.5; y < 8; ++y)
      sum += x * y + 0.1;
  CHECK(run.column("Integral of smoke") == Approx(sum).epsilon(1e-12));
  run.advance(3);
  CHECK(run.state.particles.scalars.at("smoke") == start);
  CHECK(run.column("Integral of smoke") == Approx(sum).epsilon(1e-12));

  ParticleRun<2> resumed(text);
  resumed.state = run.state;
  resumed.advance(3);
  run.advance(3);
  CHECK(resumed.state.particles.scalars.at("smoke") == start);
  CHECK(resumed.column("Integral of smoke") == run.column("Integral of smoke"));
}


TEST_CASE("carried scalars: they do not change how particles move")
{
  const auto     gravity = section("gravity", "set Acceleration = 0, -9.81");
  ParticleRun<2> with(falling_column(
    scalars(section("smoke", "set Initial value = x"), gravity + section("convection", ""))));
  ParticleRun<2> without(falling_column(section("Effects", gravity)));
  with.advance(3);
  without.advance(3);
  REQUIRE(with.state.particles.positions.size() == without.state.particles.positions.size());
  for (std::size_t k = 0; k < with.state.particles.positions.size(); ++k)
    CHECK(norm_square(with.state.particles.positions[k] - without.state.particles.positions[k]) ==
          0);
  CHECK(without.state.particles.scalars.empty());
}


TEST_CASE("carried scalars: what flows in has the value of where and when it came in")
{
  // A plug flow into an empty channel and out of it, in frames that are shorter than asked.
  const double   speed = 2;
  ParticleRun<2> run(
    section("Time", "set Step = 5") + particle_box<2>(8) +
    section("Fluid",
            "set Density = 1000\n set Region = -1\n" +
              section("Boundaries",
                      section("in", "set Sides = left\n set Kind = inflow\n set Velocity = 2; 0") +
                        section("out", "set Sides = right\n set Kind = outflow"))) +
    scalars(section("height", "set Inflow value = y") + section("age", "set Inflow value = t") +
            section("life", "set Source = 1")));
  CHECK_THAT(run.report.note, Catch::Matchers::Contains("frames are 1.35 s long at most"));
  CHECK(run.column("Integral of height") == 0);
  run.advance(8); // more than once through it
  const auto  &state   = run.state.particles;
  const double time    = run.state.clock.time;
  double       n_fluid = 0;
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    if (state.tags[k].kind() == Kind::fluid)
      {
        const double height = state.scalars.at("height")[state.identities[k]];
        const double age    = time - state.scalars.at("age")[state.identities[k]];
        CHECK(height - std::floor(height) == Approx(0.5).epsilon(1e-6));
        CHECK(std::abs(height - state.positions[k][1]) < 0.2);
        CHECK(age == Approx(state.positions[k][0] / speed).margin(0.2));
        CHECK(state.scalars.at("life")[state.identities[k]] == Approx(age).epsilon(1e-6));
        ++n_fluid;
      }
  CHECK(n_fluid > 50);
  CHECK(run.column("Integral of height") == Approx(4 * n_fluid).epsilon(0.05));
}
