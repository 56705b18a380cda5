// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>
#include <coupled/friction/viscous_flows.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A stiff ball of radius .2 that turns at 1 rad/s around an axis along z, in a box on whose
  /// sides the fluid turns at `speed` [rad/s], which may depend on the place.
  template <int dim>
  CoupledRun<dim>
  turning_ball(const unsigned int n,
               const std::string &speed,
               const double       density,
               const double       viscosity_of_fluid,
               const double       dt)
  {
    const auto turning = [](const std::string &factor) {
      return "-" + factor + "*(y-.5);" + factor + "*(x-.5)" + plane_or_space<dim>("", "; 0");
    };
    return CoupledRun<dim>(
      steps_of(dt) + given_on_all_sides<dim>(n, 1, turning(speed)) +
      section("Bodies",
              body("ball",
                   fmt::format("set Shape = ball\nset Centre = {}\nset Radius = .2\nset "
                               "Refinements = {}\nset Density = {}\nset Young's modulus = {}\n"
                               "set Poisson's ratio = .3\nset Initial velocity = {}",
                               plane_or_space<dim>(".5, .5", ".5, .5, .5"),
                               dim == 2 ? 3 : 1,
                               density,
                               1e4 * density,
                               turning("1")))) +
      section("Effects", viscosity(viscosity_of_fluid)));
  }


  /// The angular momentum around the axis [kg m^2/s].
  template <int dim>
  double
  spin(const CoupledRun<dim> &run)
  {
    const auto &solid = run.state.solid;
    return angular_momentum(*run.models.solid, solid.displacement, solid.velocity)[2];
  }


  /// What multiplies the angular momentum in 0.06 s.
  template <int dim>
  double
  factor(const unsigned int n)
  {
    auto         run    = turning_ball<dim>(n, "1", 100, 10, .02);
    const double before = spin(run);
    for (unsigned int k = 0; k < 3; ++k)
      run.step();
    return spin(run) / before;
  }
} // namespace


TEST_CASE("A body that turns with the fluid goes on turning", "[friction]")
{
  // With the friction mu dv/dn alone its speed would be multiplied by 1.8 (disc) and 2.1 (ball).
  // The ball is three cells across.
  CHECK(factor<2>(20) == Approx(1).epsilon(.02));
  CHECK(factor<3>(8) == Approx(1).epsilon(.25));
}


TEST_CASE("The moment on a turning disc is that of the whole stress", "[friction]")
{
  // 4 pi mu R^2 w in an infinite fluid, which slows the disc down at the rate 8 mu / (rho R^2).
  const double density = 1e3, viscosity = 10, dt = .001;
  double       errors[2];
  for (const unsigned int level : {0, 1})
    {
      auto run = turning_ball<2>(
        level == 0 ? 20 : 40, "(.04/max(1e-3,(x-.5)^2+(y-.5)^2))", density, viscosity, dt);
      run.step();
      const double before = spin(run);
      for (unsigned int k = 0; k < 4; ++k)
        run.step();
      const double rate = std::log(before / spin(run)) / (4 * dt);
      errors[level]     = std::abs(rate / (8 * viscosity / (density * .04)) - 1);
      INFO(level << ": " << rate << " " << errors[level]);
      CHECK(errors[level] <= .05);
    }
  CHECK(errors[1] < errors[0]);
}
