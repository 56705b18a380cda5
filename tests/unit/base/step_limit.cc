// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/clock.h>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace undine;


namespace
{
  /// What steps of a length of 1 become that are cut to the longest of 1, 1/2, 1/4 ... that works.
  struct Steps
  {
    StepLimit    limit;
    unsigned int cut = 0, made = 0;

    void
    make(const double works)
    {
      double dt = std::min(1., limit.longest);
      ++made;
      if (dt <= works)
        return limit.accept(dt);
      ++cut;
      while (dt > works)
        dt /= 2;
      limit.accept_cut(dt);
    }
  };
} // namespace


TEST_CASE("A step that is cut once costs one short step more", "[base]")
{
  Steps steps;
  for (unsigned int incident = 0; incident < 5; ++incident)
    {
      steps.make(.5);
      CHECK(steps.limit.longest == .5);
      steps.make(.5);
      for (unsigned int n = 0; n < 10; ++n)
        {
          CHECK(steps.limit.longest >= 1);
          steps.make(1);
        }
      CHECK(steps.cut == incident + 1);
    }
}


TEST_CASE("Lengths that keep failing are tried ever less often", "[base]")
{
  Steps steps;
  for (unsigned int n = 0; n < 1000; ++n)
    steps.make(.25);
  CHECK(steps.cut <= 35);

  // and the length asked for comes back
  for (unsigned int n = 0; n < 150; ++n)
    steps.make(1);
  CHECK(steps.cut <= 35);
  CHECK(steps.limit.longest > 1);
  CHECK(steps.limit.patience == 1);
}
