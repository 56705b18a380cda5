// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/aitken_relaxation.h>

#include <catch2/catch.hpp>

using namespace undine;

TEST_CASE("Aitken's relaxation finds fixed points between positions that are exchanged",
          "[coupled]")
{
  using Positions = std::vector<dealii::Point<2>>;
  // x = F(x) at (1, 2), from which F leads away on the other side.
  const auto map = [](const Positions &x, const double factor) {
    Positions result;
    for (const auto &point : x)
      result.push_back(dealii::Point<2>(1, 2) + factor * (point - dealii::Point<2>(1, 2)));
    return result;
  };
  for (const double factor : {-1., -1.5, -0.7, 0.5})
    {
      AitkenRelaxation<2> relaxation;
      Positions           x{{3, 3}, {0, 2}};
      for (unsigned int k = 0; k < 2; ++k)
        x = relaxation.next(x, map(x, factor));
      CAPTURE(factor);
      CHECK(x[0].distance({1, 2}) < 1e-12); // a multiple of the identity: exact in two
      CHECK(x[1].distance({1, 2}) < 1e-12);
    }
}


TEST_CASE("Aitken's relaxation stays where positions are reached", "[coupled]")
{
  AitkenRelaxation<3>                 relaxation;
  const std::vector<dealii::Point<3>> x{{1, 2, 3}};
  CHECK(relaxation.next(x, x) == x);
  CHECK(relaxation.next(x, x) == x);
}
