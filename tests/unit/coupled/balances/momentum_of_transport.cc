// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <array>
#include <cmath>

using namespace undine_tests;

namespace
{
  /// A box that repeats in all directions, so that momentum neither enters nor leaves, with n cells
  /// a side and steps that shrink with them.
  template <int dim>
  std::string
  closed_box(const unsigned int n, const double courant_number, const std::string &velocity)
  {
    return steps_of(courant_number / n) +
           section("Domain",
                   fmt::format(
                     plane_or_space<dim>("set Cells = {0}, {0}", "set Cells = {0}, {0}, {0}"), n)) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " + velocity + "\n" +
                     section("Boundaries", boundary("around", every_side<dim>(), "periodic"))) +
           section("Effects", convection()) + section("Output", "set Budget = true");
  }


  /// Vortices of several sizes that a wind carries on; no symmetry balances their momentum.
  template <int dim>
  std::string
  vortices()
  {
    const std::string x = ".5 + cos(2*pi*y) + .6*cos(2*pi*(x+y)) + .3*sin(2*pi*(2*x-y))";
    const std::string y = ".3 - .6*cos(2*pi*(x+y)) + .6*sin(2*pi*(2*x-y))";
    return x + "; " + y + plane_or_space<dim>("", "; .2 + .5*sin(2*pi*(x-y))");
  }


  /// A soft ball in a wind.
  std::string
  fixed_ball()
  {
    return section(
      "Bodies",
      body("ball",
           "set Shape = ball\nset Centre = .5, .5\nset Radius = .2\nset Refinements = 2\n"
           "set Density = 2\nset Young's modulus = 20\nset Poisson's ratio = .3"));
  }


  /// What fluid and bodies gain until `end` [kg m/s], which the transport of momentum alone makes.
  template <int dim>
  double
  gain(const std::string &scene, const double end)
  {
    CoupledRun<dim>        run(scene);
    dealii::Tensor<1, dim> sum;
    while (run.state.clock.time < end * (1 - 1e-9))
      {
        run.step();
        for (unsigned int d = 0; d < dim; ++d)
          sum[d] += run.column(std::string("momentum gain ") + "xyz"[d]);
      }
    return sum.norm();
  }


  template <int dim>
  void
  check_decay(const std::string                 &velocity,
              const std::string                 &more,
              const std::array<unsigned int, 3> &cells,
              const double                       order)
  {
    std::array<double, 3> gains;
    for (unsigned int k = 0; k < 3; ++k)
      gains[k] = gain<dim>(closed_box<dim>(cells[k], .4, velocity) + more, .4);
    INFO(fmt::format("{}D: gains {:.3e} {:.3e} {:.3e}", dim, gains[0], gains[1], gains[2]));
    CHECK(std::log(gains[0] / gains[2]) / std::log(double(cells[2]) / cells[0]) >= order);
    CHECK(gains[2] < 2e-3); // the fluid has about 1 kg m/s
  }
} // namespace


TEST_CASE("what transport makes of momentum vanishes with cells and steps", "[coupled]")
{
  SECTION("vortices, 2D")
  {
    check_decay<2>(vortices<2>(), "", {{16, 32, 64}}, 1.8);
  }
  SECTION("vortices, 3D")
  {
    check_decay<3>(vortices<3>(), "", {{16, 23, 32}}, 1.8);
  }
  SECTION("ball, 2D")
  {
    check_decay<2>("1; 0", fixed_ball(), {{16, 32, 64}}, 1.8);
  }
}
