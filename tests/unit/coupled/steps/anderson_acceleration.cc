// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/anderson_acceleration.h>

#include <catch2/catch.hpp>

using namespace undine;

using Positions = std::vector<dealii::Point<2>>;

namespace
{
  const Positions fixed{{1, 2}, {-3, 0.5}, {0, 0}, {7, -1}};

  /// A map with this fixed point that multiplies the distance of each node from it by a factor.
  Positions
  map(const Positions &x, const std::vector<double> &factors)
  {
    auto result = fixed;
    for (std::size_t node = 0; node < x.size(); ++node)
      result[node] += factors[node] * (x[node] - fixed[node]);
    return result;
  }

  double
  distance(const Positions &x)
  {
    double result = 0;
    for (std::size_t node = 0; node < x.size(); ++node)
      result = std::max(result, x[node].distance(fixed[node]));
    return result;
  }
} // namespace


TEST_CASE(
  "Anderson's acceleration finds the fixed point of a linear map in as many steps as it has "
  "eigenvalues, and one, wherever it leads",
  "[coupled]")
{
  struct Case
  {
    std::vector<double> factors;
    unsigned int        eigenvalues;
  };
  for (const auto &test : std::vector<Case>{{{-1, -1, -1, -1}, 1}, // places that are exchanged
                                            {{0.5, 0.5, 0.5, 0.5}, 1},
                                            {{-1.5, -1.5, 0.2, 0.2}, 2},
                                            {{-1.5, 0.5, -0.5, -0.5}, 3}})
    {
      AndersonAcceleration<2> acceleration;
      Positions               x{{3, 3}, {0, 2}, {0.5, 0.25}, {6, -2}};
      for (unsigned int k = 0; k < test.eigenvalues; ++k)
        {
          x = acceleration.next(x, map(x, test.factors));
          CAPTURE(test.factors, k);
          CHECK(distance(x) > 1e-3);
        }
      x = acceleration.next(x, map(x, test.factors));
      CHECK(distance(x) < 1e-9);
    }
}


TEST_CASE("Anderson's acceleration stays where positions are reached", "[coupled]")
{
  AndersonAcceleration<2> acceleration;
  CHECK(acceleration.next(fixed, fixed) == fixed);
  CHECK(acceleration.next(fixed, fixed) == fixed);
}
