// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/scalar_samples.h>

#include <complex>

using namespace undine_tests;

namespace
{
  constexpr double frequency = 20; // [rad/s]


  template <int dim>
  std::string
  row_of_cells(const unsigned int n)
  {
    return dim == 2 ? fmt::format("{}, 3", n) : fmt::format("{}, 3, 2", n);
  }


  /// The periodic solution between walls at 0 and 1 with the value cos(frequency t), diffusivity 1:
  /// the real part of cosh(k (x - 1/2)) / cosh(k / 2) exp(i frequency t), k^2 = i frequency.
  std::complex<double>
  wave(const double x, const double time)
  {
    const auto k = std::sqrt(std::complex<double>(0, frequency));
    return std::cosh(k * (x - .5)) / std::cosh(k / 2.) * std::polar(1., frequency * time);
  }


  /// Its value at the time 0, for a scene: (a + i b) / (A + i B) with the parts of both cosines.
  std::string
  initial_wave()
  {
    const double k    = std::sqrt(frequency / 2);
    const auto   half = std::cosh(std::complex<double>(k / 2, k / 2));
    const auto   x    = fmt::format("({:.17g}*(x-.5))", k);
    return fmt::format("(cosh{0}*cos{0}*({1:.17g}) + sinh{0}*sin{0}*({2:.17g}))/{3:.17g}",
                       x,
                       half.real(),
                       half.imag(),
                       std::norm(half));
  }


  /// After .4 s in steps of dt.
  template <int dim>
  double
  error_with(const unsigned int n, const double dt)
  {
    FlowRun<dim> run(
      FluidText{row_of_cells<dim>(n), boundary("walls", "left, right", "slip wall")},
      smoke_by_fluxes(
        "set Diffusivity = 1\nset Dirichlet boundaries = walls\nset Initial value = " +
        initial_wave() + fmt::format("\nset Dirichlet value = cos({}*t)", frequency)));
    run.run(std::lround(.4 / dt), dt);
    return largest_error(run.state.scalars.at("smoke"),
                         [&](const auto &place) { return wave(place[0], run.time).real(); });
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Heat from walls whose value swings is conducted with second order in time, "
                       "however long a step is for the cells",
                       "[scalars][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const unsigned int n : {128, 256}) // D dt / dx^2 up to 1300
    {
      const double coarse = error_with<dim>(n, .02), fine = error_with<dim>(n, .01);
      INFO(fmt::format("{} cells: {:.3e} {:.3e}", n, coarse, fine));
      CHECK(coarse < .002);
      CHECK(std::log2(coarse / fine) >= 1.8);
    }
}


TEMPLATE_TEST_CASE_SIG(
  "A jump that diffuses keeps its bounds and its amount in steps of any length",
  "[scalars][mpi]",
  ((int dim), dim),
  2,
  3)
{
  for (const double dt : {1e-4, 1e-3, 1e-2, 1e-1})
    {
      FlowRun<dim> run(FluidText{row_of_cells<dim>(50), "", "", "set Grading x = x^1.5"},
                       smoke_by_fluxes("set Diffusivity = 1\nset Initial value = if(x<.3, 3, 1)"));
      const auto  &smoke  = run.state.scalars.at("smoke");
      const double amount = integral(run.model, smoke);
      for (unsigned int n = 0; n < 10; ++n)
        {
          run.step(dt);
          const auto [least, most] = range_of(smoke);
          INFO(fmt::format("step {} of {} s: {} to {}", n, dt, least, most));
          CHECK(least >= 1 - 1e-12);
          CHECK(most <= 3 + 1e-12);
          CHECK(std::abs(integral(run.model, smoke) - amount) < 1e-10 * amount);
        }
    }
}
