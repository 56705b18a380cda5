// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  std::string
  direction(const std::string &name)
  {
    return section("Coupling", "set Direction = " + name);
  }


  template <int dim>
  std::string
  stream()
  {
    const std::string right = plane_or_space<dim>("1; 0", "1; 0; 0");
    return section("Domain", plane_or_space<dim>("set Cells = 16, 12", "set Cells = 8, 6, 6")) +
           section("Fluid",
                   "set Density = 5\nset Initial velocity = " + right + "\n" +
                     section("Pressure solver", "set Divergence tolerance = 1e-12") +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow")));
  }


  /// Clamped below the floor of the stream.
  template <int dim>
  std::string
  plate(const double modulus)
  {
    return steps_of(1. / 50) + section("Output", "set Budget = true") +
           section(
             "Bodies",
             body("plate",
                  plane_or_space<dim>(
                    "set Lower corner = .41, -.05\nset Upper corner = .46, .53\nset Cells = 1, 6",
                    "set Lower corner = .41, -.05, .2\nset Upper corner = .46, .53, .7\n"
                    "set Cells = 1, 4, 3") +
                    fmt::format("\nset Density = 20\nset Young's modulus = {}\n"
                                "set Poisson's ratio = .3",
                                modulus),
                  clamp("foot", "-y")));
  }


  template <int dim>
  std::string
  pull_to_the_right()
  {
    return section("gravity",
                   plane_or_space<dim>("set Acceleration = 8, 0", "set Acceleration = 8, 0, 0"));
  }


  template <int dim>
  std::vector<double>
  velocity_values(const CoupledRun<dim> &run)
  {
    std::vector<double> all;
    for (const auto &component : run.state.fluid.velocity.components)
      for_each_value(component,
                     [&](const double value, const auto &, const auto &) { all.push_back(value); });
    return all;
  }


  const std::string splitting = "set Scheme = time_splitting\n";
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "a body that only feels the fluid does not move it", "[one_way][mpi]", ((int dim), dim), 2, 3)
{
  const std::string rest =
    stream<dim>() + direction("fluid to body") + section("Effects", convection());
  CoupledRun<dim> soft(plate<dim>(3e3) + rest);
  CoupledRun<dim> stiff(splitting + plate<dim>(3e7) + rest);
  for (unsigned int n = 0; n < 4; ++n)
    for (auto *run : {&soft, &stiff})
      run->step();
  // The fluid is the same to the bit, whatever the body does and whatever the scheme.
  CHECK(velocity_values(soft) == velocity_values(stiff));
  CHECK(soft.column("max speed plate") > 20 * stiff.column("max speed plate"));
  CHECK(soft.column("max speed plate") > 1e-3);
  // What the body feels is what the fluid gave.
  for (auto *run : {&soft, &stiff})
    {
      CHECK(std::abs(run->column("momentum by interface x")) <
            1e-12 * std::abs(run->column("momentum by supports x")));
      CHECK(run->column("energy closure") < 1e-9);
      CHECK(run->column("momentum closure") < 1e-9);
    }
  CHECK(soft.timing.work_of("couple").calls == 0);
}


TEMPLATE_TEST_CASE_SIG("a body that does not feel the fluid moves as without it",
                       "[one_way][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const std::string effects = section("Effects", pull_to_the_right<dim>());
  CoupledRun<dim>   run(plate<dim>(3e3) + stream<dim>() + direction("body to fluid") + effects);
  CoupledRun<dim>   alone(plate<dim>(3e3) + effects);
  for (unsigned int n = 0; n < 4; ++n)
    for (auto *one : {&run, &alone})
      one->step();
  auto difference = run.state.solid.displacement;
  difference -= alone.state.solid.displacement;
  CHECK(difference.linfty_norm() == 0);
  CHECK(run.column("max speed plate") > 0.05);
  // The fluid follows, and what it takes is in the budget.
  CHECK(run.column("Fluid divergence") < 1e-9);
  CHECK(run.column("energy closure") < 1e-9);
  CHECK(run.column("momentum closure") < 1e-9);
  CHECK(std::abs(run.column("energy by interface")) > 1e-4);
}


TEST_CASE("around a stiff body the fluid is the same in all directions", "[one_way]")
{
  const auto force = [](const std::string &name) {
    // Implicit Euler, which leaves no vibrations of the plate.
    CoupledRun<2> run(plate<2>(1e9) + section("Time", "set Integrator = theta\nset Theta = 1") +
                      stream<2>() + direction(name) + section("Effects", convection()));
    for (unsigned int n = 0; n < 8; ++n)
      run.step();
    return run.column("pressure force plate x");
  };
  const double both = force("two-way");
  CHECK(force("fluid to body") == Approx(both).epsilon(1e-3));
  CHECK(force("body to fluid") == Approx(both).epsilon(1e-3));
}


TEST_CASE("directions that contradict the scene are refused with a hint", "[one_way]")
{
  const auto complaint = [](const std::string &scene) {
    return message_of([&] { CoupledRun<2> run(scene); });
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(complaint(plate<2>(1) + stream<2>() + direction("both")),
             Contains("'Direction'") && Contains("body to fluid"));
  CHECK_THAT(complaint(plate<2>(1) + direction("fluid to body")),
             Contains("not both a fluid and bodies") && Contains("Remove"));
  CHECK_THAT(
    complaint(plate<2>(1) + stream<2>() +
              section("Coupling", "set Direction = fluid to body\nset Linear tolerance = 1e-9")),
    Contains("'Linear tolerance'") && Contains("two-way"));
}
