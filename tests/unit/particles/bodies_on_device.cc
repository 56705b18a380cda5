// SPDX-License-Identifier: LGPL-2.1-or-later
#include "executors.h"
#include "state_differences.h"

#include <catch2/catch.hpp>

using namespace particle_tests;

/// Particles of small bodies stay in registers through all their steps, those of large ones do not.
TEMPLATE_TEST_CASE_SIG(
  "A body that swings on the device is where it is on the host, large or small",
  "[particles]",
  ((int dim), dim),
  2,
  3)
{
  if (is_skipped<dim>())
    return;
  const int          half = GENERATE(3, dim == 2 ? 32 : 8);
  ParticleScene<dim> scene(0.02);
  const int          body = scene.add_body(BodySetup());
  scene.for_each_point(cube<dim>(-half), cube<dim>(half), [&](const Point<dim> &x) {
    scene.add(x, Kind::solid, body + 1, along<dim>(0, 0.5 * x[1] / (half * scene.setup.spacing)));
  });
  scene.setup.has_fluid = false;
  scene.set_free_space(1);
  const auto host = engine_on("host", scene), device = engine_on("device", scene);
  const auto start = state_of(*host);
  for (const auto &engine : {host.get(), device.get()})
    CHECK(engine->advance(0.004).elastic_steps_total > 2);
  CHECK(largest_distance(state_of(*host), start) > 0.05 * scene.setup.spacing);
  CHECK(largest_distance(state_of(*host), state_of(*device)) < 1e-4 * scene.setup.spacing);
}
