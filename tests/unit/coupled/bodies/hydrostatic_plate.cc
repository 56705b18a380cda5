// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_point.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double free_fall = 9.81;

  const std::string with_swept_flux = section("Coupling", "set Boundary flux = swept");

  /// prm/hydrostatic_plate.prm: water on a plate that is clamped on both sides, air below.
  std::string
  plate_under_water(const double dt, const std::string &method)
  {
    return steps_of(dt) +
           section("Domain",
                   "set Lower corner = 0, -0.75\nset Upper corner = 1, 0\nset Cells = 32, 24") +
           section(
             "Fluid",
             "set Density = 1000\n" +
               section("Boundaries", boundary("surface", "top", "pressure", "set Pressure = 0")) +
               section("Void regions", section("air", "set Seed = .5, -.7"))) +
           section("Bodies",
                   body("plate",
                        "set Lower corner = 0, -.54\nset Upper corner = 1, -.5\nset Cells = 24, 1\n"
                        "set Density = 1100\nset Young's modulus = 1e8\nset Poisson's ratio = .3",
                        clamp("ends", "1", "set Sides = left, right"))) +
           section("Effects",
                   convection() +
                     section("gravity", fmt::format("set Acceleration = 0, -{}", free_fall))) +
           method;
  }


  double
  deflection(const CoupledRun<2> &run)
  {
    SolidPoint<2> middle(*run.models.solid, "plate", {.5, -.52});
    return middle.value(run.state.solid.displacement)[1];
  }
} // namespace


TEST_CASE("A plate under water bends as under its pressure and stays at rest", "[coupled][mpi]")
{
  // Steps so long that the water's inertia does not matter: the limit is the place of rest.
  CoupledRun<2> run(
    plate_under_water(1000, section("Time", "set Integrator = static") + with_swept_flux));
  double inflow = 0;
  for (unsigned int n = 0; n < 8; ++n)
    {
      run.step();
      inflow -= run.report.dt * run.column("Flux through surface");
    }

  // The plate alone, pressed by rho g times the depth of the bent plate:
  // benchmarks/hydrostatic_plate.py.
  const double same_mesh = -.0206931, converged = -.020829;
  CHECK(deflection(run) == Approx(same_mesh).epsilon(1e-4));
  CHECK(deflection(run) == Approx(converged).epsilon(.01));

  // The clamp bears the plate, the water that was there, and what has flown in since.
  const double weight = free_fall * (1100 * .04 + 1000 * (.5 + inflow));
  CHECK(inflow > .01);
  CHECK(run.column("reaction plate/ends y") == Approx(weight).epsilon(1e-9));

  const double rest = deflection(run);
  for (const auto &method : {section("Time", "set Integrator = theta") + with_swept_flux,
                             section("Time", "set Integrator = trapezoid_bdf2")})
    {
      INFO(method);
      CoupledRun<2> later(plate_under_water(1. / 30, method));
      later.state = run.state;
      for (unsigned int n = 0; n < 20; ++n)
        {
          later.step();
          CHECK(later.column("max speed plate") <= 1e-8);
          CHECK(later.column("Fluid largest speed") <= 2e-6);
        }
      CHECK(deflection(later) == Approx(rest).epsilon(1e-10));
    }
}


TEST_CASE("Steps much longer than a plate swings find its mean deflection", "[coupled]")
{
  const double exact = -.0206931; // of the same elements at rest, see above
  for (const double dt : {1. / 30, .1, .2})
    {
      CoupledRun<2> run(plate_under_water(dt, section("Time", "set Integrator = trapezoid_bdf2")));
      double        mean  = 0;
      const int     steps = 100;
      for (int n = 0; n < 2 * steps; ++n)
        {
          run.step();
          mean += n < steps ? 0. : deflection(run) / steps;
        }
      INFO(fmt::format("{} s: {:.6f} m", dt, mean));
      CHECK(mean == Approx(exact).epsilon(.05));
    }
}
