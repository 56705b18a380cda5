// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A free sheet in a cavity of side 1 with n^dim cells. The lid, normal to y, moves along x.
  struct SheetInCavity
  {
    std::string  integrator;
    double       density; ///< that of the fluid is 1000 kg/m^3
    double       step;    ///< [s]
    unsigned int n         = 24;
    double       viscosity = 10;   ///< [Pa s]
    std::string  lid       = ".1"; ///< [m/s]
    double       tolerance = 3e-3; ///< of friction
  };


  template <int dim>
  CoupledRun<dim>
  start(const SheetInCavity &sheet)
  {
    return CoupledRun<dim>(
      section("Time",
              fmt::format("set Step = {}\nset Integrator = {}", sheet.step, sheet.integrator)) +
      section("Output", "set Budget = true") +
      section("Coupling", fmt::format("set Friction tolerance = {}", sheet.tolerance)) +
      section("Domain",
              fmt::format("set Cells = {0}, {0}{1}",
                          sheet.n,
                          plane_or_space<dim>("", ", " + std::to_string(sheet.n)))) +
      section(
        "Fluid",
        "set Density = 1000\n" +
          section("Boundaries",
                  boundary("lid",
                           "top",
                           "moving wall",
                           "set Velocity = " + sheet.lid + plane_or_space<dim>("; 0", "; 0; 0")) +
                    boundary("walls",
                             plane_or_space<dim>("left, right, bottom",
                                                 "left, right, bottom, front, back"),
                             "no-slip wall"))) +
      section("Bodies",
              body("sheet",
                   fmt::format("set Lower corner = .3, .52{}\nset Upper corner = .7, .55{}\nset "
                               "Cells = {}\nset Density = {}\nset Young's modulus = "
                               "1e4\nset Poisson's ratio = .3",
                               plane_or_space<dim>("", ", .37"),
                               plane_or_space<dim>("", ", .66"),
                               plane_or_space<dim>("12, 1", "4, 1, 3"),
                               sheet.density))) +
      section("Effects", convection() + viscosity(sheet.viscosity)));
  }


  /// How far the sheet has moved along x after .2 s [m].
  double
  drift(const SheetInCavity &sheet)
  {
    auto         run   = start<2>(sheet);
    const double begin = run.column("centre of mass sheet x");
    while (run.state.clock.time < .2 - 1e-9)
      {
        run.step();
        // In the first step from rest energies are so small that the rounding of positions shows.
        CHECK(run.column("energy closure") <= (run.state.clock.step == 1 ? 1e-8 : 2e-9));
        CHECK(run.column("momentum closure") <= 1e-9);
      }
    return run.column("centre of mass sheet x") - begin;
  }


  /// The same for cells without width, the error being of second order in it.
  double
  extrapolated_drift(SheetInCavity sheet, const unsigned int coarse, const unsigned int fine)
  {
    sheet.n                = coarse;
    const double on_coarse = drift(sheet);
    sheet.n                = fine;
    const double on_fine   = drift(sheet);
    const double ratio     = std::pow(double(fine) / coarse, 2);
    return (ratio * on_fine - on_coarse) / (ratio - 1);
  }


  /// A lid whose stress does not depend on the viscosity, and that starts smoothly.
  SheetInCavity
  gently_dragged(const double density, const double viscosity, const double step)
  {
    return {"trapezoid_bdf2",
            density,
            step,
            24,
            viscosity,
            fmt::format("{:.17g}*(1-exp(-20*t))", 1 / viscosity)};
  }


  /// Over the speed of the lid, the largest of a sheet in so many steps, and the last one; the most
  /// linear iterations of a step.
  struct Speeds
  {
    double       largest = 0, last = 0;
    unsigned int iterations = 0;
  };

  template <int dim>
  Speeds
  speeds(const SheetInCavity &sheet, const unsigned int n_steps)
  {
    auto   run = start<dim>(sheet);
    Speeds result;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        result.last       = run.column("max speed sheet") * sheet.viscosity;
        result.largest    = std::max(result.largest, result.last);
        result.iterations = std::max<unsigned int>(result.iterations, run.report.linear_iterations);
        CHECK(run.column("momentum closure") <= 1e-10);
      }
    return result;
  }
} // namespace


TEST_CASE("Friction drags sheets along with the fluid, also light ones", "[friction]")
{
  // Against the lid, with what flows back below it. Extrapolated from up to 96^2 cells and from
  // steps down to .001 s: both within 1 %. A light sheet follows the fluid sooner, and shorter
  // steps are needed to resolve how it starts.
  for (const char *integrator : {"theta", "trapezoid_bdf2"})
    CHECK(extrapolated_drift({integrator, 1000, .01}, 24, 48) == Approx(-6.13e-4).epsilon(.02));
  CHECK(extrapolated_drift({"trapezoid_bdf2", 10, .0025}, 24, 36) == Approx(-7.89e-4).epsilon(.03));
}


TEST_CASE("Friction does not shake sheets, not even light ones in long steps", "[friction]")
{
  for (const char *integrator : {"theta", "trapezoid_bdf2"})
    {
      INFO(integrator);
      auto run = start<2>({integrator, 10, .01});
      for (unsigned int n = 0; n < 20; ++n)
        {
          run.step();
          CHECK(run.column("max speed sheet") <= .025); // a quarter of the lid's
          CHECK(run.column("energy closure") <= 1e-9);
          CHECK(run.column("momentum closure") <= 1e-9);
        }
    }
}


TEST_CASE("Friction holds sheets of any lightness in steps of any length", "[friction]")
{
  // h nu of 1e-4, 1e-2 and 1 of the square of the cavity's side. Where friction crosses the cavity
  // within a few steps, the density of a sheet, at most that of the fluid, does not matter.
  for (const double viscosity : {10., 1e3, 1e5})
    {
      const auto heavy = speeds<2>(gently_dragged(1e3, viscosity, .01), 20);
      for (const double density : {10., .1})
        {
          const auto light = speeds<2>(gently_dragged(density, viscosity, .01), 20);
          INFO(viscosity << " Pa s, " << density << " kg/m^3: " << light.largest << " "
                         << light.last << ", " << heavy.last);
          CHECK(light.largest <= 1);
          if (viscosity > 100)
            CHECK(light.last == Approx(heavy.last).epsilon(.1));
        }
    }
}


TEST_CASE("Friction holds light sheets in space", "[friction]")
{
  const auto after = [](const double density) {
    auto sheet = gently_dragged(density, 1e4, .01);
    sheet.n    = 8;
    return speeds<3>(sheet, 10);
  };
  const auto heavy = after(1e3), light = after(.1);
  INFO(light.largest << " " << light.last << ", " << heavy.largest << " " << heavy.last);
  CHECK(light.largest <= 2);
  CHECK(light.last == Approx(heavy.last).epsilon(.2));
  // Four solves; by a damping of each node by itself it would take 4500.
  CHECK(light.iterations <= 800);
}


TEST_CASE("Light sheets in a viscous fluid move to second order in time", "[friction]")
{
  // Each stage solved once, and each once more.
  for (const double tolerance : {1e9, 0.})
    {
      const auto after = [&](const double step) {
        auto sheet      = gently_dragged(.1, 1e3, step);
        sheet.tolerance = tolerance;
        return drift(sheet);
      };
      const double coarse = after(.02), middle = after(.01), fine = after(.005);
      INFO(tolerance << ": " << coarse << " " << middle << " " << fine);
      CHECK(std::log2((coarse - middle) / (middle - fine)) >= 1.6);
    }
}


TEST_CASE("A sheet that the cavity is even around does not rise", "[friction]")
{
  // Mirrored, and with the lid the other way, the slow flow is the same: what is lifted on one side
  // is pressed down on the other. The sheet's ends lie anywhere in their cells.
  for (const unsigned int n : {8, 12, 14})
    {
      auto sheet = gently_dragged(1e3, 1e4, .01);
      sheet.n    = n;
      auto run   = start<2>(sheet);
      for (unsigned int step = 0; step < 3; ++step)
        run.step();
      INFO(n);
      const double along = std::abs(run.column("pressure force sheet x"));
      CHECK(along > 1e-3);
      for (const char *kind : {"pressure", "viscous"})
        CHECK(std::abs(run.column(std::string(kind) + " force sheet y")) <= 1e-3 * along);
    }
}
