// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>

using namespace undine_tests;

namespace
{
  constexpr double gravity = 100;

  /// A stiff block that lies on the floor of a tank, or of less than the fluid's density under its
  /// lid, with an activation distance of .01.
  template <int dim>
  CoupledRun<dim>
  block_in_a_tank(const double density, const double dt, const std::string &effects)
  {
    const double low    = density > 1 ? .009 : .691;
    const auto   corner = [](const double x, const double y) {
      return fmt::format(plane_or_space<dim>("{0}, {1}", "{0}, {1}, {0}"), x, y);
    };
    return CoupledRun<dim>(
      steps_of(dt) + section("Output", "set Impulses = true") +
      section("Domain",
              plane_or_space<dim>("set Cells = 18, 21",
                                  "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 1\n"
                                  "set Cells = 8, 9, 8")) +
      section("Fluid", "set Density = 1") + section("Solid numerics", "set Element degree = 1") +
      section("Bodies",
              body("block",
                   fmt::format("set Lower corner = {}\nset Upper corner = {}\nset Cells = {}\n"
                               "set Density = {}\nset Young's modulus = 1e7\n"
                               "set Poisson's ratio = .1\n",
                               corner(.31, low),
                               corner(.66, low + .3),
                               plane_or_space<dim>("2, 2", "2, 2, 2"),
                               density))) +
      section("Effects",
              section("contact", "set Activation distance = .01") +
                section("damping",
                        fmt::format("set Mass coefficient = {}", 100 / std::min(density, 1.))) +
                section("gravity",
                        fmt::format(plane_or_space<dim>("set Acceleration = 0, {}",
                                                        "set Acceleration = 0, {}, 0"),
                                    -gravity)) +
                effects));
  }


  /// After a while the fluid and the block are at rest, and each knows it.
  template <int dim>
  void
  check_rest(const double density, const double dt, const std::string &effects)
  {
    INFO(dim << "D, " << density << " of the fluid's density, steps of " << dt << ", " << effects);
    auto         run    = block_in_a_tank<dim>(density, dt, effects);
    const double volume = run.column("volume block"), weight = gravity * volume;
    while (run.state.clock.time < .3)
      run.step();
    const double energy  = run.column("Fluid kinetic energy");
    const double impulse = run.column("pressure impulse block y"), time = run.state.clock.time;
    for (unsigned int n = 0; n < 8; ++n)
      {
        run.step();
        CHECK(run.report.newton_iterations <= 8);
        CHECK(run.report.stages_again == 0);
      }
    CHECK(run.column("nodes in contact") > 0);
    CHECK(run.column("contact force block y") == Approx((density - 1) * weight).epsilon(1e-3));
    CHECK(run.column("pressure force block y") == Approx(weight).epsilon(1e-3));
    CHECK(run.column("pressure impulse block y") - impulse ==
          Approx(weight * (run.state.clock.time - time)).epsilon(1e-3));
    CHECK(run.column("Fluid kinetic energy") <= energy * (1 + 1e-3));
  }
} // namespace


namespace
{
  /// A block of 20000 kg/m^3 that lies on another one, which is clamped at its floor or all over,
  /// dry or in water that is open at the top.
  CoupledRun<2>
  block_on_a_base(const std::string &integrator, const std::string &fluid, const std::string &held)
  {
    const std::string material =
      "set Density = {}\nset Young's modulus = 1e6\nset Poisson's ratio = .3\n";
    return CoupledRun<2>(
      section("Time", "set Step = 1/60\nset Integrator = " + integrator) + fluid +
      section(
        "Bodies",
        body("base",
             "set Lower corner = .35, 0\nset Upper corner = .65, .1\nset Cells = 3, 4\n" +
               fmt::format(fmt::runtime(material), 1000),
             section("support", held)) +
          body("block",
               "set Lower corner = .4, .107\nset Upper corner = .6, .307\nset Cells = 2, 2\n" +
                 fmt::format(fmt::runtime(material), 20000))) +
      section("Effects",
              section("contact", "set Activation distance = .008") +
                section("damping", "set Mass coefficient = 20\nset Stiffness coefficient = .001") +
                section("gravity", "set Acceleration = 0, -9.81")));
  }


  /// The support bears what the base weighs, feels of the fluid and carries.
  void
  check_support(const std::string &integrator, const std::string &fluid, const std::string &held)
  {
    INFO(integrator << ", " << fluid << held);
    auto run = block_on_a_base(integrator, fluid, held);
    while (run.state.clock.time < 1.5)
      run.step();
    const bool   is_dry      = fluid.empty();
    const double weight      = 9.81 * 1000 * .3 * .1;
    const double by_block    = run.column("contact force base y");
    const double by_fluid    = is_dry ? 0. : run.column("pressure force base y");
    const double water       = is_dry ? 0. : run.column("pressure force block y");
    const double block_alone = 9.81 * 20000 * .2 * .2;
    CHECK(run.column("contact force block y") == Approx(block_alone - water).epsilon(2e-3));
    CHECK(run.column("reaction base/support y") ==
          Approx(weight - by_block - by_fluid).epsilon(2e-3));
    CHECK(run.column("contact force base y") == Approx(-run.column("contact force block y")));
  }
} // namespace


TEST_CASE("a support bears what lies on it once, in a fluid as without", "[contact]")
{
  const auto water =
    section("Domain", "set Cells = 17, 18") +
    section("Fluid",
            "set Density = 1000\n" + section("Boundaries",
                                             section("top",
                                                     "set Sides = top\nset Kind = pressure\nset "
                                                     "Pressure = 0")));
  const std::string all = "set Kind = clamp", floor = "set Kind = clamp\nset Sides = bottom";
  for (const std::string &integrator : {"trapezoid_bdf2", "theta"})
    for (const std::string &fluid : {std::string(), water})
      for (const std::string &held : {all, floor})
        check_support(integrator, fluid, held);
  for (const std::string &held : {all, floor})
    check_support("generalised_alpha", "", held);
}


TEST_CASE("a body at rest in contact feels the pressure of a fluid at rest", "[contact][mpi]")
{
  const auto viscous = section("viscosity", "set Dynamic viscosity = 1e-4");
  for (const std::string &effects : {std::string(), viscous})
    {
      for (const double dt : {1. / 30, 1. / 120, 1. / 480})
        check_rest<2>(20, dt, effects);
      check_rest<2>(.05, 1. / 120, effects);
      check_rest<3>(20, 1. / 120, effects);
    }
}
