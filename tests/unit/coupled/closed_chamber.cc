// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/fluid_regions.h>
#include <undine/fluid/pressure_gradient.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A membrane closes a chamber full of water that is filled up further through its floor.
  template <int dim>
  std::string
  chamber(const double dt, const std::string &boundary_flux)
  {
    const std::string up = plane_or_space<dim>("0; .3*sin(pi*t)^2", "0; .3*sin(pi*t)^2; 0");
    return steps_of(dt) +
           section("Domain", plane_or_space<dim>("set Cells = 12, 12", "set Cells = 8, 9, 8")) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries",
                             boundary("in", "bottom", "inflow", "set Velocity = " + up) +
                               boundary("out", "top", "outflow"))) +
           section("Bodies",
                   body("membrane",
                        plane_or_space<dim>("set Lower corner = 0, .4\nset Upper corner = 1, "
                                            ".43\nset Cells = 12, 1",
                                            "set Lower corner = 0, .4, 0\nset Upper corner = "
                                            "1, .43, 1\nset Cells = 4, 1, 4") +
                          "\nset Density = 1100\nset Young's modulus = 1e6\nset Poisson's ratio = "
                          ".3",
                        clamp("rim",
                              "1",
                              plane_or_space<dim>("set Sides = left, right",
                                                  "set Sides = left, right, back, front")))) +
           section("Coupling", "set Boundary flux = " + boundary_flux);
  }


  /// Of the fluid that is connected with the first cell [m^dim].
  template <int dim>
  double
  volume_of_chamber(const CoupledRun<dim> &run)
  {
    auto              &models = run.models;
    FluidGeometry<dim> geometry(models);
    const auto         positions = models.surface->positions(run.state.solid, run.state.clock.time);
    geometry.place(positions, positions, std::vector<dealii::Tensor<1, dim>>(positions.size()));
    const auto                &grid = models.fluid->grid();
    const PressureNumbers<dim> numbers(grid, geometry.bodies().open_parts);
    const FluidRegions<dim>    regions(grid, numbers);
    Field<dim>                 volumes(grid.cells(), geometry.bodies().open_parts);
    set_volumes(volumes, grid);
    std::size_t k   = 0;
    double      sum = 0;
    for_each_value(volumes, [&](const double volume, const auto &, const auto &) {
      if (regions.of_pressures()[k++] == 0)
        sum += volume;
    });
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }


  /// Of the chamber's volume after half a second, to what has flown in [1].
  template <int dim>
  double
  volume_error(const unsigned int steps, const std::string &boundary_flux)
  {
    CoupledRun<dim> run(chamber<dim>(.5 / steps, boundary_flux));
    const double    first  = volume_of_chamber(run);
    double          inflow = 0;
    for (unsigned int n = 0; n < steps; ++n)
      {
        run.step();
        inflow -= run.report.dt * run.column("Flux through in");
        CHECK(run.column("Fluid divergence") <= 1e-9);
        CHECK(run.column("momentum residual membrane") <= 1e-9);
      }
    CHECK(inflow > .05);
    return volume_of_chamber(run) - first - inflow;
  }
} // namespace


TEST_CASE("A closed chamber holds what has flown in", "[coupled][mpi]")
{
  SECTION("2D")
  {
    CHECK(std::abs(volume_error<2>(10, "swept")) <= 1e-10);
    const double coarse = volume_error<2>(10, "initial"), fine = volume_error<2>(20, "initial");
    INFO(fmt::format("{:.2e} {:.2e}", coarse, fine));
    CHECK(std::abs(coarse) > 1e-5);
    CHECK(coarse / fine == Approx(2).epsilon(.3));
  }
  SECTION("3D")
  {
    CHECK(std::abs(volume_error<3>(5, "swept")) <= 1e-10);
  }
}
