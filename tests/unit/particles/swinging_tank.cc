// SPDX-License-Identifier: LGPL-2.1-or-later
// Water that swings in a tank: momentum and period of linear theory, and how long it goes on.
#include "executors.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <vector>

using namespace particle_tests;

namespace
{
  constexpr double depth = .25, width = .5, g = 9.81, tilt = .05;

  /// Gravity is tilted at the start: its part along x drives all odd modes of the level surface.
  struct LinearTheory
  {
    static double
    wave_number(const int mode)
    {
      return mode * M_PI / width;
    }

    static double
    frequency(const int mode)
    {
      const double k = wave_number(mode);
      return std::sqrt(g * k * std::tanh(k * depth));
    }

    static double
    period()
    {
      return 2 * M_PI / frequency(1);
    }

    /// Along x [kg m/s].
    static double
    momentum(const double time)
    {
      double sum = 0;
      for (int mode = 1; mode < 40; mode += 2)
        sum += frequency(mode) / std::pow(mode, 4) * std::sin(frequency(mode) * time);
      return 1000 * tilt * 8 * std::pow(width, 3) / std::pow(M_PI, 4) * sum;
    }
  };


  ParticleScene<2>
  tilted_tank(const int layers)
  {
    ParticleScene<2> scene(depth / layers);
    scene.setup.gravity = along<2>(1, -g) + along<2>(0, tilt * g);
    scene.setup.depth   = depth;

    scene.setup.numerics.position_update = PositionUpdate::mean_velocity;
    scene.add_tank({2 * layers, 3 * layers / 2}, layers);
    scene.for_each_point({0, 0}, {2 * layers, layers}, [&](const Point<2> &x) {
      scene.add(x, Kind::fluid, 0, Point<2>::zero());
    });
    return scene;
  }


  /// The largest momentum along x of each half period, over that of linear theory; `momentum_after`
  /// a frame of some length.
  std::vector<double>
  peaks(const int half_periods, const std::function<double(double)> &momentum_after)
  {
    std::vector<double> result;
    constexpr int       rows = 40;
    double              most = 0;
    for (int row = 0; row <= rows; ++row)
      most = std::max(most, LinearTheory::momentum(row * LinearTheory::period() / (2 * rows)));
    for (int half = 0; half < half_periods; ++half)
      {
        double peak = 0;
        for (int row = 0; row < rows; ++row)
          peak = std::max(peak, std::abs(momentum_after(LinearTheory::period() / (2 * rows))));
        result.push_back(peak / most);
      }
    return result;
  }
} // namespace


TEST_CASE("Water that swings in a tank has the momentum of linear theory and goes on",
          "[particles]")
{
  const auto engine = tilted_tank(25).engine();
  const auto found  = peaks(3, [&](const double frame) {
    engine->advance(frame);
    return engine->balance().momentum[0];
  });
  INFO("peaks " << found[0] << ", " << found[1] << ", " << found[2]);
  CHECK(found[0] == Approx(1).epsilon(.03));
  CHECK(found[1] == Approx(1).epsilon(.05));
  CHECK(found[2] == Approx(1).epsilon(.05));
}
