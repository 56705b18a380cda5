// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/solid/time/time_integrator.h>

#include <catch2/catch.hpp>

#include <array>
#include <complex>

using namespace undine_tests;

namespace
{
  using Complex  = std::complex<double>;
  using Values   = std::array<double, 3>; // d, u, a
  using Columns3 = std::array<Values, 3>;

  /// An oscillator of unit mass and stiffness after a stage.
  Values
  end_of_stage(const StageCoefficients &step, const Values &old)
  {
    const double known =
      step.displacement_velocity * old[1] + step.displacement_acceleration * old[2];
    double matrix = step.mass;
    double right  = -step.mass_old_velocity * old[1] - step.mass_old_acceleration * old[2];
    for (const auto &level : step.levels)
      {
        matrix += level.weight * level.position * step.displacement;
        right -= level.weight * (old[0] + level.position * known);
      }
    const double u = right / matrix;
    return {{old[0] + known + step.displacement * u,
             u,
             step.acceleration * u + step.acceleration_velocity * old[1] +
               step.acceleration_acceleration * old[2]}};
  }


  Values
  gone_on(const Values &start, const double length, const Values &rates)
  {
    return {{start[0] + length * rates[1], start[1] + length * rates[2], start[2]}};
  }


  /// After a step from each of the unit states.
  Columns3
  amplification(const TimeIntegrator &integrator, const double h)
  {
    Columns3 result;
    for (unsigned int column = 0; column < 3; ++column)
      {
        Values old{};
        old[column] = 1;
        Values now = old, next = old;
        for (const auto &stage : integrator.stages(h, RatesAtBegin::known))
          {
            const auto start =
              stage.is_first ? gone_on(now, stage.keeps_rates ? stage.rate() : 0, now) : next;
            next = gone_on(now, stage.next_old.length, now);
            now  = end_of_stage(integrator.coefficients(stage.length), start);
            next = gone_on(next, stage.next_new.length, now);
          }
        result[column] = now;
      }
    return result;
  }


  Complex
  characteristic(const Columns3 &A, const Complex &z)
  {
    const auto entry = [&](const int i, const int j) { return A[j][i] - (i == j ? z : 0.); };
    Complex    sum   = 0;
    for (int j = 0; j < 3; ++j)
      sum += entry(0, j) * (entry(1, (j + 1) % 3) * entry(2, (j + 2) % 3) -
                            entry(1, (j + 2) % 3) * entry(2, (j + 1) % 3));
    return sum;
  }


  /// The eigenvalue next to exp(i h), by the secant method.
  Complex
  eigenvalue(const Columns3 &A, const double h)
  {
    Complex z0 = std::exp(Complex(0, h)), z1 = z0 * (1. + h * h * h);
    Complex f0 = characteristic(A, z0);
    for (int n = 0; n < 50 && std::abs(z1 - z0) > 1e-15; ++n)
      {
        const Complex f1 = characteristic(A, z1);
        if (f1 == f0)
          break;
        const Complex z2 = z1 - f1 * (z1 - z0) / (f1 - f0);
        z0               = z1;
        f0               = f1;
        z1               = z2;
      }
    return z1;
  }
} // namespace


TEST_CASE("integrators state the error of a free oscillation", "[solid]")
{
  for (const auto &choice : {"newmark",
                             "newmark\nset Gamma = 0.7",
                             "newmark\nset Gamma = 1",
                             "theta\nset Theta = 0.5",
                             "theta",
                             "theta\nset Theta = 1",
                             "generalised_alpha",
                             "generalised_alpha\nset Spectral radius = 0",
                             "generalised_alpha\nset Spectral radius = 1",
                             "trapezoid_bdf2"})
    {
      const auto options =
        read_scene_text(std::string("subsection Time\nset Integrator = ") + choice + "\nend\n");
      const auto   integrator = choose_time_integrator(options);
      const auto   accuracy   = integrator->accuracy();
      const double h          = 0.01;
      const auto   z          = eigenvalue(amplification(*integrator, h), h);
      const double error      = std::abs(std::log(z) / Complex(0, h) - 1.);
      INFO(choice);
      CHECK(error == Approx(accuracy.constant * std::pow(h, accuracy.order)).epsilon(0.05));
    }
}
