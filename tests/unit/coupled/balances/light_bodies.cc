// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <algorithm>

using namespace undine_tests;

namespace
{
  constexpr double gravity = 9.81; // [m/s^2]
  constexpr double water   = 1000; // [kg/m^dim]


  struct Block
  {
    double      density; ///< [kg/m^dim]
    std::string step;    ///< [s]
    std::string cells;
    std::string effects = "";
    double      modulus = 1e5; ///< [Pa]
    std::string shape   = "";  ///< in the place of the box
  };


  /// A block that rises from rest in a tank of one metre that is open at the top. Elements are
  /// linear: the outline that the fluid meets is that of the elements.
  template <int dim>
  std::string
  tank(const Block &block)
  {
    return section("Time", "set Step = " + block.step) +
           section("Domain", "set Cells = " + block.cells) +
           section("Fluid",
                   fmt::format("set Density = {}\n", water) +
                     section("Boundaries",
                             boundary("surface", "top", "pressure", "set Pressure = 9810"))) +
           section(
             "Bodies",
             body("block",
                  (block.shape.empty()
                     ? plane_or_space<dim>("set Lower corner = .3, .1\nset Upper corner = .7, .3\n"
                                           "set Cells = 8, 4\n",
                                           "set Lower corner = .3, .1, .3\n"
                                           "set Upper corner = .7, .3, .7\nset Cells = 3, 2, 3\n")
                     : block.shape) +
                    fmt::format("set Density = {}\nset Young's modulus = {}\n"
                                "set Poisson's ratio = .3",
                                block.density,
                                block.modulus))) +
           section("Solid numerics", "set Element degree = 1") +
           section("Effects",
                   section("gravity",
                           plane_or_space<dim>("set Acceleration = 0, -9.81",
                                               "set Acceleration = 0, -9.81, 0")) +
                     block.effects);
  }


  struct Rise
  {
    double       gain         = 0; ///< energy beyond the work that was done, over the largest work
    unsigned int steps        = 0;
    unsigned int steps_redone = 0; ///< for what they created
    unsigned int cuts         = 0; ///< of steps, for whatever reason
  };


  /// The largest energy of fluid and block beyond the work that was done until then, over the
  /// largest work; and how many steps were redone for what they create. Energy and work are
  /// functions of the state: the work of gravity and of the air is what it takes to bring the
  /// block's volume from the water's surface to its depth, less what the block gains in height.
  template <int dim>
  Rise
  rise(const Block &block, const double end)
  {
    INFO(block.density << " kg/m^dim, " << block.step << " s " << block.effects);
    CoupledRun<dim> run(tank<dim>(block));
    const double    volume = run.column("volume block");
    const auto      depth  = [&] {
      return run.column("volume block") * (1 - run.column("centre of mass block y"));
    };
    const double first_depth = depth(), first_height = run.column("centre of mass block y");
    double       excess = 0, largest = 0;
    Rise         result;
    while (run.state.clock.time < end)
      {
        run.step(); // cut where bodies shake by more than the grid can follow
        ++result.steps;
        result.steps_redone += run.report.creations.number;
        result.cuts += run.report.cuts;
        const double work =
          water * gravity * (first_depth - depth()) -
          block.density * volume * gravity * (run.column("centre of mass block y") - first_height);
        const double energy = run.column("Fluid kinetic energy") +
                              run.column("solid kinetic energy") +
                              run.column("solid elastic energy");
        excess  = std::max(excess, energy - work);
        largest = std::max(largest, work);
      }
    CHECK(largest > 0);
    result.gain = excess / largest;
    return result;
  }


  template <int dim>
  double
  energy_from_nothing(const Block &block, const double end)
  {
    return rise<dim>(block, end).gain;
  }
} // namespace


TEST_CASE("Light blocks that rise gain no more energy than gravity puts in", "[coupled]")
{
  SECTION("2D, steps")
  {
    for (const std::string step : {"1/15", "1/60", "1/240"})
      CHECK(energy_from_nothing<2>({1, step, "20, 20"}, .7) <= .01);
  }
  SECTION("2D, densities and grids")
  {
    CHECK(energy_from_nothing<2>({10, "1/60", "24, 24"}, .7) <= .01);
    CHECK(energy_from_nothing<2>({100, "1/60", "32, 32"}, .7) <= .01);
    CHECK(energy_from_nothing<2>({1, "1/60", "32, 32"}, .7) <= .01);
  }
  SECTION("2D, with convection")
  {
    CHECK(energy_from_nothing<2>({1, "1/60", "20, 20", convection()}, .7) <= .01);
    CHECK(energy_from_nothing<2>({1, "1/240", "20, 20", convection()}, .5) <= .01);
  }
  SECTION("3D")
  {
    CHECK(energy_from_nothing<3>({1, "1/240", "8, 8, 8"}, .2) <= .05);
  }
}


TEST_CASE("What a light body loses and gains in turns while it vibrates makes no step shorter",
          "[coupled]")
{
  const std::string disc = "set Shape = ball\nset Centre = .5, .22\nset Radius = .12\n"
                           "set Refinements = 2\n";
  for (const std::string step : {"1/60", "1/120"})
    {
      const auto of_disc = rise<2>({100, step, "32, 32", "", 1e5, disc}, .4);
      INFO(of_disc.steps_redone << " of " << of_disc.steps << " steps were redone");
      CHECK(of_disc.steps_redone <= .01 * of_disc.steps);
      CHECK(of_disc.gain <= .01);
    }
}


TEST_CASE("Light soft bodies are placed in long steps, whatever the level of the pressure",
          "[coupled]")
{
  for (const double density : {1., 100.})
    for (const std::string step : {"1/15", "1/30"})
      {
        const auto of_block = rise<2>({density, step, "32, 32"}, .4);
        CHECK(of_block.cuts == 0);
        CHECK(of_block.gain <= .01);
      }
}
