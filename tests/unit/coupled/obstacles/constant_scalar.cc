// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  /// A constant that also comes in everywhere stays so to rounding in all fluid.
  template <int dim>
  void
  check_constant(const std::string &sides,
                 const std::string &lower,
                 const std::string &upper,
                 const std::string &displacement,
                 const std::string &method,
                 const unsigned int n)
  {
    const auto box = "set Lower corner = " + lower + "\nset Upper corner = " + upper +
                     "\nset Displacement = " + displacement;
    ObstacleRun<dim> run(
      section("Domain", plane_or_space<dim>("set Cells = 16, 16", "set Cells = 7, 8, 6")) +
        section("Fluid", "set Density = 1\n" + section("Boundaries", sides)),
      obstacle("block", "box", box),
      convection() +
        section("scalar transport",
                (method == "flux" ? "set Form = flux\n" : "set Method = " + method + "\n") +
                  section("smoke", "set Initial value = 1.7\nset Inflow value = 1.7")),
      .05);
    for (unsigned int step = 0; step < n; ++step)
      {
        run.step();
        INFO("step " << step + 1 << " of " << displacement << ", " << method);
        REQUIRE(largest_in_cells(
                  run.state.fluid.scalars.at("smoke"),
                  [](const double value, const auto &) { return std::abs(value - 1.7); }) <= 1e-13);
      }
  }
} // namespace


TEST_CASE("Constant scalars stay constant in fluid that bodies uncover", "[coupled][mpi]")
{
  const auto opening = boundary("out", "right", "pressure", "set Pressure = 0");
  const auto outlet  = boundary("out", "right", "outflow");
  const auto stream  = boundary("in", "left", "inflow", "set Velocity = 1; 0") + outlet;
  for (const std::string method : {"cubic", "MacCormack", "semi-Lagrangian", "flux"})
    {
      SECTION("a block lifts off the floor, " + method)
      {
        check_constant<2>(opening, "-.5, -.31", "1.5, .4", "0; .5*t", method, 12);
        check_constant<3>(opening, "-.5, -.31, -1", "1.5, .4, 2", "0; .5*t; 0", method, 12);
      }
      SECTION("a body sweeps past and leaves the domain, " + method)
      {
        check_constant<2>(outlet, "-.5, -.5", "1.5, .3", "0; 1.1*t", method, 12);
        check_constant<2>(stream, ".3, .3", ".6, .5", "1.3*t; .1*t", method, 14);
      }
      SECTION("a piston opens a gap, " + method)
      {
        check_constant<2>(outlet, "-1, -1", ".3, 2", "-.8*t; 0", method, 9);
        check_constant<3>(outlet, "-1, -1, -1", ".3, 2, 2", "-.8*t; 0; 0", method, 9);
        check_constant<2>(outlet, "-1, -1", ".98, 2", "-.8*t; 0", method, 9);
        check_constant<3>(outlet, "-1, -1, -1", ".98, 2, 2", "-1.8*t; 0; 0", method, 9);
      }
    }
}


TEMPLATE_TEST_CASE_SIG("What enters reaches the cells that a body cuts, along paths, too",
                       "[coupled][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const std::string method : {"cubic", "MacCormack", "semi-Lagrangian"})
    {
      INFO(method);
      ObstacleRun<dim> run(
        section("Domain", plane_or_space<dim>("set Cells = 16, 10", "set Cells = 8, 10, 3")) +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries",
                            boundary("in",
                                     "left",
                                     "inflow",
                                     plane_or_space<dim>("set Velocity = 1; 0",
                                                         "set Velocity = 1; 0; 0")) +
                              boundary("out", "right", "outflow"))),
        section("floor",
                plane_or_space<dim>("set Lower corner = -.5, -.5\nset Upper corner = 1.5, .23",
                                    "set Lower corner = -.5, -.5, -1\nset Upper corner = 1.5, "
                                    ".23, 2")),
        convection() + section("scalar transport",
                               "set Method = " + method + "\n" +
                                 section("smoke", "set Initial value = 0\nset Inflow value = 1")),
        .05);
      for (unsigned int n = 0; n < 60; ++n)
        run.step();
      CHECK(largest_in_cells(run.state.fluid.scalars.at("smoke"),
                             [](const double value, const auto &) { return std::abs(value - 1); }) <
            1e-3);
    }
}
