// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/boundary_quantities.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

using namespace undine_tests;

TEST_CASE("sides without a boundary are slip walls", "[boundaries]")
{
  const auto model =
    make_model<2>(FluidText{"4, 4", boundary("in", "left", "inflow", "set Velocity = 1; 0")});
  CHECK(model.boundaries().at({0, 0}, {{0, 2}}).name == "in");
  CHECK(model.boundaries().at({1, 1}, {{2, 3}}).kind == BoundaryKind::slip_wall);
  CHECK(model.boundaries().all().size() == 2);
  CHECK(model.boundaries().wall_that_needs_viscosity().empty());
}


TEST_CASE("regions select faces by their centre and later sections override", "[boundaries]")
{
  const auto model = make_model<2>(
    FluidText{"4, 4",
              boundary("wall", "left, top", "no-slip wall") +
                boundary("jet", "left", "inflow", "set Velocity = 2; 0\nset Region = y-0.5")});
  CHECK(model.boundaries().at({0, 0}, {{0, 1}}).name == "wall");
  CHECK(model.boundaries().at({0, 0}, {{0, 2}}).name == "jet");
  CHECK(model.boundaries().at({0, 0}, dealii::Point<2>(0, 0.9)).name == "jet");
  CHECK(model.boundaries().at({1, 1}, {{1, 3}}).name == "wall");
  CHECK(model.boundaries().wall_that_needs_viscosity() == "wall");
  CHECK_FALSE(model.boundaries().has_opening());

  auto velocity = model.initial_state().velocity;
  set_boundary_velocity(velocity, model.boundaries(), 0);
  CHECK(velocity[0](GridIndex<2>{{0, 1}}) == 0);
  CHECK(velocity[0](GridIndex<2>{{0, 3}}) == 2);
  CHECK(boundary_fluxes(model.boundaries(), velocity)[1] == Approx(-1));
}


TEST_CASE("contradictory boundaries are refused with a hint", "[boundaries]")
{
  const auto why = [](const std::string &boundaries) {
    return message_of([&] { make_model<2>(FluidText{"4, 4", boundaries}); });
  };
  const auto contains = [](const std::string &part) { return Catch::Matchers::Contains(part); };
  CHECK_THAT(why(boundary("a", "left", "periodic")),
             contains("opposite 'right' is not") && contains("Boundaries/a"));
  CHECK_THAT(why(boundary("a", "left, right", "periodic") + boundary("b", "left", "outflow")),
             contains("periodic by another section"));
  CHECK_THAT(why(boundary("a", "front", "outflow")), contains("left | right | bottom | top"));
  CHECK_THAT(why(boundary("a", "left", "wall")), contains("no-slip wall"));
  CHECK_THAT(why(boundary("a", "left", "inflow")), contains("'Velocity'") && contains("inflow"));
  CHECK_THAT(why(boundary("a", "left", "pressure")), contains("'Pressure'"));
  CHECK_THAT(why(boundary("a", "left", "slip wall", "set Velocity = 1; 0")),
             contains("is not used by a boundary of the kind 'slip wall'"));
  CHECK_THAT(why(boundary("a", "left", "outflow") + boundary("b", "left", "no-slip wall")),
             contains("no face of the grid") && contains("Boundaries/a"));
  CHECK_THAT(why(boundary("a", "left", "outflow", "set Region = x - 7")),
             contains("no face of the grid") && contains("'Region'"));
  CHECK_THAT(why(section("a", "set Kind = outflow")), contains("'Sides'"));
  CHECK_THAT(message_of([] { make_model<2>(section("Domain", "set Cells = 4, 4")); }),
             contains("'Density'") && contains("must be given"));
}


TEST_CASE("boundary points hold, bring in or continue a value", "[boundaries][mpi]")
{
  const auto model =
    make_model<2>(FluidText{"6, 6",
                            boundary("floor", "bottom", "no-slip wall") +
                              boundary("lid", "top", "moving wall", "set Velocity = 3*x; 5") +
                              boundary("out", "right", "outflow"),
                            "1; 1"});
  auto velocity = model.initial_state().velocity;
  for (auto &component : velocity.components)
    component.exchange(2);
  for (unsigned int axis = 0; axis < 2; ++axis)
    fill_boundary_points(
      velocity[axis], model.boundaries(), VelocityCondition<2>(axis), velocity, 0.);
  const auto &u = velocity[0];
  const auto &v = velocity[1];
  for_each(u.stored(), [&](const GridIndex<2> &index) {
    if (index[1] == -1)
      REQUIRE(u(index) == 0);
    if (index[1] == 6)
      REQUIRE(u(index) == Approx(3 * index[0] / 6.).margin(1e-15));
  });
  for_each(v.stored(), [&](const GridIndex<2> &index) {
    if (index[0] == -1 || index[0] == 6)
      REQUIRE(v(index) == 1);
  });

  // What comes in through the opening comes in at right angles.
  for_each(velocity[0].stored(), [&](const GridIndex<2> &index) { velocity[0](index) = -1; });
  fill_boundary_points(velocity[1], model.boundaries(), VelocityCondition<2>(1), velocity, 0.);
  for_each(v.stored(), [&](const GridIndex<2> &index) {
    if (index[0] == 6)
      REQUIRE(v(index) == 0);
    if (index[0] == -1)
      REQUIRE(v(index) == 1);
  });
}
