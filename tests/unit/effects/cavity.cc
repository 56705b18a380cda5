// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <effects/flow_run.h>

#include <fstream>
#include <map>

using namespace undine_tests;

namespace
{
  /// Largest and smallest value of the parabolas through three neighbouring samples.
  std::pair<double, double>
  extrema(const std::vector<double> &places, const std::vector<double> &values)
  {
    std::pair<double, double> result{values[0], values[0]};
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      {
        const double a = places[i] - places[i - 1], b = places[i + 1] - places[i];
        const double below     = (values[i] - values[i - 1]) / a,
                     above     = (values[i + 1] - values[i]) / b;
        const double curvature = (above - below) / (a + b);
        const double slope     = (below * b + above * a) / (a + b);
        const double shift     = curvature == 0 ? 0. : -slope / (2 * curvature);
        const bool   inside    = shift >= -a && shift <= b;
        const double value     = values[i] + (inside ? slope * shift / 2 : 0.);
        result.first           = std::min(result.first, value);
        result.second          = std::max(result.second, value);
      }
    return result;
  }


  struct Cavity
  {
    double u_min, v_max, v_min;
  };


  /// The steady flow at Reynolds number `reynolds` with n cells a side and steps of dt.
  Cavity
  cavity(const unsigned int n,
         const std::string &grading,
         const double       dt,
         const double       reynolds,
         const std::string &method)
  {
    FlowRun<2> run(FluidText{fmt::format("{}, {}", n, n),
                             boundary("walls", "left, right, bottom", "no-slip wall") +
                               boundary("lid", "top", "moving wall", "set Velocity = 1; 0"),
                             "",
                             "set Grading x = " + grading + "\nset Grading y = " + grading},
                   convection(method) + viscosity(1 / reynolds));
    double     change = 1;
    while (change > 1e-5 && run.time < 100)
      {
        const auto before = run.state.velocity[0];
        run.step(dt);
        change = largest_over(before.lattice(),
                              [&](const GridIndex<2> &face) {
                                return std::abs(run.state.velocity[0](face) - before(face));
                              }) /
                 dt;
      }
    // n is even: the planes x = 1/2 and y = 1/2 carry u and v.
    std::array<std::vector<double>, 2> places, values;
    for (unsigned int axis = 0; axis < 2; ++axis)
      for (int i = 0; i < int(n); ++i)
        {
          GridIndex<2> face;
          face[axis]     = n / 2;
          face[1 - axis] = i;
          places[axis].push_back(run.state.velocity[axis].lattice().point(face)[1 - axis]);
          values[axis].push_back(run.state.velocity[axis](face));
        }
    const auto u = extrema(places[0], values[0]), v = extrema(places[1], values[1]);
    return {u.first, v.second, v.first};
  }
} // namespace


TEST_CASE("the lid-driven cavity at Reynolds number 100 has the extrema of the spectral solution",
          "[cavity]")
{
  std::map<std::string, double> reference;
  std::ifstream                 file(UNDINE_SOURCE_DIR "/tests/reference/cavity_extrema.csv");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("botella-peyret,100,", 0) == 0)
      {
        const auto entries    = dealii::Utilities::split_string_list(line, ',');
        reference[entries[2]] = std::stod(entries[3]);
      }
  REQUIRE(reference.size() == 3);

  const std::string towards_walls = "x-0.7*sin(2*pi*x)/(2*pi)";
  const auto        result        = cavity(48, towards_walls, 1. / 48, 100, "cubic");
  CHECK(result.u_min == Approx(reference["u_min"]).epsilon(0.01));
  CHECK(result.v_max == Approx(reference["v_max"]).epsilon(0.01));
  CHECK(result.v_min == Approx(reference["v_min"]).epsilon(0.01));

  // Four times the step: the steady flow hardly changes.
  const auto larger = cavity(48, towards_walls, 4. / 48, 100, "cubic");
  CHECK(larger.u_min == Approx(result.u_min).epsilon(0.01));
  CHECK(larger.v_max == Approx(result.v_max).epsilon(0.01));
  CHECK(larger.v_min == Approx(result.v_min).epsilon(0.01));
}
