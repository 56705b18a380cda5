// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/fluid_side.h>
#include <undine/interface/body_forces.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
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
           section("Fluid",
                   fmt::format("set Density = {}\nset Initial velocity = {}\n", density, velocity) +
                     section("Boundaries",
                             boundary("all",
                                      every_side<dim>(),
                                      "inflow",
                                      "set Velocity = " + velocity)));
  }


  std::string
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
      const auto square =
        "((x-" + number(centre[0]) + ")^2+(y-" + number(centre[1]) + ")^2)";
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
        for_each_value(run.state.fluid.velocity[axis],
                       [&](const double value, const auto &place, const auto &) {
                         if ((place - centre).norm() < radius)
                           return;
                         const double error =
                           std::abs(value - exact(place, axis)) / (speed * radius);
                         largest = std::max(largest, error);
                         sum += error * error;
                         n += 1;
                       });
      return {largest, std::sqrt(sum / n)};
    }

    static constexpr double speed = 1e-4;
    const dealii::Point<2>  centre;
    ObstacleRun<2>          run;
  };


  double
  order(const double coarse, const double fine)
  {
    return std::log2(coarse / fine);
  }
} // namespace


TEST_CASE("Friction leaves a linear flow alone that bodies move along with", "[friction][mpi]")
{
  // A shear flow along s, v = s (n.x), past a body that is sheared alike.
  for (const double angle : {0., .3, .9, 2.})
    for (const char *shape :
         {"ball\nset Centre = .47, .52\nset Radius = .23",
          "box\nset Centre = .52, .49\nset Size = .4, .03\nset Rotation = 33\nset Cells = 7, 1",
          "box\nset Lower corner = .25, .375\nset Upper corner = .5, .625"})
      {
        INFO(shape << ", " << angle);
        const double c = std::cos(angle), s = std::sin(angle);
        const auto   shear  = "(" + number(-s) + "*x+" + number(c) + "*y)";
        const auto   linear = number(c) + "*" + shear + ";" + number(s) + "*" + shear;
        const auto   moving = "t*" + number(c) + "*" + shear + ";t*" + number(s) + "*" + shear;
        const std::string text = shape;
        ObstacleRun<2>    run(given_on_all_sides<2>(16, 3, linear),
                           section("body",
                                   "set Shape = " + text + "\nset Displacement = " + moving),
                           viscosity(10),
                           .01);
        run.step();
        const double error =
          largest_on_faces(run.state.fluid.velocity, [&](const double v, const auto &x, const int i) {
            return std::abs(v - (i == 0 ? c : s) * (-s * x[0] + c * x[1]));
          });
        CHECK(error <= 1e-8);
      }
}


TEST_CASE("The flow around a turning disc converges with second order", "[friction]")
{
  double coarse = 0, fine = 0, largest = 0;
  for (const double shift : {0., .013, .027})
    {
      const auto on_coarse = TurningDisc(20, shift).errors(), on_fine = TurningDisc(40, shift).errors();
      UNSCOPED_INFO(on_coarse.first << " " << on_fine.first << ", " << on_coarse.second << " "
                                    << on_fine.second);
      coarse += on_coarse.second;
      fine += on_fine.second;
      largest = std::max(largest, on_fine.first);
    }
  CHECK(order(coarse, fine) >= 1.6);
  CHECK(largest <= .02);
  CHECK(false);
}
