// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>
#include <cmath>

using namespace undine_tests;

namespace
{
  struct Swing
  {
    std::string  integrator;
    unsigned int steps_per_second;
    double       thickness; ///< [m]
  };


  /// A dry strip of 0.65 m that swings out from its foot. `viscosity` [s].
  std::string
  strip(const Swing &swing, const double viscosity)
  {
    return section("Time",
                   fmt::format("set Step = 1/{}\nset Integrator = {}\nset Energy monitor = off",
                               swing.steps_per_second,
                               swing.integrator)) +
           section("Output", "set Budget = true") +
           section("Bodies",
                   body("sheet",
                        fmt::format("set Upper corner = {}, 0.65\nset Cells = 1, 26\n"
                                    "set Density = 1100\nset Young's modulus = 3e9\n"
                                    "set Poisson's ratio = 0.3\n"
                                    "set Initial velocity = 2*y/0.65; 0",
                                    swing.thickness),
                        clamp("foot", "1", "set Sides = bottom"))) +
           (viscosity > 0 ? section("Effects",
                                    section("damping",
                                            fmt::format("set Stiffness coefficient = {}\n"
                                                        "set Mass coefficient = 0.2",
                                                        viscosity)))
                          : "");
  }


  double
  total_energy(const CoupledRun<2> &run)
  {
    return run.column("solid kinetic energy") + run.column("solid elastic energy");
  }


  /// The largest energy within `end` [s] over that at the start. Damping must take energy in every
  /// step.
  double
  largest_energy(const Swing &swing, const double viscosity, const double end)
  {
    CoupledRun<2> run(strip(swing, viscosity));
    const double  start   = total_energy(run);
    double        largest = start;
    while (run.state.clock.time < end)
      {
        run.step();
        largest = std::max(largest, total_energy(run));
        if (viscosity > 0)
          CHECK(run.column("energy by damping") <= 0);
      }
    return largest / start;
  }


  void
  check_damping(const Swing &swing)
  {
    INFO(swing.integrator << ", " << swing.thickness << " m, 1/" << swing.steps_per_second << " s");
    const double end    = 0.3;
    const double free   = largest_energy(swing, 0, end);
    const double damped = largest_energy(swing, 1e-3, end);
    CHECK(damped <= std::max(1., free) * (1 + 1e-6));
  }


  /// A cantilever of linear material that swings in its first mode.
  std::string
  cantilever(const std::string &integrator, const double step, const double viscosity)
  {
    const double k = 1.8751040687 / 0.5, ratio = 0.7340955138;
    return section("Time",
                   fmt::format("set Step = {:.17g}\nset Integrator = {}", step, integrator)) +
           section("Bodies",
                   body("beam",
                        fmt::format("set Upper corner = 0.5, 0.02\nset Cells = 12, 1\n"
                                    "set Density = 1000\nset Young's modulus = 1e6\n"
                                    "set Poisson's ratio = 0\nset Material = linear elastic\n"
                                    "set Initial velocity = 0; cosh({0}*x) - cos({0}*x)"
                                    " - {1}*(sinh({0}*x) - sin({0}*x))",
                                    k,
                                    ratio),
                        clamp("foot", "1", "set Sides = left"))) +
           section("Solid numerics", "set Element degree = 2") +
           (viscosity > 0
              ? section(
                  "Effects",
                  section("damping", fmt::format("set Stiffness coefficient = {}", viscosity)))
              : "");
  }
} // namespace


TEST_CASE("Damping of a strip that swings out only takes energy, with every integrator",
          "[coupled]")
{
  for (const std::string name : {"trapezoid_bdf2", "theta", "newmark"})
    for (const unsigned int steps : {15, 60})
      check_damping({name, steps, 0.00041667});
  // In longer steps its first accelerations make it gain energy without damping, too.
  check_damping({"generalised_alpha", 240, 0.00041667});
  check_damping({"newmark\nset Gamma = 0.6", 60, 0.00041667});
  check_damping({"trapezoid_bdf2", 480, 0.00041667});
  check_damping({"trapezoid_bdf2", 30, 0.02});
}


TEST_CASE("The first mode of bending is damped by eta omega / 2", "[coupled]")
{
  // Clamped at one end: omega = 1.875^2 sqrt(E I / (rho A)) / L^2.
  const double omega =
    1.8751040687 * 1.8751040687 * std::sqrt(1e6 * 0.02 * 0.02 / 12 / 1000) / (0.5 * 0.5);
  const double       expected  = 0.02; // damping ratio
  const double       viscosity = 2 * expected / omega;
  const double       period    = 2 * M_PI / omega;
  const unsigned int n_periods = 3;
  for (const std::string integrator :
       {"trapezoid_bdf2", "newmark", "theta\nset Theta = 0.5", "generalised_alpha"})
    {
      const unsigned int steps = 32; // in a period: omega h = 0.196
      INFO(integrator);
      CoupledRun<2> free(cantilever(integrator, period / steps, 0));
      CoupledRun<2> damped(cantilever(integrator, period / steps, viscosity));
      for (unsigned int n = 0; n < n_periods * steps; ++n)
        {
          free.step();
          damped.step();
        }
      const double ratio =
        std::log(total_energy(free) / total_energy(damped)) / (4 * M_PI * n_periods);
      CHECK(ratio == Approx(expected).epsilon(0.02));
    }
}
