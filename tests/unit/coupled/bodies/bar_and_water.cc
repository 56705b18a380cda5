// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double length_of_bar = .5, column = .8, modulus_of_bar = 2e5;

  /// lambda of the first mode, by bisection.
  double
  exact_wave_number(const double density)
  {
    const double ratio = density * length_of_bar / (1000 * column);
    double       lower = 0, upper = M_PI / 2;
    for (unsigned int n = 0; n < 60; ++n)
      {
        const double middle                                 = (lower + upper) / 2;
        (middle * std::tan(middle) < ratio ? lower : upper) = middle;
      }
    return lower;
  }


  /// [1/s]
  double
  exact_frequency(const double density)
  {
    return exact_wave_number(density) * std::sqrt(modulus_of_bar / density) / length_of_bar;
  }


  /// An elastic bar, held at its left end, closes a channel of water that is open on the right. Bar
  /// and water move along x only: without Poisson's effect the water is a mass at the bar's end,
  ///
  ///     lambda tan lambda = rho_s L / (rho_f L_f),    omega = lambda (E / rho_s)^1/2 / L.
  ///
  /// It starts in the shape of the first mode, sin(lambda x / L).
  template <int dim>
  std::string
  bar_and_water(const double       density,
                const double       dt,
                const std::string &integrator,
                const unsigned int degree = 1)
  {
    const auto slides = [](const std::string &axis) {
      return clamp("slides_" + axis, "1", "set Components = " + axis);
    };
    const double height = .2;
    const auto   end    = length_of_bar + column;
    return steps_of(dt) +
           section("Domain",
                   fmt::format(plane_or_space<dim>("set Lower corner = .3, 0\nset Upper corner = "
                                                   "{0}, {1}\nset Cells = 20, 4",
                                                   "set Lower corner = .3, 0, 0\nset Upper corner "
                                                   "= {0}, {1}, {1}\nset Cells = 20, 3, 3"),
                               end,
                               height)) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries", boundary("out", "right", "outflow"))) +
           section("Bodies",
                   body("bar",
                        fmt::format(plane_or_space<dim>("set Lower corner = 0, 0\nset Upper corner "
                                                        "= {0}, {1}\nset Cells = 30, 1",
                                                        "set Lower corner = 0, 0, 0\nset Upper "
                                                        "corner = {0}, {1}, {1}\nset Cells = 30, "
                                                        "3, 3"),
                                    length_of_bar,
                                    height) +
                          fmt::format("\nset Density = {}\nset Young's modulus = {}\nset "
                                      "Poisson's ratio = 0\nset Material = linear elastic\nset "
                                      "Initial displacement = 1e-4*sin({}*x){}",
                                      density,
                                      modulus_of_bar,
                                      exact_wave_number(density) / length_of_bar,
                                      plane_or_space<dim>(";0", ";0;0")),
                        clamp("wall", "1", "set Sides = left") + slides("y") +
                          plane_or_space<dim>("", slides("z")))) +
           section("Solid numerics", fmt::format("set Element degree = {}", degree)) +
           section("Time", integrator);
  }


  /// From the times at which the bar's centre passes its place at rest.
  template <int dim>
  double
  measured_frequency(const double       density,
                     const double       dt,
                     const std::string &integrator,
                     const unsigned int degree)
  {
    CoupledRun<dim>     run(bar_and_water<dim>(density, dt, integrator, degree));
    std::vector<double> passages;
    double              before = run.column("centre of mass bar x") - length_of_bar / 2;
    for (unsigned int n = 0; n < 1000 && passages.size() < 5; ++n)
      {
        run.step();
        const double now = run.column("centre of mass bar x") - length_of_bar / 2;
        if (before * now < 0)
          passages.push_back(run.state.clock.time - run.report.dt * now / (now - before));
        before = now;
      }
    REQUIRE(passages.size() == 5);
    return 4 * M_PI / (passages.back() - passages.front());
  }


  template <int dim>
  void
  check_frequency(const double density, const unsigned int degree)
  {
    const double      exact      = exact_frequency(density);
    const std::string trapezoid  = "set Integrator = newmark\nset Gamma = 0.5";
    const double      fine_steps = 2 * M_PI / exact / 80, coarse_steps = 2 * fine_steps;
    const double      coarse =
      measured_frequency<dim>(density, coarse_steps, trapezoid, degree) / exact - 1;
    const double fine = measured_frequency<dim>(density, fine_steps, trapezoid, degree) / exact - 1;
    INFO(
      fmt::format("{}D, degree {}, density {}: {:.2e} {:.2e}", dim, degree, density, coarse, fine));
    CHECK(std::abs(coarse) < .01);
    CHECK(std::abs(fine) < .005);
  }


  /// Damping ratio of the first mode: the logarithm of how much an extreme is less than another,
  /// per angle in between. The extremes are those of the parabola through three steps.
  template <int dim>
  double
  damping_ratio(const double density, const double dt, const std::string &integrator)
  {
    CoupledRun<dim>       run(bar_and_water<dim>(density, dt, integrator));
    std::vector<double>   extremes;
    std::array<double, 3> last{};
    for (unsigned int n = 0; n < 3000 && extremes.size() < 9; ++n)
      {
        run.step();
        last = {{last[1], last[2], run.column("centre of mass bar x") - length_of_bar / 2}};
        const double slope = (last[2] - last[0]) / 2, bend = last[2] - 2 * last[1] + last[0];
        if (n > 2 && (last[1] - last[0]) * (last[2] - last[1]) <= 0)
          extremes.push_back(std::abs(last[1] - slope * slope / (2 * bend)));
      }
    REQUIRE(extremes.size() == 9);
    return std::log(extremes.front() / extremes.back()) / (8 * M_PI);
  }
} // namespace


TEST_CASE("A bar and a column of water swing with their exact frequency", "[coupled]")
{
  for (const unsigned int degree : {1, 2})
    {
      for (const double density : {8000., 1000., 10.})
        check_frequency<2>(density, degree);
      check_frequency<3>(1000., degree);
    }
}


TEST_CASE("The steps of TR-BDF2 hardly damp what they resolve", "[coupled]")
{
  for (const double density : {8000., 1000., 10.})
    {
      const double dt      = .5 / exact_frequency(density);
      const auto   damping = [&](const double step, const std::string &integrator) {
        return damping_ratio<2>(density, step, "set Integrator = " + integrator);
      };
      const double fine = damping(dt / 16, "trapezoid_bdf2");
      INFO(fmt::format("density {}: {:.2e}", density, fine));
      CHECK(std::abs(damping(dt, "trapezoid_bdf2") - fine) <= std::max(.2 * std::abs(fine), .002));
      CHECK(damping(dt, "theta") > .03);
    }
}
