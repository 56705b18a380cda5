// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/bodies/chamber_volume.h>

using namespace undine_tests;

namespace
{
  constexpr double inner = .3, outer = .36, youngs_modulus = 3e5, poissons_ratio = .499;

  /// Half a tube of rubber stands on the floor, where its rims slide, so that it stays half a tube.
  /// Water flows in through the floor for a second.
  std::string
  half_tube()
  {
    const auto radius = fmt::format("({} + {}*y)", inner, outer - inner);
    return steps_of(1. / 20) +
           section("Domain",
                   "set Lower corner = -.8, 0\nset Upper corner = .8, .8\nset Cells = 32, 16") +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries",
                             boundary("in",
                                      "bottom",
                                      "inflow",
                                      "set Region = .2 - abs(x)\n"
                                      "set Velocity = 0; if(t < 1, .4*sin(pi*t)^2, 0)") +
                               boundary("out", "top", "outflow"))) +
           section("Bodies",
                   body("tube",
                        fmt::format("set Cells = 32, 1\nset Map = -{0}*cos(pi*x); "
                                    "if(abs(x - .5) > .4999, 0, {0}*sin(pi*x))\n"
                                    "set Material = nearly incompressible rubber\n"
                                    "set Density = 1100\nset Young's modulus = {1}\n"
                                    "set Poisson's ratio = {2}",
                                    radius,
                                    youngs_modulus,
                                    poissons_ratio),
                        clamp("rims", "1", "set Sides = left, right\nset Components = y"))) +
           section("Effects",
                   convection() + section("damping", "set Stiffness coefficient = 5e-3")) +
           section("Time", "set Integrator = theta") +
           section("Coupling", "set Boundary flux = swept");
  }


  /// Of an incompressible neo-Hookean tube that now holds half of pi a^2, in plane strain [Pa]:
  ///
  ///     p = mu [ln s - 1 / (2 s^2)] from s = b/B to a/A.
  double
  exact_pressure(const double half_volume)
  {
    const double modulus = youngs_modulus / (2 * (1 + poissons_ratio));
    const double a       = std::sqrt(2 * half_volume / M_PI);
    const double b       = std::sqrt(a * a + outer * outer - inner * inner);
    const auto   part    = [](const double s) { return std::log(s) - 1 / (2 * s * s); };
    return modulus * (part(a / inner) - part(b / outer));
  }
} // namespace


TEST_CASE("A balloon holds what has flown in, at its exact pressure", "[coupled][mpi]")
{
  CoupledRun<2>    run(half_tube());
  ChamberRecord<2> record(run, dealii::Point<2>(0, .1));
  unsigned int     corrections = 0;
  for (unsigned int n = 0; n < 40; ++n)
    {
      run.step();
      corrections += run.report.newton_iterations;
      record.note_step();
      if (n % 4 == 0)
        CHECK(std::abs(record.error()) <= 1e-10);
    }
  CHECK(record.inflow > .5 * record.first);
  CHECK(corrections < 40 * 6.5); // 7.8 each if the tangent does not know how the tube turns
  const auto  &grid     = run.models.fluid->grid();
  const double exact    = exact_pressure(record.first + record.inflow);
  const auto   middle   = grid.cell_at(dealii::Point<2>(0, .1));
  double       pressure = 0;
  if (grid.cells()->owned().contains(middle))
    pressure = run.state.fluid.pressure(middle);
  pressure = dealii::Utilities::MPI::sum(pressure, MPI_COMM_WORLD);
  CHECK(pressure == Approx(exact).epsilon(.005));
}
