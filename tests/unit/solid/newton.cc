// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/base/core/newton.h>

#include <deal.II/base/symmetric_tensor.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace undine_tests;

namespace
{
  struct Number
  {
    double value = 0;

    void
    add(const double factor, const Number &other)
    {
      value += factor * other.value;
    }
  };


  /// One equation with one unknown. The linear solver leaves as much as it may, or a part of that.
  struct Scalar
  {
    using Unknown = Number;

    std::function<double(double)> f, derivative;
    double                        rounded   = 1e-15;
    double                        convex    = 0; ///< in the place of the derivative; 0: none
    double                        last      = 0;
    double                        tangent   = 0;
    double                        leaves    = 1; ///< of what it may [1]
    double                        left      = 0;
    double                        most_left = 0, least_left = 1; ///< that was asked for

    double
    evaluate(const Number &x)
    {
      last = f(x.value);
      return std::abs(last);
    }

    Number
    correction(const Number &x, const CorrectionRequest &request)
    {
      if (request.new_tangent)
        tangent = request.tangent == Tangent::convex && convex > 0 ? convex : derivative(x.value);
      left       = leaves * request.reduction;
      most_left  = std::max(most_left, request.reduction);
      least_left = std::min(least_left, request.reduction);
      return {-(1 - left) * last / tangent};
    }

    double
    slope(const Number &change) const
    {
      return last * change.value;
    }

    double
    part_left() const
    {
      return left;
    }

    double
    scale() const
    {
      return 1;
    }

    double
    rounding() const
    {
      return rounded;
    }

    unsigned int
    linear_iterations() const
    {
      return 0;
    }
  };


  struct StiffRodUnknown : dealii::Tensor<1, 3>
  {
    using dealii::Tensor<1, 3>::Tensor;

    explicit StiffRodUnknown(const dealii::Tensor<1, 3> &values)
      : dealii::Tensor<1, 3>(values)
    {
    }

    void
    add(const double factor, const StiffRodUnknown &other)
    {
      *this += factor * other;
    }
  };


  /// The end of a stiff rod around the origin, pulled to an angle by a weak spring, and beside it
  /// 100 atan(x). Its corrections lead upwards, so that there is no descent.
  struct StiffRod
  {
    using Unknown = StiffRodUnknown;

    double                  stiffness, angle;
    dealii::Tensor<1, 3>    residual;
    dealii::Tensor<2, 3>    inverse; ///< of the tangent
    static constexpr double beside = 100;

    double
    evaluate(const Unknown &x)
    {
      const double length  = std::hypot(x[0], x[1]);
      const double tension = stiffness * (length - 1) / length;
      residual[0]          = tension * x[0] + x[0] - std::cos(angle);
      residual[1]          = tension * x[1] + x[1] - std::sin(angle);
      residual[2]          = beside * std::atan(x[2]);
      return residual.norm();
    }

    Unknown
    correction(const Unknown &x, const CorrectionRequest &request)
    {
      if (request.new_tangent)
        inverse = invert(tangent(x));
      Unknown result;
      result.add(-1., Unknown(inverse * residual));
      return result;
    }

    dealii::Tensor<2, 3>
    tangent(const Unknown &x) const
    {
      const double         length = std::hypot(x[0], x[1]);
      dealii::Tensor<2, 3> result;
      for (unsigned int i = 0; i < 2; ++i)
        {
          result[i][i] = 1 + stiffness * (1 - 1 / length);
          for (unsigned int j = 0; j < 2; ++j)
            result[i][j] += stiffness * x[i] * x[j] / std::pow(length, 3);
        }
      result[2][2] = beside / (1 + x[2] * x[2]);
      return result;
    }

    double
    slope(const Unknown &) const
    {
      return 1;
    }

    double
    part_left() const
    {
      return 0;
    }

    double
    scale() const
    {
      return 1;
    }

    double
    rounding() const
    {
      return 1e-12;
    }

    unsigned int
    linear_iterations() const
    {
      return 0;
    }
  };
} // namespace


TEST_CASE("Newton's method cuts corrections that overshoot", "[newton]")
{
  // Full corrections diverge for |x| > 1.39.
  Scalar problem{[](double x) { return std::atan(x); }, [](double x) { return 1 / (1 + x * x); }};
  Number x{20};
  const auto report = solve_newton(problem, x, NewtonOptions());
  CHECK(std::abs(x.value) < 1e-10);
  CHECK(report.cuts > 0);
}


TEST_CASE("Newton's method keeps out of where the equations make no sense", "[newton]")
{
  Scalar problem{[](double x) {
                   if (x <= 0)
                     throw SolveError("x is negative");
                   return std::log(x) + 1;
                 },
                 [](double x) { return 1 / x; }};
  Number x{20};
  solve_newton(problem, x, NewtonOptions());
  CHECK(x.value == Approx(std::exp(-1.)));
}


TEST_CASE("Newton's method comes back from where there is no tangent", "[newton]")
{
  // Full corrections from 2 lead to -3.5.
  Scalar problem{[](double x) { return std::atan(x); },
                 [](double x) {
                   if (std::abs(x) > 3)
                     throw SolveError("no tangent");
                   return 1 / (1 + x * x);
                 }};
  Number x{2};
  solve_newton(problem, x, NewtonOptions());
  CHECK(std::abs(x.value) < 1e-10);
  x.value = 5; // from where there is no way back
  CHECK_THROWS_WITH(solve_newton(problem, x, NewtonOptions()), "no tangent");
}


TEST_CASE("Newton's method says how it failed", "[newton]")
{
  Scalar problem{[](double x) { return x * x + 1; }, [](double x) { return 2 * x; }};
  Number x{3};
  CHECK_THROWS_WITH(solve_newton(problem, x, NewtonOptions()),
                    Catch::Contains("does not converge") && Catch::Contains("residual: 10 "));
  NewtonOptions one;
  one.fixed_iterations = 1;
  x.value              = 3;
  CHECK(solve_newton(problem, x, one).iterations == 1);
  CHECK(x.value == Approx(3 - 10. / 6));
}


TEST_CASE("Newton's method goes down a potential where the residual has a least value", "[newton]")
{
  // |f| has a least value next to x = 0, where f' vanishes; the potential falls from there to x
  // = 2.
  Scalar problem{[](double x) { return (x * x + 0.1) * (x - 2); },
                 [](double x) { return 2 * x * (x - 2) + x * x + 0.1; }};
  problem.convex = 3;
  for (const double start : {-1., -0.1, 0., 0.01, 0.5})
    {
      INFO(start);
      Number     x{start};
      const auto report = solve_newton(problem, x, NewtonOptions());
      CHECK(x.value == Approx(2));
      CHECK(report.residuals.back() <= 1e-10);
    }
  // The last corrections have the exact tangent: the convex one reduces the residual to 0.4.
  Number     x{-1};
  const auto report = solve_newton(problem, x, NewtonOptions());
  const auto n      = report.residuals.size();
  CHECK(report.residuals[n - 1] <= 1e-4 * report.residuals[n - 3]);
  CHECK(report.iterations < 40);
  CHECK(report.tangents == report.iterations);
  // What rounding leaves is accepted.
  Scalar rough  = problem;
  rough.f       = [](double x) { return (x * x + 0.1) * (x - 2) + 3e-8 * std::sin(1e9 * x); };
  rough.rounded = 1e-9;
  x.value       = -1;
  solve_newton(rough, x, NewtonOptions());
  CHECK(x.value == Approx(2));
  // So many corrections are just these.
  NewtonOptions ten;
  ten.fixed_iterations = 10;
  x.value              = -1;
  CHECK(solve_newton(problem, x, ten).iterations == 10);
  // Where nothing is convex the residual still decides.
  Scalar upwards{[](double x) { return -std::atan(x); }, [](double x) { return -1 / (1 + x * x); }};
  x.value = 20;
  solve_newton(upwards, x, NewtonOptions());
  CHECK(std::abs(x.value) < 1e-10);
}


TEST_CASE("Newton's method turns what is stiff, also after it had to halve corrections", "[newton]")
{
  // A stiff rod that a weak spring turns by an angle of 1 or 2, beside a number for which full
  // corrections diverge until they are halved. Any small turn of the rod stretches it.
  for (const double stiffness : {1e3, 1e4})
    for (const double angle : {1., 2.})
      for (const bool has_tangent : {false, true}) // one that leads away
        {
          StiffRod        problem{stiffness, angle, {}, -1. * dealii::unit_symmetric_tensor<3>()};
          StiffRodUnknown x(dealii::Tensor<1, 3>({1, 0, 2}));
          const auto      report = solve_newton(problem, x, NewtonOptions(), has_tangent);
          CAPTURE(stiffness, angle, has_tangent);
          CHECK(report.cuts > 0);
          CHECK(std::abs(x[0] - std::cos(angle)) < 1e-9);
          CHECK(std::abs(x[1] - std::sin(angle)) < 1e-9);
          CHECK(std::abs(x[2]) < 1e-9);
        }
}


TEST_CASE("Newton's method keeps a tangent as long as it serves", "[newton]")
{
  // f' changes by a hundredth where f falls from 1 to 0: one tangent is enough.
  Scalar weak{[](double x) { return x + 0.005 * x * x - 1; },
              [](double x) { return 1 + 0.01 * x; }};
  Number x;
  auto   report = solve_newton(weak, x, NewtonOptions());
  CHECK(std::abs(weak.f(x.value)) <= 1e-10);
  CHECK(report.tangents == 1);
  CHECK(report.iterations > 2);
  // From far away a correction halves the residual at most, and each has a tangent of its own.
  Scalar strong{[](double x) { return x * x * x - 1; }, [](double x) { return 3 * x * x; }};
  x.value = 100;
  report  = solve_newton(strong, x, NewtonOptions());
  CHECK(x.value == Approx(1).epsilon(1e-9));
  CHECK(report.tangents > 10);
  CHECK(report.tangents < report.iterations);
  // A given number of corrections has as many tangents.
  NewtonOptions four;
  four.fixed_iterations = 4;
  x.value               = 0;
  CHECK(solve_newton(weak, x, four).tangents == 4);
}


TEST_CASE("Newton's method keeps a new tangent where equations look linear", "[newton]")
{
  Scalar     problem{[](double x) { return x + 0.005 * x * x - 1; },
                 [](double x) { return 1 + 0.01 * x; }};
  const auto tangents = [&](const double leaves) {
    problem.leaves = leaves;
    Number     x;
    const auto report = solve_newton(problem, x, NewtonOptions());
    CHECK(std::abs(problem.f(x.value)) <= 1e-10);
    return report.tangents;
  };
  // The first correction leaves 0.005: as much as the linear solver does, or far more, or all of
  // it.
  CHECK(tangents(1) == 1);
  CHECK(tangents(0.01) > 1);
  CHECK(tangents(0) == 1);
}


TEST_CASE("Newton's method goes back from where an old tangent has led astray", "[newton]")
{
  Scalar problem{[](double x) { return std::exp(x) - 1; }, [](double x) { return std::exp(x); }};
  for (const double old_tangent : {-1., 1e-3, 1e3})
    {
      INFO(old_tangent);
      problem.tangent = old_tangent;
      Number     x{0.5};
      const auto report = solve_newton(problem, x, NewtonOptions(), true);
      CHECK(std::abs(problem.f(x.value)) <= 1e-10);
      CHECK(report.tangents >= 1);
      CHECK(report.tangents < report.iterations);
    }
  // One that is right is used.
  problem.tangent = 1;
  Number x{1e-3};
  CHECK(solve_newton(problem, x, NewtonOptions(), true).tangents == 0);
  CHECK(std::abs(problem.f(x.value)) <= 1e-10);
}


TEST_CASE("Newton's method asks linear solvers for what its corrections can gain", "[newton]")
{
  Scalar problem{[](double x) { return std::sinh(x) - 1; }, [](double x) { return std::cosh(x); }};
  Number x{0.5};
  solve_newton(problem, x, NewtonOptions());
  CHECK(std::abs(problem.f(x.value)) <= 1e-10);
  CHECK(problem.most_left <= 0.1);    // of a residual that is a tenth of the tolerance
  CHECK(problem.least_left >= 1e-12); // a hundredth of the tolerance
  CHECK(problem.most_left > 1e-6);
  NewtonOptions two;
  two.fixed_iterations = 2;
  problem.most_left    = 0;
  x.value              = 0.5;
  solve_newton(problem, x, two);
  CHECK(problem.most_left <= 1e-8);
}


TEST_CASE("tangents of bodies are exact: with them Newton's method converges quadratically",
          "[solid]")
{
  for (const auto &material : Registry<Material>::instance().names())
    {
      INFO(material);
      SolidEnvironment<2> gravity;
      gravity.gravity[1] = -0.1;
      Solid<2>   solid(one_body("set Upper corner = 2, 1\n set Cells = 4, 2\n set Density = 1\n" +
                                samples::elastic_lines({10., 0.3}) + "set Material = " + material,
                              boundary("root", "set Sides = left"),
                              "set Inexact Newton = false",
                              "set Integrator = static"),
                     gravity);
      const auto residuals = solid.advance(1).newton.residuals;
      CHECK(residuals.size() <= 9);
      if (material == "linear elastic")
        {
          CHECK(residuals.size() == 2);
          continue;
        }
      // |r_k+1| <= C |r_k|^2 with C = 50 / N as soon as |r_k| < 0.3 N, down to rounding. A tangent
      // that is wrong by a thousandth misses this at |r_k| = 1e-6 N by a factor of twenty.
      unsigned int corrections = 0;
      for (unsigned int k = 1; k + 1 < residuals.size(); ++k)
        if (residuals[k] < 0.3)
          {
            INFO(residuals[k] << " -> " << residuals[k + 1]);
            CHECK(residuals[k + 1] <= std::max(50 * residuals[k] * residuals[k], 1e-13));
            ++corrections;
          }
      CHECK(corrections >= 3);
    }
}


TEST_CASE("a body at rest needs no iteration, one in steady flight neither", "[solid][mpi]")
{
  Solid<2> resting(
    one_body("set Density = 1\n set Young's modulus = 1e9\n set Poisson's ratio = 0.3"));
  CHECK(resting.advance(1).newton.iterations == 0);
  Solid<2> flying(
    one_body("set Density = 1\n set Young's modulus = 1e9\n set Poisson's ratio = 0.3\n"
             "set Initial velocity = 100; 3"));
  for (unsigned int step = 0; step < 5; ++step)
    CHECK(flying.advance(0.1).newton.iterations <= 1);
  CHECK(flying.displacement({1, 1})[0] == Approx(50));
}
