// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_point.h>

#include <coupled/coupled_run.h>

#include <array>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// Displacement and velocity of a point of the body, and the force of the pressure on it.
  using Instant = std::array<double, 3>;
  using Series  = std::vector<Instant>;


  /// At `n_times` equidistant times of `duration` [s].
  template <int dim>
  Series
  series(const std::function<std::string(double)> &scene,
         const dealii::Point<dim>                 &point,
         const double                              duration,
         const unsigned int                        n_times,
         const unsigned int                        steps_between)
  {
    CoupledRun<dim> run(scene(duration / (n_times * steps_between)));
    SolidPoint<dim> place(*run.models.solid, "body", point);
    Series          result;
    for (unsigned int n = 1; n <= n_times * steps_between; ++n)
      {
        run.step();
        if (n % steps_between == 0)
          result.push_back({{place.value(run.state.solid.displacement)[0],
                             place.value(run.state.solid.velocity)[0],
                             run.column("pressure force body x")}});
      }
    return result;
  }


  /// Of each quantity, by how much the series differ (root of the mean of squares).
  Instant
  difference(const Series &a, const Series &b)
  {
    Instant sums{};
    for (std::size_t n = 0; n < a.size(); ++n)
      for (unsigned int k = 0; k < sums.size(); ++k)
        sums[k] += (a[n][k] - b[n][k]) * (a[n][k] - b[n][k]);
    for (double &sum : sums)
      sum = std::sqrt(sum / a.size());
    return sums;
  }


  /// From three series, the second with half, the third with a quarter of the first one's steps.
  template <int dim>
  void
  check_order(const std::function<std::string(double)> &scene,
              const dealii::Point<dim>                 &point,
              const double                              duration,
              const unsigned int                        n_times,
              const unsigned int                        steps_between,
              const double                              order)
  {
    std::array<Series, 3> all;
    for (unsigned int k = 0; k < 3; ++k)
      all[k] = series<dim>(scene, point, duration, n_times, steps_between << k);
    const auto coarse = difference(all[0], all[1]), fine = difference(all[1], all[2]);
    for (unsigned int k = 0; k < 3; ++k)
      {
        INFO(fmt::format("{}D, {}: {:.3e} {:.3e}",
                         dim,
                         std::array<const char *, 3>{{"displacement", "velocity", "pressure"}}[k],
                         coarse[k],
                         fine[k]));
        CHECK(std::log2(coarse[k] / fine[k]) >= order);
      }
  }


  /// An elastic bar reaches into a channel from outside, is moved at its end and pushes the water
  /// with its other one, which goes through `amplitude` [m].
  template <int dim>
  std::string
  driven_bar(const double dt, const double amplitude, const std::string &cells)
  {
    return steps_of(dt) + section("Time", "set Integrator = trapezoid_bdf2") +
           section(
             "Domain",
             plane_or_space<dim>("set Upper corner = 1, .25", "set Upper corner = 1, .25, .25") +
               "\nset Cells = " + cells) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries", boundary("out", "right", "outflow"))) +
           section(
             "Bodies",
             body(
               "body",
               plane_or_space<dim>("set Lower corner = -.2, 0\nset Upper corner = .515, .25\nset "
                                   "Cells = 8, 1",
                                   "set Lower corner = -.2, 0, 0\nset Upper corner = .515, .25, "
                                   ".25\nset Cells = 4, 1, 1") +
                 "\nset Density = 100\nset Young's modulus = 2e4\nset Poisson's ratio = 0\n"
                 "set Material = linear elastic",
               section("hand",
                       "set Sides = left\nset Kind = prescribed motion\nset Displacement = " +
                         fmt::format("{}*(1-cos(9*t))^2", amplitude / 4) +
                         plane_or_space<dim>("; 0", "; 0; 0")) +
                 clamp("guides",
                       "1",
                       plane_or_space<dim>("set Components = y", "set Components = y, z")))) +
           section("Effects", convection()) +
           section("Solid numerics", "set Element degree = 1\nset Newton tolerance = 1e-12");
  }


  /// A bar that is held at the wall and pushes water out of a channel. A force on it that grows
  /// smoothly sets it in motion, through nearly four cells, and nothing prescribes how it moves.
  std::string
  pushed_bar(const double dt)
  {
    return steps_of(dt) + section("Time", "set Integrator = trapezoid_bdf2") +
           section("Domain", "set Upper corner = 1, .25\nset Cells = 32, 8") +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries", boundary("out", "right", "outflow"))) +
           section("Bodies",
                   body("body",
                        "set Upper corner = .5, .25\nset Cells = 32, 1\nset Density = 100\n"
                        "set Young's modulus = 2e4\nset Poisson's ratio = 0\n"
                        "set Material = linear elastic",
                        clamp("wall", ".001-x") + clamp("guides", "1", "set Components = y"))) +
           section("Effects",
                   convection() +
                     section("body force",
                             section("Bodies",
                                     section("body", "set Acceleration = 30*(1-cos(8*t))^2; 0")))) +
           section("Solid numerics", "set Element degree = 1\nset Newton tolerance = 1e-12");
  }


  /// A sheet that stands in a stream which grows smoothly.
  std::string
  sheet_in_stream(const double dt)
  {
    return steps_of(dt) + section("Time", "set Integrator = trapezoid_bdf2") +
           section("Domain", "set Upper corner = 3, 1\nset Cells = 48, 16") +
           section(
             "Fluid",
             "set Density = 1000\n" +
               section("Boundaries",
                       boundary("in", "left", "inflow", "set Velocity = .15*sin(pi*t/2)^4; 0") +
                         boundary("out", "right", "outflow"))) +
           section(
             "Bodies",
             body("body",
                  "set Lower corner = 1.01, -.1\nset Upper corner = 1.11, .43\nset Cells = 2, "
                  "8\nset Density = 1100\nset Young's modulus = 4e5\nset Poisson's ratio = .3",
                  clamp("foot", "-y"))) +
           section("Effects", convection()) +
           section("Solid numerics", "set Newton tolerance = 1e-12");
  }
} // namespace


TEST_CASE("TR-BDF2 is of second order in displacement, velocity and pressure", "[coupled]")
{
  SECTION("a bar goes through three cells, which changes what is cut")
  {
    check_order<2>(
      [](const double dt) { return driven_bar<2>(dt, .06, "32, 8"); }, {.5, .125}, .6, 15, 4, 1.8);
  }
  SECTION("a bar that moves freely, through four cells")
  {
    check_order<2>(pushed_bar, {.5, .125}, .75, 15, 4, 1.9);
  }
  SECTION("a bar in 3D that stays in its cells")
  {
    check_order<3>([](const double dt) { return driven_bar<3>(dt, .01, "16, 4, 4"); },
                   {.5, .125, .125},
                   .4,
                   10,
                   4,
                   1.8);
  }
  SECTION("a sheet in a smooth stream")
  {
    check_order<2>(sheet_in_stream, {1.06, .43}, .6, 15, 1, 1.8);
  }
}
