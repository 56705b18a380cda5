// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/bodies/chamber_volume.h>

using namespace undine_tests;

namespace
{
  const std::string swept =
    section("Time", "set Integrator = theta") + section("Coupling", "set Boundary flux = swept");
  const std::string initial = section("Time", "set Integrator = theta");
  const std::string stages  = section("Time", "set Integrator = trapezoid_bdf2");


  /// A membrane closes a chamber full of water that is filled up further through its floor.
  template <int dim>
  std::string
  chamber(const double dt, const std::string &method, const std::string &speed)
  {
    const std::string up = fmt::format(plane_or_space<dim>("0; {}", "0; {}; 0"), speed);
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
           method;
  }


  template <int dim>
  dealii::Point<dim>
  inside()
  {
    dealii::Point<dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result[axis] = axis == 1 ? .2 : .5;
    return result;
  }


  /// Of the chamber's volume after half a second, to what has flown in [1].
  template <int dim>
  double
  volume_error(const unsigned int steps, const std::string &method)
  {
    CoupledRun<dim>    run(chamber<dim>(.5 / steps, method, ".3*sin(pi*t)^2"));
    ChamberRecord<dim> record(run, inside<dim>());
    for (unsigned int n = 0; n < steps; ++n)
      {
        run.step();
        record.note_step();
        CHECK(run.column("Fluid divergence") <= 1e-9);
        CHECK(run.column("momentum residual membrane") <= 1e-9);
      }
    CHECK(record.inflow > .05);
    return record.error();
  }


  /// Of the chamber's volume while water flows in and out once a second, relative to it: the
  /// largest of the first and of the second half of the time.
  std::array<double, 2>
  breathing_errors(const double seconds, const double dt, const std::string &method)
  {
    CoupledRun<2>         run(chamber<2>(dt, method, ".06*sin(2*pi*t)"));
    ChamberRecord<2>      record(run, inside<2>());
    std::array<double, 2> largest{{0, 0}};
    const unsigned int    steps = std::lround(seconds / dt);
    for (unsigned int n = 0; n < steps; ++n)
      {
        run.step();
        record.note_step();
        auto &half = largest[n < steps / 2 ? 0 : 1];
        half       = std::max(half, std::abs(record.error()) / record.first);
      }
    return largest;
  }


  /// The same by TR-BDF2 (T9): what flows in is summed by the rule that bodies and fluid advance
  /// by, with q(t) the inflow through the floor [m^dim/s].
  template <int dim>
  double
  error_of_stages(const double dt, const double seconds, const std::string &speed)
  {
    CoupledRun<dim> run(chamber<dim>(dt, stages, speed));
    const auto volume = [&] { return measure_region(run.models, run.state, inside<dim>()).volume; };
    const auto inflow = [&](const double time) {
      dealii::FunctionParser<1> parser("t");
      parser.initialize("t", speed, {{"pi", M_PI}});
      return parser.value(dealii::Point<1>(time));
    };
    const double first = volume();
    const double g = (1 - std::sqrt(.5)) * dt, w = std::sqrt(2.) / 4 * dt;
    double       held = first, largest = 0;
    for (unsigned int n = 0; n < std::lround(seconds / dt); ++n)
      {
        const double t = n * dt;
        held += n == 0 ? (dt - g) * inflow(g) + g * inflow(dt)
                       : w * (inflow(t) + inflow(t + 2 * g)) + g * inflow(t + dt);
        run.step();
        largest = std::max(largest, std::abs(volume() - held) / first);
      }
    CHECK(std::abs(held - first) > 1e-3);
    return largest;
  }
} // namespace


TEST_CASE("A closed chamber holds what has flown in", "[coupled][mpi]")
{
  SECTION("2D")
  {
    CHECK(std::abs(volume_error<2>(10, swept)) <= 1e-10);
    const double coarse = volume_error<2>(10, initial), fine = volume_error<2>(20, initial);
    INFO(fmt::format("{:.2e} {:.2e}", coarse, fine));
    CHECK(std::abs(coarse) > 1e-5);
    CHECK(coarse / fine == Approx(2).epsilon(.3));
  }
  SECTION("3D")
  {
    CHECK(std::abs(volume_error<3>(5, swept)) <= 1e-10);
  }
  SECTION("2D, by stages")
  {
    CHECK(error_of_stages<2>(1. / 20, .5, ".3*sin(pi*t)^2") <= 1e-10);
  }
  SECTION("3D, by stages")
  {
    CHECK(error_of_stages<3>(1. / 10, .5, ".3*sin(pi*t)^2") <= 1e-10);
  }
}


TEST_CASE("A closed chamber that breathes keeps its volume", "[coupled]")
{
  for (const double error : breathing_errors(10, 1. / 30, swept))
    CHECK(error <= 1e-10);
  CHECK(error_of_stages<2>(1. / 30, 10, ".06*sin(2*pi*t)+.02*sin(pi*t/10)") <= 1e-10);
  const auto coarse = breathing_errors(4, 1. / 30, initial),
             fine   = breathing_errors(4, 1. / 60, initial);
  INFO(fmt::format("{:.2e} {:.2e}", coarse[1], fine[1]));
  CHECK(coarse[1] <= 3e-3);
  CHECK(coarse[1] / fine[1] == Approx(2).epsilon(.1));
}


TEST_CASE("A closed chamber takes an inflow that is there from the start", "[coupled][mpi]")
{
  CoupledRun<2>    run(chamber<2>(1. / 60, swept, ".1"));
  ChamberRecord<2> record(run, inside<2>());
  CHECK(run.column("Flux through in") == Approx(-.1));
  for (unsigned int n = 0; n < 10; ++n)
    {
      run.step();
      record.note_step();
    }
  CHECK(record.inflow == Approx(1. / 60));
  CHECK(std::abs(record.error()) <= 1e-10);
}


TEST_CASE("With time splitting a chamber has no solution, which the run says", "[coupled][mpi]")
{
  CoupledRun<2> run("set Scheme = time_splitting\n" + chamber<2>(1. / 60, "", ".1"));
  CHECK_THROWS_WITH(run.step(), Catch::Matchers::Contains("Scheme = simultaneous"));
}


TEST_CASE("Membranes that start in planes of the grid move as others do", "[coupled]")
{
  // Where a surface leaves a plane the cut grid gains what lies between, which no flow has brought.
  const auto energy_after = [](const double shift) {
    const auto membrane = [&](const std::string &name, const double left) {
      return body(name,
                  fmt::format("set Lower corner = {}, -.05\nset Upper corner = {}, 1.05\n"
                              "set Cells = 1, 22\nset Density = 1100\nset Young's modulus = 1e6\n"
                              "set Poisson's ratio = .4",
                              left + shift,
                              left + .02 + shift),
                  clamp("rim", "1", "set Sides = bottom, top"));
    };
    CoupledRun<2> run(
      steps_of(1. / 60) + section("Output", "set Budget = true") +
      section("Domain", "set Cells = 32, 32") +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        boundary("in", "left", "inflow", "set Velocity = .05*sin(pi*t)^2; 0") +
                          boundary("out", "right", "outflow"))) +
      section("Bodies", membrane("a", .25) + membrane("b", .5) + membrane("c", .75)));
    for (unsigned int n = 0; n < 6; ++n)
      {
        run.step();
        CHECK(run.column("energy closure") < 1e-5);
      }
    return run.column("solid elastic energy");
  };
  const double beside = energy_after(.006);
  for (const double shift : {0., 1e-8, -.02})
    {
      INFO(shift);
      CHECK(energy_after(shift) == Approx(beside).epsilon(.05));
    }
}


TEST_CASE(
  "Under a stiff lid air has a pressure far above its differences, and equations converge to "
  "rounding",
  "[coupled]")
{
  CoupledRun<2> run(
    steps_of(1. / 30) + section("Domain", "set Cells = 31, 22") +
    section(
      "Fluid",
      "set Density = 1.2\n" +
        section("Boundaries",
                boundary("in",
                         "bottom",
                         "inflow",
                         "set Region = .2 - abs(x - .5)\nset Velocity = 0; .377*sin(2.049*t)^2") +
                  boundary("out", "top", "outflow"))) +
    section(
      "Bodies",
      body("lid",
           "set Lower corner = -.05, .545\nset Upper corner = 1.05, .58\nset Cells = 24, 1\nset "
           "Density = 280\nset Young's modulus = 8.8e7\nset Poisson's ratio = .02",
           clamp("rim", "max(-x, x-1)"))) +
    section("Effects", section("viscosity", "set Dynamic viscosity = 1.43e-4")));
  for (unsigned int n = 0; n < 40; ++n)
    {
      run.step();
      CHECK(run.report.newton_iterations <= 12);
      CHECK(run.column("momentum residual lid") <= 1e-9);
    }
}
