// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <coupled/coupled_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{

  std::string
  vortices(const unsigned int cells, const double viscosity, const std::string &stream)
  {
    return section("Domain", fmt::format("set Upper corner = 1, 1\nset Cells = {0}, {0}", cells)) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " + stream +
                     "-cos(2*pi*x)*sin(2*pi*y); sin(2*pi*x)*cos(2*pi*y)\n" +
                     section("Boundaries", boundary("around", every_side<2>(), "periodic"))) +
           section("Effects",
                   flux_form() + (viscosity > 0 ? undine_tests::viscosity(viscosity) : ""));
  }


  /// Root mean square error of decaying vortices that a stream of 1 m/s carries, at 0.4 s.
  double
  error_of_carried_vortices(const unsigned int cells, const unsigned int steps)
  {
    const double  nu = 0.01, end = 0.4;
    CoupledRun<2> run(steps_of(end / steps) + vortices(cells, nu, "1"));
    for (unsigned int n = 0; n < steps; ++n)
      run.step();
    const double decay = std::exp(-8 * pi * pi * nu * end);
    double       sum = 0, n = 0;
    for_each_value(run.state.fluid.velocity[0],
                   [&](const double value, const auto &place, const auto &) {
                     const double exact = 1 - std::cos(2 * pi * (place[0] - end)) *
                                                std::sin(2 * pi * place[1]) * decay;
                     sum += (value - exact) * (value - exact);
                     ++n;
                   });
    return std::sqrt(sum / n);
  }


  /// Steady drag [N/m] of a cylinder of 4.7 cells in a channel, Reynolds number 20, after steps of
  /// `dt`.
  double
  drag(const double dt)
  {
    CoupledRun<2> run(
      steps_of(dt) + section("Domain", "set Upper corner = 1.6, 0.8\nset Cells = 38, 19") +
      section("Fluid",
              "set Density = 1\nset Initial velocity = 1; 0\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = 1; 0") +
                          boundary("out", "right", "outflow") +
                          boundary("walls", "bottom, top", "slip wall"))) +
      section("Obstacles",
              obstacle("cylinder",
                       "ball",
                       "set Centre = 0.5, 0.41\nset Radius = 0.1\nset Refinements = 4")) +
      section("Effects", flux_form() + viscosity(0.01)));
    while (run.state.clock.time < 12 - 1e-9)
      run.step();
    return run.column("pressure force cylinder x") + run.column("viscous force cylinder x");
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "Among obstacles as much flows into a dual volume as out of it, and convection "
  "adds no energy",
  "[coupled]",
  ((int dim), dim),
  2,
  3)
{
  // Off the planes of the grid, and with a face in one.
  const std::string round = plane_or_space<dim>("set Centre = .41, .53\nset Radius = .21\n",
                                                "set Centre = .41, .53, .47\nset Radius = .21\n");
  const std::string flush =
    plane_or_space<dim>("set Lower corner = .25, .25\nset Upper corner = .7, .3",
                        "set Lower corner = .25, .25, .25\nset Upper corner = .7, .3, .61");
  for (const auto &thing :
       {obstacle("thing", "ball", round + "set Refinements = 3"), obstacle("thing", "box", flush)})
    {
      ObstacleRun<dim> run(
        section("Domain",
                plane_or_space<dim>("set Upper corner = 1, 1\nset Cells = 12, 12",
                                    "set Upper corner = 1, 1, 1\nset Cells = 8, 8, 8")) +
          section(
            "Fluid",
            "set Density = 1000\nset Initial velocity = " +
              plane_or_space<dim>("sin(3*y)+.2; cos(5*x)", "sin(3*y)+.2; cos(5*x); sin(4*y)") +
              "\n" + section("Boundaries", boundary("all", every_side<dim>(), "slip wall"))),
        thing,
        flux_form(),
        0.1);
      double energy = kinetic_energy(*run.models.fluid, run.state.fluid.velocity);
      for (unsigned int n = 0; n < 3; ++n)
        {
          run.step();
          const double now = kinetic_energy(*run.models.fluid, run.state.fluid.velocity);
          CHECK(now <= energy * (1 + 1e-9));
          energy = now;
        }
      const auto           &velocity = run.state.fluid.velocity;
      const DualFluxes<dim> fluxes(*run.models.fluid, velocity, run.state.clock.time);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          Field<dim> sums(velocity[axis].shared_lattice(), velocity[axis].topology());
          double     most = 0;
          fluxes.for_each_between(axis, [&](const auto &from, const auto &to, const double flux) {
            most = std::max(most, std::abs(flux));
            for (const auto &[place, sign] : {std::pair(from, -1.), std::pair(to, 1.)})
              (place.part < 0 ? sums(place.face) : sums.parts()[place.part]) += sign * flux;
          });
          CHECK(most > 1e-4);
          double largest = 0;
          for_each_value(sums, [&](const double sum, const auto &, const auto &face) {
            if (!run.models.fluid->grid().at_boundary(axis, face))
              largest = std::max(largest, std::abs(sum));
          });
          CHECK(largest <= 1e-9 * most);
        }
    }
}


TEST_CASE("Convection in flux form and friction together are of second order in time and space",
          "[coupled]")
{
  const double in_time[] = {error_of_carried_vortices(64, 5),
                            error_of_carried_vortices(64, 10),
                            error_of_carried_vortices(64, 80)};
  INFO("in time " << in_time[0] << ", " << in_time[1] << ", " << in_time[2]);
  CHECK(std::log2(in_time[0] / in_time[1]) > 1.6);
  const double in_space[] = {error_of_carried_vortices(16, 80), error_of_carried_vortices(32, 80)};
  INFO("in space " << in_space[0] << ", " << in_space[1]);
  CHECK(std::log2(in_space[0] / in_space[1]) > 1.8);
}


TEST_CASE("Vortices without friction keep their energy to the order of the integrator", "[coupled]")
{
  const auto loss = [](const unsigned int steps) {
    CoupledRun<2> run(steps_of(2. / steps) + vortices(24, 0, "0.5"));
    const double  start = run.column("Fluid kinetic energy");
    for (unsigned int n = 0; n < steps; ++n)
      run.step();
    return 1 - run.column("Fluid kinetic energy") / start;
  };
  const double coarse = loss(20), fine = loss(40);
  INFO(coarse << ", " << fine);
  CHECK(fine > 0);
  CHECK(fine < 0.02);
  CHECK(coarse / fine > 3.8);
}


TEST_CASE("A steady drag does not depend on the step", "[coupled]")
{
  const double reference = drag(0.1);
  CHECK(reference > 0.1);
  for (const double dt : {0.4, 0.025})
    CHECK(std::abs(drag(dt) - reference) < 1e-3 * reference);
}


TEST_CASE("A jet without friction into an open box keeps its energy bounded in flux form",
          "[flows]")
{
  // Vortices draw in fluid through the sides. The inflow brings 9.2 W. The jet is a cell or two
  // wide, of which the damping of short waves takes some.
  for (const std::string &short_waves : {"kept", "damped"})
    {
      INFO(short_waves);
      CoupledRun<3> run(
        steps_of(1. / 30) + section("Domain", "set Upper corner = 2, 1, 1\nset Cells = 12, 6, 6") +
        section("Fluid",
                "set Density = 1.2\n" +
                  section("Boundaries",
                          boundary("jet",
                                   "left",
                                   "inflow",
                                   "set Region = .15^2 - (y - .58)^2 - (z - .5)^2\n"
                                   "set Velocity = 6; 0; 0") +
                            boundary("open", "right, top, back, front", "outflow"))) +
        section("Effects",
                section("convection", "set Form = flux\nset Short waves = " + short_waves)));
      double largest = 0;
      for (unsigned int n = 0; n < 120; ++n)
        {
          run.step();
          largest = std::max(largest, run.column("Fluid kinetic energy"));
        }
      CHECK(run.column("Fluid kinetic energy") > (short_waves == "kept" ? 3 : 2));
      CHECK(largest < 7);
    }
}
