// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/bodies/chamber_volume.h>

using namespace undine_tests;

namespace
{
  constexpr double dt = 1. / 60;

  /// A fifth of a second of the flow into a chamber.
  double
  speed(const double time)
  {
    return .3 * std::pow(std::sin(M_PI * time), 2);
  }

  const std::string speed_text = ".3*sin(pi*t)^2";


  /// A membrane over the chamber of closed_chamber.prm, whose face at y = .4 lies so many cells
  /// above a plane of the grid.
  template <int dim>
  std::string
  membrane(const double offset)
  {
    const double lower = -offset / std::array<double, 2>{{30, 10}}[dim - 2];
    return steps_of(dt) + budget +
           section("Domain",
                   fmt::format(plane_or_space<dim>("set Lower corner = 0, {0}\nset Upper corner = "
                                                   "1, {1}\nset Cells = 16, 30",
                                                   "set Lower corner = 0, {0}, 0\nset Upper corner "
                                                   "= 1, {1}, 1\nset Cells = 8, 10, 8"),
                               lower,
                               1 + lower)) +
           section("Fluid",
                   "set Density = 1000\n" + section("Boundaries",
                                                    boundary("in",
                                                             "bottom",
                                                             "inflow",
                                                             "set Velocity = 0; " + speed_text +
                                                               plane_or_space<dim>("", "; 0")) +
                                                      boundary("out", "top", "outflow"))) +
           section("Bodies",
                   body("membrane",
                        plane_or_space<dim>("set Lower corner = -.05, .4\nset Upper corner = 1.05, "
                                            ".42\nset Cells = 22, 1",
                                            "set Lower corner = -.05, .4, -.05\nset Upper corner = "
                                            "1.05, .43, 1.05\nset Cells = 6, 1, 6") +
                          "\nset Density = 1100\nset Young's modulus = 1e6\nset Poisson's ratio = "
                          ".4",
                        clamp("rim",
                              "1",
                              plane_or_space<dim>("set Sides = left, right",
                                                  "set Sides = left, right, back, front"))));
  }


  /// A quarter of a tube around the origin that ends on the sides of the domain, and is filled.
  /// Planes lie so many cells inside of its inner face.
  template <int dim>
  std::string
  quarter_tube(const double offset)
  {
    const double size = 15 / (5 + offset);
    return steps_of(dt) + budget +
           section(
             "Domain",
             fmt::format(plane_or_space<dim>("set Upper corner = {0}, {0}\nset Cells = 15, 15",
                                             "set Upper corner = {0}, {0}, .25\n"
                                             "set Cells = 15, 15, 2"),
                         size)) +
           section("Fluid",
                   "set Density = 1\n" +
                     section("Boundaries",
                             boundary("in",
                                      "left",
                                      "inflow",
                                      "set Region = .53 - y\nset Velocity = " + speed_text + "; 0" +
                                        plane_or_space<dim>("", "; 0"))) +
                     section("Void regions",
                             section("air",
                                     fmt::format(plane_or_space<dim>("set Seed = {0}, {0}",
                                                                     "set Seed = {0}, {0}, .1"),
                                                 .99 * size)))) +
           section(
             "Bodies",
             body("tube",
                  plane_or_space<dim>("set Lower corner = 1, 0\nset Upper corner = 1.1, 1\n"
                                      "set Cells = 1, 10\n"
                                      "set Map = x*cos(y*pi/2); x*sin(y*pi/2)",
                                      "set Lower corner = 1, 0, 0\nset Upper corner = 1.1, "
                                      "1, .25\nset Cells = 1, 10, 1\n"
                                      "set Map = x*cos(y*pi/2); x*sin(y*pi/2); z") +
                    "\nset Density = 100\nset Young's modulus = 3e5\nset Poisson's ratio = .4",
                  clamp("y", "1", "set Sides = bottom\nset Components = y") +
                    clamp("x", "1", "set Sides = top\nset Components = x") +
                    plane_or_space<dim>("",
                                        clamp("z",
                                              "1",
                                              "set Sides = back, front\nset Components = "
                                              "z"))));
  }


  template <int dim>
  dealii::Point<dim>
  inside(const double x, const double y)
  {
    dealii::Point<dim> result;
    result[dim - 1] = .11; // in space
    result[0]       = x;
    result[1]       = y;
    return result;
  }


  /// Of the quarter of a disc within the tube's inner face, a polygon with a side for each cell
  /// (nodes between vertices lie on straight lines), so many [m^2], in space times the length of
  /// the tube.
  template <int dim>
  double
  volume_of_tube(const unsigned int sides)
  {
    return sides * std::sin(M_PI / 2 / sides) / 2 * std::array<double, 2>{{1, .25}}[dim - 2];
  }


  /// Flows, volumes and energies of a chamber, by the rule of TR-BDF2 (T9); all bodies begin where
  /// a plane has an influence or none. `exact`: the volume at the start.
  template <int dim>
  void
  fill(const std::string        &scene,
       const dealii::Point<dim> &place,
       const unsigned int        steps,
       const double              exact)
  {
    CoupledRun<dim> run(scene);
    const auto      measure = [&] { return measure_region(run.models, run.state, place); };
    const double    first   = measure().volume;
    CHECK(first == Approx(exact).epsilon(1e-12));
    const double g = (1 - std::sqrt(.5)) * dt, w = std::sqrt(2.) / 4 * dt;
    double       flown = 0, volume = 0, closure = 0;
    for (unsigned int n = 0; n < steps; ++n)
      {
        const double t = n * dt;
        flown += n == 0 ? (dt - g) * speed(g) + g * speed(dt)
                        : w * (speed(t) + speed(t + 2 * g)) + g * speed(t + dt);
        run.step();
        const auto   now  = measure();
        const double area = now.inflow / speed(t + dt);
        volume            = std::max(volume, std::abs(now.volume - first - area * flown) / first);
        closure           = std::max(closure, run.column("energy closure"));
      }
    INFO(fmt::format("{:.2e} {:.2e}", volume, closure));
    CHECK(volume <= 1e-8);
    CHECK(closure <= 1e-7);
  }
} // namespace


TEST_CASE("Chambers hold what has flown in wherever planes lie at their walls", "[coupled]")
{
  for (const double offset : {0., 1e-6, 1e-3, .4})
    {
      INFO(offset);
      fill<2>(membrane<2>(offset), inside<2>(.5, .2), 12, .4 + offset / 30);
    }
  for (const double offset : {0., 1e-3})
    {
      INFO(offset);
      fill<3>(membrane<3>(offset), inside<3>(.5, .2), 5, .4 + offset / 10);
    }
}


TEST_CASE("Quarters of tubes that end on symmetry planes hold what has flown in", "[coupled]")
{
  for (const double offset : {0., 1e-6})
    {
      INFO(offset);
      fill<2>(quarter_tube<2>(offset), inside<2>(.6, .6), 10, volume_of_tube<2>(10));
      fill<3>(quarter_tube<3>(offset), inside<3>(.6, .6), 5, volume_of_tube<3>(10));
    }
}
