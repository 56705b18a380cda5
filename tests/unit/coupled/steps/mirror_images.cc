// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A disc or ball sets out at once along the x axis, by half a cell in a step, so that it clears
  /// faces of the grid; `cells` across.
  template <int dim>
  CoupledRun<dim>
  body_that_sets_out(const int cells, const std::string &effects)
  {
    return CoupledRun<dim>(
      steps_of(1. / 30) +
      section("Domain",
              fmt::format(plane_or_space<dim>(
                            "set Lower corner = -.5, -.25\nset Upper corner = .5, .25\n"
                            "set Cells = 15, {0}",
                            "set Lower corner = -.5, -.25, -.25\nset Upper corner = .5, .25, .25\n"
                            "set Cells = 15, {0}, {0}"),
                          cells)) +
      section("Fluid", "set Density = 1000") +
      section("Bodies",
              section("ball",
                      plane_or_space<dim>("set Shape = ball\nset Centre = -.17, 0\n"
                                          "set Initial velocity = 1; 0\n",
                                          "set Shape = ball\nset Centre = -.17, 0, 0\n"
                                          "set Initial velocity = 1; 0; 0\n") +
                        "set Radius = .1\nset Density = 1000\nset Young's modulus = 1e5\n"
                        "set Poisson's ratio = .4")) +
      section("Effects", effects));
  }


  /// Its mirror image in the plane y = 0 moves in the same way: no force acts across in these
  /// steps.
  template <int dim>
  void
  check_mirror_image(const int cells, const unsigned int n_steps, const std::string &effects)
  {
    INFO(dim << "D, " << cells << " cells, " << effects);
    auto run = body_that_sets_out<dim>(cells, effects);
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        const double along = std::abs(run.column("pressure force ball x"));
        CHECK(along > 0);
        CHECK(std::abs(run.column("pressure force ball y")) <= 1e-5 * along);
      }
  }
} // namespace


TEST_CASE("A body that sets out along an axis of symmetry stays on it", "[coupled]")
{
  const auto viscous = section("viscosity", "set Dynamic viscosity = 1");
  for (const int cells : {7, 8})
    {
      check_mirror_image<2>(cells, 3, "");
      check_mirror_image<2>(cells, 3, viscous);
      check_mirror_image<2>(cells, 3, section("convection", "") + viscous);
    }
  check_mirror_image<3>(7, 3, "");
}
