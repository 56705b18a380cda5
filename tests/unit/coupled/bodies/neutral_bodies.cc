// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// How far a stiff block of the fluid's own density moves in 0.2 s [m].
  template <int dim>
  double
  way_of_block(const std::string &integrator)
  {
    CoupledRun<dim> run(
      section("Time", "set Step = .01\nset Integrator = " + integrator) +
      section("Domain", "set Cells = " + plane_or_space<dim>("10, 10", "6, 6, 6")) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries", boundary("top", "top", "pressure", "set Pressure = 0"))) +
      section("Bodies",
              body("block",
                   plane_or_space<dim>("set Lower corner = .33, .32\nset Upper corner = .69, .68\n"
                                       "set Cells = 2, 2\n",
                                       "set Lower corner = .33, .32, .31\n"
                                       "set Upper corner = .69, .68, .67\nset Cells = 1, 1, 1\n") +
                     "set Density = 1000\nset Young's modulus = 1e9\nset Poisson's ratio = .3")) +
      section("Effects",
              section("gravity",
                      "set Acceleration = " + plane_or_space<dim>("0, -9.81", "0, -9.81, 0"))));
    const double start = run.column("centre of mass block y");
    for (int n = 0; n < 20; ++n)
      run.step();
    return std::abs(run.column("centre of mass block y") - start);
  }
} // namespace


TEST_CASE("A body as heavy as the fluid stays where it is, with every integrator", "[coupled][mpi]")
{
  for (const std::string integrator : {"trapezoid_bdf2",
                                       "theta",
                                       "newmark",
                                       "generalised_alpha",
                                       "generalised_alpha\nset Spectral radius = 0"})
    {
      INFO(integrator);
      // Pressure makes it smaller, and it sinks by some micrometres.
      CHECK(way_of_block<2>(integrator) < 1e-5);
    }
  CHECK(way_of_block<3>("generalised_alpha\nset Spectral radius = 0") < 1e-5);
}
