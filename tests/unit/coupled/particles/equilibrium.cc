// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/scheme/relaxation.h>

#include <catch2/catch.hpp>
#include <message_of.h>

#include "particle_run.h"

using namespace undine_tests;

namespace
{
  /// A beam of 10 m x 2 m under its weight, without a domain.
  std::string
  beam(const std::string &time, const std::string &boundaries, const std::string &more = "")
  {
    return section("Time", time) +
           section("Particles", "set Spacing = 1\n set Precision = double") +
           section("Bodies",
                   section("beam",
                           "set Lower corner = 0, 0\n set Upper corner = 10, 2\n set Density = "
                           "1000\n set Young's modulus = 2e7\n set Poisson's ratio = 0.3\n "
                           "set Bond damping = 1\n" +
                             section("Boundaries", boundaries))) +
           section("Effects", section("gravity", "set Acceleration = 0, -9.81")) + more;
  }


  const std::string held = section("root", "set Sides = left");


  /// How far the end has gone.
  particles::Vector<2, double>
  deflection(const ParticleRun<2> &run)
  {
    const auto &setup  = run.models.particles->setup();
    const int   end    = setup.reference.size() - 1;
    const auto &all    = run.state.particles;
    const auto  number = std::find(all.identities.begin(), all.identities.end(), end);
    return all.positions[number - all.identities.begin()] - setup.reference[end];
  }
} // namespace


TEST_CASE("equilibrium of particles: bodies at rest, which stay there when they are let go")
{
  ParticleRun<2> at_rest(beam("set Step = 1\n set Integrator = static", held));
  at_rest.advance(1);
  const double found = deflection(at_rest)[1], elastic = at_rest.column("Elastic energy");
  CHECK(found < -0.5);
  CHECK(at_rest.column("Kinetic energy of bodies") == 0);
  CHECK(at_rest.column("Stops") > 1);
  CHECK(at_rest.column("Released energy over elastic energy") <= Relaxation<2>::tolerance);

  // More than a period of its slowest motion, in which it would go twice as far from rest.
  ParticleRun<2> moving(beam("set Step = 0.5", held));
  const double   potential = moving.column("Potential energy");
  moving.advance(1);
  CHECK(moving.column("Kinetic energy of bodies") > 0.01 * elastic);
  moving.state.particles = at_rest.state.particles;
  moving.state.clock.time += 1; // what the engine holds is not this state
  for (unsigned int frame = 0; frame < 8; ++frame)
    {
      moving.advance(1);
      CHECK(moving.column("Kinetic energy of bodies") < 3e-8 * elastic);
      CHECK(deflection(moving)[1] == Approx(found).epsilon(1e-3));
    }

  // In equilibrium under a force that grows linearly, that has done twice the work.
  CHECK(potential - at_rest.column("Potential energy") == Approx(2 * elastic).epsilon(0.05));

  // The next one has the same loads, and so nothing to do.
  at_rest.advance(1);
  CHECK(at_rest.column("Stops") == 0);
  CHECK(deflection(at_rest)[1] == Approx(found).epsilon(1e-4));
}


TEST_CASE("equilibrium of particles: there is room around bodies without a domain")
{
  const ParticleRun<2> run(beam("set Step = 1", held));
  const auto          &box = run.models.particles->domain();
  CHECK(box.lower[0] == Approx(-10));
  CHECK(box.upper[0] == Approx(20));
  CHECK(box.lower[1] == Approx(-10));
  CHECK(box.upper[1] == Approx(12));
  CHECK(count(*run.models.particles, particles::Kind::wall) == 0);
}


TEST_CASE("equilibrium of particles: what has none is refused or given up")
{
  const auto contains = [](const std::string &words) { return Catch::Matchers::Contains(words); };
  ParticleRun<2> falling(beam("set Step = 1\n set Integrator = static", ""));
  CHECK_THAT(message_of([&] { falling.advance(1); }), contains("held"));
  CHECK_THAT(message_of([&] {
               ParticleRun<2>(
                 beam("set Step = 1\n set Integrator = static",
                      held,
                      section("Domain", "set Lower corner = 0, -9\n set Upper corner = 20, 11") +
                        section("Fluid", "set Density = 1000\n set Region = -2 - y")));
             }),
             contains("'static' seeks an equilibrium of bodies, but the scene has a fluid"));
}
