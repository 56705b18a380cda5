// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/surface_placement.h>

#include <catch2/catch.hpp>

using namespace undine;

using Positions = std::vector<dealii::Point<2>>;

namespace
{
  /// Places that are as far from `at` as `by` says, in cells of a metre.
  Positions
  beside(const Positions &at, const double by)
  {
    auto result = at;
    for (auto &place : result)
      place[0] += by;
    return result;
  }
} // namespace


TEST_CASE("Of places that surfaces do not come to, the best is taken in the end", "[coupled]")
{
  const Models<2>     models;
  SurfacePlacement<2> placement(models);
  const Positions     first{{0, 0}, {1, 0}};
  CHECK_FALSE(placement.accepts(first, beside(first, 0.05), {0.05, 0}));
  Positions    at     = placement.next(first, beside(first, 0.05));
  unsigned int rounds = 1;
  for (; at != first; ++rounds) // further off from round to round
    {
      REQUIRE(rounds < 12);
      const double by = 0.1 * rounds;
      CHECK_FALSE(placement.accepts(at, beside(at, by), {by, 0}));
      CHECK_FALSE(placement.is_at_limit());
      at = placement.next(at, beside(at, by));
    }
  CHECK(rounds > 4); // small misplacements are tried for first
  CHECK(placement.is_at_limit());
  CHECK(placement.accepts(at, beside(at, 0.2), {0.2, 0}));
}


TEST_CASE("A place close by is accepted at once", "[coupled]")
{
  const Models<2>     models;
  SurfacePlacement<2> placement(models);
  const Positions     at{{0, 0}};
  CHECK(placement.accepts(at, beside(at, 0.009), {0.009, 0}));
  CHECK_FALSE(placement.is_at_limit());
}


TEST_CASE("From a place without a solution the way back is halved", "[coupled]")
{
  const Models<2>     models;
  SurfacePlacement<2> placement(models);
  CHECK_FALSE(placement.can_retreat()); // there is nothing to go back to
  const Positions first{{0, 0}};
  CHECK_FALSE(placement.accepts(first, beside(first, 0.8), {0.8, 0}));
  CHECK(placement.next(first, beside(first, 0.8)) == beside(first, 0.8));
  CHECK(placement.can_retreat());
  CHECK(placement.retreat() == beside(first, 0.4));
  CHECK(placement.retreat() == beside(first, 0.2));
  for (unsigned int round = 3; round < 12; ++round)
    {
      CHECK(placement.can_retreat());
      placement.retreat();
    }
  CHECK_FALSE(placement.can_retreat());
}
