// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A stream past a block, in which a bar is held, or to which it is fixed (`left` = 0.4: where
  /// the block ends).
  template <int dim>
  std::string
  block_and_bar(const double left, const std::string &more = "")
  {
    const auto in_box = [&](const char *plane, const char *space) {
      return fmt::format(plane_or_space<dim>(plane, space), left);
    };
    return steps_of(.01) +
           section("Domain",
                   plane_or_space<dim>("set Upper corner = 1, 1\nset Cells = 26, 26",
                                       "set Upper corner = 1, 1, 1\nset Cells = 13, 13, 13")) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries",
                             boundary("in",
                                      "left",
                                      "inflow",
                                      plane_or_space<dim>("set Velocity = .1*t; 0",
                                                          "set Velocity = .1*t; 0; 0")) +
                               boundary("out", "right", "outflow"))) +
           section("Obstacles",
                   section("block",
                           plane_or_space<dim>("set Shape = box\nset Lower corner = .2, .3\n"
                                               "set Upper corner = .4, .67\nset Refinements = 0",
                                               "set Shape = box\nset Lower corner = .2, .3, .3\n"
                                               "set Upper corner = .4, .67, .67\n"
                                               "set Refinements = 0"))) +
           section("Bodies",
                   body("bar",
                        in_box("set Lower corner = {}, .46\nset Upper corner = .7, .57\n"
                               "set Cells = 6, 2",
                               "set Lower corner = {}, .44, .43\nset Upper corner = .7, .57, .54\n"
                               "set Cells = 6, 1, 1") +
                          "\nset Density = 1100\nset Young's modulus = 1e12\nset Poisson's ratio = "
                          ".3",
                        clamp("end", ".4001 - x"))) +
           more;
  }


  /// The force on both: what is the bar's depends on where it ends.
  template <int dim>
  double
  force(const CoupledRun<dim> &run)
  {
    return run.column("pressure force block x") + run.column("pressure force bar x");
  }


  template <int dim>
  void
  compare()
  {
    CoupledRun<dim> held(block_and_bar<dim>(.35)), fixed(block_and_bar<dim>(.4));
    for (unsigned int n = 0; n < 3; ++n)
      {
        held.step();
        fixed.step();
        CHECK(held.column("Flagged cells") == 0);
        CHECK(held.report.warnings.empty());
      }
    CHECK(std::abs(force(held)) > 1);
    CHECK(force(held) == Approx(force(fixed)).epsilon(1e-6));
    CHECK(held.column("Fluid kinetic energy") ==
          Approx(fixed.column("Fluid kinetic energy")).epsilon(1e-9));
  }
} // namespace


TEST_CASE("What an obstacle holds makes one body with it", "[coupled][mpi]")
{
  SECTION("2D")
  {
    compare<2>();
  }
  SECTION("3D")
  {
    compare<3>();
  }
}


TEST_CASE("A flag in a cylinder that moves loses no force and no energy", "[coupled]")
{
  CoupledRun<2> run(
    steps_of(1. / 50) + section("Output", "set Budget = true") +
    section("Domain", "set Upper corner = 1.2, .82\nset Cells = 36, 25") +
    section("Fluid",
            "set Density = 1000\n" +
              section("Boundaries",
                      boundary("in", "left", "inflow", "set Velocity = 1 - exp(-20*t); 0") +
                        boundary("out", "right", "outflow"))) +
    section("Obstacles",
            section("cylinder", "set Shape = ball\nset Centre = .3, .4\nset Radius = .1")) +
    section("Bodies",
            body("flag",
                 "set Lower corner = .37, .383\nset Upper corner = .9, .423\nset Cells = 30, 2\n"
                 "set Density = 1500\nset Young's modulus = 3e6\nset Poisson's ratio = .4",
                 clamp("in", ".3925 - x"))) +
    section("Effects", section("gravity", "set Acceleration = 0, -2")));
  for (unsigned int n = 0; n < 10; ++n)
    {
      run.step();
      CHECK(run.column("Flagged cells") == 0);
      CHECK(run.report.warnings.empty());
      CHECK(run.column("energy closure") <= 1e-7);
      CHECK(run.column("momentum closure") <= 1e-7);
    }
}
