// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/adaptivity/steadiness.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;


TEST_CASE("What is steady has forces on bodies and obstacles that are", "[coupled]")
{
  CoupledRun<2> run(
    steps_of(0.1) + section("Domain", "set Cells = 4, 4") +
    section("Fluid",
            "set Density = 1\nset Initial velocity = 1; 0\n" +
              section("Boundaries", boundary("around", "left, right, bottom, top", "periodic"))));
  Steadiness<2> steadiness(run.models, 0.01, 0.5);
  const auto    with = [](const double drag, const double lift) {
    return Columns{{"pressure force flag x", "N", drag},
                   {"viscous force flag y", "N", lift},
                   {"Pressure force on floor, x", "N", 1e3 * drag},
                   {"flag moment", "N m", 1e3 * lift}};
  };
  CHECK(!steadiness.observe(run.state, with(1., 0.), 0.));
  // 2 % off: the time begins anew.
  CHECK(!steadiness.observe(run.state, with(1.02, 0.), 0.5));
  CHECK(!steadiness.observe(run.state, with(1.02, 0.02), 1.));
  CHECK(!steadiness.observe(run.state, with(1.02, 0.015), 1.4));
  const auto change = steadiness.observe(run.state, with(1.02, 0.015), 1.5);
  REQUIRE(change);
  CHECK(*change == Approx(0.005 / 1.02).epsilon(1e-3));
}
