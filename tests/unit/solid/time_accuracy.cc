// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/solid/time/time_integrator.h>

#include <catch2/catch.hpp>

#include <array>
#include <complex>

using namespace undine_tests;

namespace
{
  using Complex = std::complex<double>;
  using Values  = std::array<double, 4>; // d, u, a and the mean velocity
  using Columns = std::array<Values, 4>;

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
               step.acceleration_acceleration * old[2],
             u}};
  }


  Values
  end_of_stage(const TimeIntegrator &integrator, const Stage &stage, const Values &begin)
  {
    auto start = begin;
    start[0] += stage.going_on() * begin[3];
    start[1] += stage.going_on() * begin[2];
    auto result = end_of_stage(integrator.coefficients(stage.length), start);
    if (stage.kept == KeptRate::mean)
      for (const unsigned int rate : {2, 3})
        result[rate] =
          (stage.length * result[rate] + stage.going_on() * begin[rate]) / stage.duration();
    return result;
  }


  /// After a step from each of the unit states.
  Columns
  amplification(const TimeIntegrator &integrator, const double h)
  {
    Columns result{};
    for (unsigned int column = 0; column < result.size(); ++column)
      {
        result[column][column] = 1;
        for (const auto &stage : integrator.stages(h, RatesAtBegin::known))
          result[column] = end_of_stage(integrator, stage, result[column]);
      }
    return result;
  }


  Complex
  characteristic(const Columns &A, const Complex &z)
  {
    dealii::Tensor<2, 4, Complex> matrix;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        matrix[i][j] = A[j][i] - (i == j ? z : 0.);
    return determinant(matrix);
  }


  /// The eigenvalue next to exp(i h), by the secant method.
  Complex
  eigenvalue(const Columns &A, const double h)
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
