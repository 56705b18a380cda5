// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <coupled/obstacle_run.h>
#include <effects/effect_samples.h>

using namespace undine_tests;

namespace
{
  std::string
  body_force(const std::string &content)
  {
    return section("body force", content);
  }


  std::string
  on_fluid(const std::string &key, const std::string &value)
  {
    return body_force(section("Fluid", "set " + key + " = " + value));
  }


  std::string
  on_block(const std::string &key, const std::string &value)
  {
    return body_force(section("Bodies", section("block", "set " + key + " = " + value)));
  }


  std::string
  with_effects(const std::string &scene, const std::string &effects)
  {
    return scene + section("Effects", effects);
  }


  /// Fluid on which effects act like an even acceleration stays at rest around a ball, and
  /// Archimedes holds for this pressure force: - rho a V, to first order in the width of cells.
  void
  check_even_force(const std::string      &effects,
                   const std::string      &pressure_force,
                   const dealii::Point<2> &acceleration)
  {
    std::vector<double> errors;
    for (const std::string cells : {"12, 10", "48, 40"})
      {
        ObstacleRun<2> run(FluidText{cells, "", "", "", 3.},
                           obstacle("knob", "ball", "set Centre = 0.52, 0.47\nset Radius = 0.2"),
                           effects,
                           0.1);
        for (unsigned int n = 0; n < 3; ++n)
          run.step();
        CHECK(largest_on_faces(run.state.fluid.velocity,
                               [](const double value, const auto &, const unsigned int) {
                                 return std::abs(value);
                               }) < 1e-8);
        const double volume = body_volumes(run.surface(), run.positions())[0];
        errors.push_back(
          (run.column_vector(pressure_force + " knob") / (-3 * volume) - acceleration).norm());
      }
    CHECK(errors[0] < 0.3);
    CHECK(errors[1] < errors[0] / 3);
  }
} // namespace


TEST_CASE("a force that has a potential is carried by the pressure, also around obstacles",
          "[body_force][mpi]")
{
  check_even_force(on_fluid("Acceleration", "2; -1"), "pressure force", {2, -1});
}


TEST_CASE("evenly warm fluid stays at rest, also around obstacles", "[body_force][buoyancy][mpi]")
{
  check_even_force(
    section("gravity", "set Acceleration = 0, -10") +
      section("scalar transport", section("heat", "set Initial value = 2")) +
      section("buoyancy",
              section("heat", "set Expansion coefficient = 0.1\nset Reference value = 1")),
    "reduced pressure force",
    {0, 1});
}


TEST_CASE("a force that changes with time gives its impulse", "[body_force][mpi]")
{
  for (const std::string key : {"Acceleration", "Force per volume"})
    {
      FlowRun<3> run(FluidText{"4, 5, 3",
                               boundary("around", every_side<3>(), "periodic"),
                               "",
                               "",
                               key == "Acceleration" ? 7. : 1.},
                     on_fluid(key, "2*t; 0; -t"));
      run.run(10, 0.1);
      // Taken at the ends of steps: sum of h f(t_k).
      const double impulse = 0.1 * 0.1 * 55;
      for (const auto &[axis, factor] : {std::pair{0u, 2.}, std::pair{1u, 0.}, std::pair{2u, -1.}})
        CHECK(largest_error(run.state.velocity[axis],
                            [&](const auto &) { return factor * impulse; }) < 1e-12);
    }
}


TEST_CASE("an acceleration of a body is what gravity does", "[body_force][mpi]")
{
  SampleRun falls(with_effects(flying_block(), section("gravity", "set Acceleration = 1, -10")));
  SampleRun pulled(with_effects(flying_block(), on_block("Acceleration", "1; -10")));
  SampleRun pushed(with_effects(flying_block(), on_block("Force per volume", "0.5; -5")));
  for (unsigned int n = 0; n < 5; ++n)
    for (auto *run : {&falls, &pulled, &pushed})
      run->step();
  for (auto *run : {&pulled, &pushed})
    {
      for (const auto &column : {"centre of mass block x", "centre of mass block y", "energy gain"})
        CHECK(run->column(column) == Approx(falls.column(column)).epsilon(1e-9));
      CHECK(run->column("energy by body force") ==
            Approx(falls.column("energy by gravity")).epsilon(1e-9));
      CHECK(run->column("energy by loads") ==
            Approx(run->column("energy by body force")).epsilon(1e-9));
      CHECK(run->column("energy closure") < 1e-10);
    }
}


TEST_CASE("a force turns a body by its moment about the place at rest", "[body_force]")
{
  // f = rho W (-Y, X) about the centre: angular acceleration W.
  SampleRun run(with_effects(sample_steps(0.01) +
                               section("Bodies",
                                       section("block",
                                               "set Shape = box\nset Lower corner = 0, 0\n"
                                               "set Upper corner = 1, 1\nset Cells = 2, 2\n"
                                               "set Density = 0.5\nset Material = neo-Hookean\n"
                                               "set Young's modulus = 1e4\n"
                                               "set Poisson's ratio = 0.3")),
                             on_block("Acceleration", "-4*(y-0.5); 4*(x-0.5)")));
  for (unsigned int n = 0; n < 10; ++n)
    run.step();
  // Spin: the speed of a corner, at the distance 1/sqrt(2).
  CHECK(run.column("max speed block") == Approx(4 * 0.1 / std::sqrt(2.)).epsilon(0.02));
  CHECK(run.column("energy by body force") > 0);
}


TEST_CASE("body forces that contradict the scene are refused with a hint", "[body_force]")
{
  const auto complaint = [](const std::string &scene, const std::string &effect) {
    return message_of([&] { SampleRun run(with_effects(scene, effect)); });
  };
  using Catch::Matchers::Contains;
  CHECK_THAT(complaint(flying_block(), body_force("")), Contains("names nothing"));
  CHECK_THAT(complaint(flying_block(), on_fluid("Acceleration", "1; 0")), Contains("has none"));
  CHECK_THAT(complaint(open_column(), on_block("Acceleration", "1; 0")),
             Contains("no body of this name"));
  CHECK_THAT(complaint(flying_block(),
                       body_force(section("Bodies", section("brick", "set Acceleration = 1; 0")))),
             Contains("no body of this name") && Contains("'block'"));
  CHECK_THAT(complaint(open_column(), on_fluid("Acceleration", "0; 0")), Contains("zero"));
  CHECK_THAT(
    complaint(open_column(), on_fluid("Acceleration", "1; 0\nset Force per volume = 1; 0")),
    Contains("'Force per volume'") && Contains("Keep one"));
  CHECK_THAT(complaint(drop_of_particles(
                         section("Domain", "set Lower corner = 0, 0\nset Upper corner = 1, 1") +
                         section("Fluid", "set Density = 1")),
                       on_fluid("Acceleration", "1; 0")),
             Contains("body force") && Contains("particles do not know forces"));
  CHECK_THAT(complaint(open_column(), section("vorticity confinement", "set Strength = 1")),
             Contains("convection") && Contains("Remove"));
}
