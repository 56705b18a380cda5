// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_viscous_flows_h
#define undine_tests_viscous_flows_h

#include <coupled/obstacle_run.h>

#include <cmath>
#include <string>
#include <utility>

namespace undine_tests
{
  /// A unit box, on all sides of which the velocity is given.
  template <int dim>
  std::string
  given_on_all_sides(const unsigned int n, const double density, const std::string &velocity)
  {
    std::string cells;
    for (unsigned int d = 0; d < dim; ++d)
      cells += (d == 0 ? "" : ", ") + std::to_string(n);
    return section("Domain", "set Cells = " + cells) +
           section(
             "Fluid",
             fmt::format("set Density = {}\nset Initial velocity = {}\n", density, velocity) +
               section("Boundaries",
                       boundary("all", every_side<dim>(), "inflow", "set Velocity = " + velocity)));
  }


  inline std::string
  number(const double value)
  {
    return fmt::format("({:.17g})", value);
  }


  /// A disc of radius .2 that turns at 1 rad/s, as far as friction sees, in the flow that it drags
  /// along in an infinite fluid: v = r^2 w / |x|^2, without pressure.
  struct TurningDisc
  {
    static constexpr double radius = .2, viscosity = 50;

    TurningDisc(const unsigned int n, const double shift)
      : centre(.5 + shift, .5 + .7 * shift)
      , run(fluid(n),
            obstacle("disc",
                     "ball",
                     fmt::format("set Centre = {:.17g}, {:.17g}\nset Radius = {}\nset Refinements "
                                 "= 8\nset Displacement = {}",
                                 centre[0],
                                 centre[1],
                                 radius,
                                 turning(number(speed) + "*t"))),
            undine_tests::viscosity(viscosity),
            1)
    {
      for (unsigned int k = 0; k < 3; ++k)
        run.step();
    }

    std::string
    turning(const std::string &factor) const
    {
      const auto x = "(x-" + number(centre[0]) + ")", y = "(y-" + number(centre[1]) + ")";
      return "-" + factor + "*" + y + ";" + factor + "*" + x;
    }

    std::string
    fluid(const unsigned int n) const
    {
      const auto square = "((x-" + number(centre[0]) + ")^2+(y-" + number(centre[1]) + ")^2)";
      return given_on_all_sides<2>(
        n, 1, turning(number(speed * radius * radius) + "/max(1e-3," + square + ")"));
    }

    double
    exact(const dealii::Point<2> &place, const unsigned int axis) const
    {
      const auto arm = place - centre;
      return (axis == 0 ? -arm[1] : arm[0]) * speed * radius * radius / arm.norm_square();
    }

    /// Largest and root mean square error of the velocity, relative to that of the rim.
    std::pair<double, double>
    errors() const
    {
      double largest = 0, sum = 0, n = 0;
      for (unsigned int axis = 0; axis < 2; ++axis)
        for_each_value(
          run.state.fluid.velocity[axis], [&](const double value, const auto &place, const auto &) {
            if ((place - centre).norm() < radius)
              return;
            const double error = std::abs(value - exact(place, axis)) / (speed * radius);
            largest            = std::max(largest, error);
            sum += error * error;
            n += 1;
          });
      return {largest, std::sqrt(sum / n)};
    }

    static constexpr double speed = 5e-8;
    const dealii::Point<2>  centre;
    ObstacleRun<2>          run;
  };


  /// Between two long boxes, tilted and not in line with the grid; the velocity at both ends is
  /// given.
  struct TiltedChannel
  {
    static constexpr double angle = .35, width = .4, fastest = 1e-3, viscosity = 20;

    struct Errors
    {
      double velocity; ///< largest, of the fastest
      double force;    ///< of the plates' friction in the middle
    };

    explicit TiltedChannel(const unsigned int n)
      : run(fluid(n),
            plate("lower", -1) + plate("upper", 1),
            undine_tests::viscosity(viscosity),
            .005)
    {
      for (unsigned int k = 0; k < 50; ++k)
        run.step();
    }

    static std::string
    plate(const std::string &name, const int side)
    {
      const double away = side * (width / 2 + .5);
      return obstacle(name,
                      "box",
                      fmt::format("set Centre = {:.17g}, {:.17g}\nset Size = 4, 1\nset Rotation = "
                                  "{:.17g}\nset Cells = 8, 1",
                                  .5 - away * std::sin(angle),
                                  .5 + away * std::cos(angle),
                                  angle * 180 / M_PI));
    }

    static std::string
    fluid(const unsigned int n)
    {
      const auto across =
        fmt::format("(-{:.17g}*(x-.5)+{:.17g}*(y-.5))", std::sin(angle), std::cos(angle));
      const auto speed = fmt::format("max(0,{:.17g}*(1-({}/{})^2))", fastest, across, width / 2);
      const auto velocity =
        fmt::format("{:.17g}*{};{:.17g}*{}", std::cos(angle), speed, std::sin(angle), speed);
      return section("Domain", fmt::format("set Cells = {}, {}", n, n)) +
             section(
               "Fluid",
               "set Density = 1\nset Initial velocity = " + velocity + "\n" +
                 section("Boundaries",
                         boundary("ends", "left, right", "inflow", "set Velocity = " + velocity)));
    }

    static double
    gradient()
    {
      return 8 * viscosity * fastest / (width * width);
    }

    Errors
    errors() const
    {
      Errors     result{0, 0};
      const auto arm = [](const dealii::Point<2> &x) {
        return dealii::Tensor<1, 2>(
          {std::cos(angle) * (x[0] - .5) + std::sin(angle) * (x[1] - .5),
           -std::sin(angle) * (x[0] - .5) + std::cos(angle) * (x[1] - .5)});
      };
      for (unsigned int axis = 0; axis < 2; ++axis)
        for_each_value(run.state.fluid.velocity[axis],
                       [&](const double value, const dealii::Point<2> &place, const auto &) {
                         const double s = arm(place)[0], n = arm(place)[1];
                         if (std::abs(s) > .25 || std::abs(n) > width / 2)
                           return;
                         const double speed = fastest * (1 - std::pow(2 * n / width, 2));
                         const double exact =
                           speed * (axis == 0 ? std::cos(angle) : std::sin(angle));
                         result.velocity =
                           std::max(result.velocity, std::abs(value - exact) / fastest);
                       });
      const auto friction =
        run.column_vector("viscous force lower") + run.column_vector("viscous force upper");
      // Friction holds the drop of pressure along the channel.
      const double length = 1 / std::cos(angle);
      const double along  = std::cos(angle) * friction[0] + std::sin(angle) * friction[1];
      result.force        = std::abs(along / (gradient() * length * width) - 1);
      return result;
    }

    ObstacleRun<2> run;
  };
} // namespace undine_tests

#endif
