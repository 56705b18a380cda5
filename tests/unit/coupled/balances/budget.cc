// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/time/time_integrator.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// Everything at once: a stream with a body and a moving obstacle in it, gravity, friction,
  /// damping and a load.
  template <int dim>
  std::string
  busy_scene(const std::string &first_lines,
             const std::string &more,
             const std::string &density_of_sheet = "20",
             const std::string &form             = convection())
  {
    const std::string right = plane_or_space<dim>("1; 0", "1; 0; 0");
    const std::string down  = plane_or_space<dim>("0, -2", "0, -2, 0");
    const std::string load  = plane_or_space<dim>("0; -20", "0; -20; 0");
    return first_lines + steps_of(1. / 30) + budget +
           section("Domain", plane_or_space<dim>("set Cells = 16, 16", "set Cells = 8, 8, 7")) +
           section("Fluid",
                   "set Density = 5\nset Initial velocity = " + right + "\n" +
                     section("Pressure solver", "set Divergence tolerance = 1e-13") +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow"))) +
           section(
             "Bodies",
             body(
               "sheet",
               plane_or_space<dim>(
                 "set Lower corner = .5, 0\nset Upper corner = .53, .6\nset Cells = 1, 5",
                 "set Lower corner = .5, 0, .2\nset Upper corner = .53, .6, .7\nset "
                 "Cells = 1, 3, 2") +
                 "\nset Density = " + density_of_sheet +
                 "\nset Young's modulus = 1e5\nset Poisson's ratio = .3",
               clamp("foot", "1", "set Sides = bottom") +
                 section("tip", "set Kind = traction\nset Sides = top\nset Traction = " + load))) +
           section(
             "Obstacles",
             section("knob",
                     plane_or_space<dim>("set Shape = ball\nset Centre = .23, .7",
                                         "set Shape = ball\nset Centre = .23, .7, .5") +
                       "\nset Radius = .1\nset Displacement = " +
                       plane_or_space<dim>(".03 * sin(9 * t); 0", ".03 * sin(9 * t); 0; 0"))) +
           section(
             "Effects",
             form + section("gravity", "set Acceleration = " + down) +
               section("viscosity", "set Dynamic viscosity = .01") +
               section("damping", "set Mass coefficient = .1\nset Stiffness coefficient = 1e-3")) +
           more;
  }


  template <int dim>
  void
  check_closures(const std::string &first_lines,
                 const std::string &more             = "",
                 const std::string &density_of_sheet = "20",
                 const std::string &form             = convection())
  {
    CoupledRun<dim> run(busy_scene<dim>(first_lines, more, density_of_sheet, form) +
                        section("Time", "set Energy monitor = off") +
                        section("Solid numerics", "set Newton tolerance = 1e-12"));
    for (unsigned int n = 0; n < 4; ++n)
      {
        run.step();
        INFO("step " << n + 1);
        CHECK(run.column("energy closure") <= 1e-10);
        CHECK(run.column("momentum closure") <= 1e-9);
      }
    // Terms that must be there, so that the sums mean something.
    for (const auto &term : {"transport",
                             "diffusion",
                             "sides",
                             "obstacles",
                             "fluid at rest",
                             "friction",
                             "loads",
                             "damping",
                             "integrator"})
      CHECK(std::abs(run.column(std::string("energy by ") + term)) > 1e-6);
    CHECK(std::abs(run.column("momentum by supports x")) > 1e-6);
  }
} // namespace


static const std::string swept_flux =
  section("Time", "set Integrator = theta") + section("Coupling", "set Boundary flux = swept");


TEST_CASE("Energy and momentum of a step are accounted for", "[coupled][mpi]")
{
  const std::string splitting = "set Scheme = time_splitting\n";
  // Solved in turns a light sheet shakes more and more, until it meets itself.
  const std::string heavy = "2000";
  SECTION("simultaneous, 2D")
  {
    check_closures<2>("");
  }
  SECTION("simultaneous, 3D")
  {
    check_closures<3>("");
  }
  SECTION("swept flux")
  {
    check_closures<2>("", swept_flux);
  }
  SECTION("time splitting, 2D")
  {
    check_closures<2>(splitting, "", heavy);
  }
  SECTION("time splitting, 3D, driven by displacements")
  {
    check_closures<3>(splitting, section("Coupling", "set Fluid driven by = displacement"));
  }
}


TEST_CASE("Energy and momentum are accounted for with every integrator", "[coupled]")
{
  for (const auto &name : Registry<TimeIntegrator>::instance().names())
    if (name != "static")
      {
        INFO(name);
        const auto integrator = section("Time", "set Integrator = " + name);
        check_closures<2>("", integrator);
        check_closures<2>("", integrator, "20", flux_form());
      }
}


TEST_CASE("Both sides of the surface get the same momentum, but not with time splitting",
          "[coupled][mpi]")
{
  const auto interface = [](const std::string &first_lines, const std::string &more = "") {
    CoupledRun<2> run(busy_scene<2>(first_lines, more));
    run.step();
    run.step();
    return std::abs(run.column("momentum by interface x")) /
           std::abs(run.column("momentum by supports x"));
  };
  CHECK(interface("") < 1e-14);
  CHECK(interface("set Scheme = time_splitting\n") > 1e-3);
  // Forces on the way of the surface, not where it was.
  const double swept = interface("", swept_flux);
  CHECK(swept > 1e-6);
  CHECK(swept < 2e-1);
}


TEST_CASE("A force that does next to nothing is credited with that", "[coupled]")
{
  CoupledRun<2> run(
    steps_of(.02) + budget + section("Domain", "set Cells = 12, 12") +
    section("Fluid",
            "set Density = 2\nset Initial velocity = 1; 0\n" +
              section("Boundaries",
                      boundary("in", "left", "inflow", "set Velocity = 1 + y; 0") +
                        boundary("out", "right", "outflow"))) +
    section("Effects",
            convection() +
              section("body force", section("Fluid", "set Force per volume = 1e-9; 0"))));
  for (unsigned int n = 0; n < 3; ++n)
    {
      run.step();
      // 1e-9 N in the unit square on fluid of the mean speed 1 to 2 m/s.
      CHECK(run.column("energy by body force") > .02 * 1e-9);
      CHECK(run.column("energy by body force") < .02 * 2e-9);
      CHECK(std::abs(run.column("energy by convection")) > 1e-3);
    }
}


TEST_CASE("What bodies are loaded with is credited with the default integrator as it falls",
          "[coupled][mpi]")
{
  // A block falls in a fluid: the work of its weight is m g times its path, whatever the stages.
  CoupledRun<2> run(
    steps_of(.05) + budget + section("Domain", "set Cells = 16, 16") +
    section("Fluid",
            "set Density = 1000\n" + section("Boundaries", boundary("top", "top", "outflow"))) +
    section("Bodies",
            body("block",
                 "set Lower corner = .33, .5\nset Upper corner = .62, .8\nset "
                 "Cells = 3, 3\nset Density = 3000\nset Young's modulus = 1e6\n"
                 "set Poisson's ratio = .3")) +
    section("Effects", section("gravity", "set Acceleration = 0, -10")));
  const double mass = 3000 * .29 * .3;
  double       path = 0, last = run.column("centre of mass block y");
  for (unsigned int n = 0; n < 4; ++n)
    {
      run.step();
      path = run.column("centre of mass block y") - last;
      last += path;
      CHECK(run.column("energy by gravity") == Approx(-10 * mass * path).epsilon(1e-6));
      CHECK(run.column("energy closure") <= 1e-9);
    }
  CHECK(path < -1e-3);
}


TEST_CASE("Bodies and fluids alone have a budget, too", "[coupled][mpi]")
{
  const auto    steps = steps_of(.02) + budget;
  CoupledRun<2> bodies(
    steps +
    section("Bodies",
            body("beam",
                 "set Upper corner = 1, .1\nset Cells = 8, 1\nset Density = 1000\nset "
                 "Young's modulus = 1e6\nset Poisson's ratio = .3",
                 clamp("foot", "1", "set Sides = left"))) +
    section("Effects", section("gravity", "set Acceleration = 0, -10")));
  CoupledRun<2> fluid(steps + section("Domain", "set Cells = 8, 8") +
                      section("Fluid", "set Density = 2\nset Initial velocity = sin(3 * y); x") +
                      section("Effects", convection()));
  for (auto *run : {&bodies, &fluid})
    {
      run->step();
      const double momentum = run == &bodies ? run->column("solid momentum y") : 0.;
      run->step();
      if (run == &bodies)
        CHECK(run->column("momentum gain y") ==
              Approx(run->column("solid momentum y") - momentum).epsilon(1e-9));
      CHECK(run->column("energy closure") <= 1e-10);
      CHECK(run->column("momentum closure") <= 1e-9);
      CHECK(std::abs(run->column("energy gain")) > 1e-9);
    }
}
