// SPDX-License-Identifier: LGPL-2.1-or-later
// The verdicts on made-up runs by the rules of doc/hard_cases.md.
#include <scene/history.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace undine;

namespace
{
  bool
  contains(const std::string &text, const std::string &part)
  {
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
  }


  /// The energy multiplies by `factor` in each step; nothing is put in.
  History
  exponential(const double factor, const bool has_account, const unsigned int n_steps = 102)
  {
    History run(has_account);
    for (unsigned int n = 0; n < n_steps; ++n)
      run.add({0, std::pow(factor, n)});
    return run;
  }


  /// A velocity that swings about 1 m/s, in a fluid of much more energy.
  History
  swinging(const double amplitude, const double factor, const double period, const int n_steps)
  {
    History run;
    for (int n = 0; n < n_steps; ++n)
      {
        const double swing = amplitude * std::pow(factor, n) * std::cos(2 * M_PI / period * n);
        run.add({1e3, 1e-3, 1 + swing, 3 + 2 * swing});
      }
    return run;
  }
} // namespace


TEST_CASE("an energy that nobody feeds")
{
  for (const double factor : {0.9, 0.99, 1., 1.001})
    {
      CHECK(exponential(factor, true).verdict() == "stable");
      CHECK(exponential(factor, false).verdict() == "stable");
    }
  for (const double factor : {1.01, 1.02, 1.1, 2.})
    {
      const auto run = exponential(factor, true);
      CHECK(run.verdict() == "growing");
      CHECK(contains(run.text(), "body plate"));
      CHECK(contains(run.text(), fmt::format("factor of {:.4g} a step", factor)));
      CHECK(exponential(factor, false).verdict() == "undecided");
    }
  CHECK(exponential(1.005, true, 500).verdict() == "growing"); // in more than 100 steps
  CHECK(exponential(10, true, 8).verdict() == "growing");      // or few
}


TEST_CASE("a body that swings with a period of a few steps")
{
  for (const double factor : {0.98, 1., 1.001})
    {
      CHECK(swinging(0.3, factor, 2, 300).verdict() == "stable");
      CHECK(swinging(0.3, factor, 2.7, 300).verdict() == "stable");
    }
  for (const double factor : {1.005, 1.02, 1.1})
    {
      const auto run = swinging(0.05, factor, 2, 104);
      CHECK(run.verdict() == "growing");
      CHECK(
        contains(run.text(), "body plate, swings from step to step, its amplitude by a factor of"));
      CHECK(contains(run.text(), fmt::format("{:.4g} a step", factor)));
      CHECK(swinging(0.05, factor, 2.7, 110).verdict() == "growing");
    }
  CHECK(contains(swinging(0.05, 1.05, 2.7, 110).text(), "period of 2.7 steps"));
  CHECK(swinging(0.05, 1.02, 20, 200).verdict() == "stable"); // a flag that a wake feeds
  CHECK(swinging(1e-8, 1.02, 2, 200).verdict() == "stable");  // rounding, so far
}


TEST_CASE("forces that are rounding beside a stream without forces")
{
  const auto run = [](const double amplitude) {
    Certificate::Scope scope;
    scope.extent = 2;
    History history(true, scope);
    for (int n = 0; n < 104; ++n)
      {
        const double swing = amplitude * std::pow(1.1, n) * (n % 2 == 0 ? 1 : -1);
        history.add({1e3, 0, 1, swing});
      }
    return history.verdict();
  };
  CHECK(run(1e-12) == "stable"); // up to 2e-8 N, where 500 N would stop the stream over its length
  CHECK(run(1e-3) == "growing");
}


TEST_CASE("energy that is put in is no fault")
{
  History spin_up, limit_cycle, falling, unknown(false);
  for (unsigned int n = 1; n <= 300; ++n)
    {
      const double t = n, energy = t * t;
      spin_up.add({energy, 0, t, t, 0, 0, 2 * t});
      unknown.add({energy, 0, t, t});
      falling.add({0, energy, t, 1, 2 * t - 1, 2 * t - 1});
      // A flag of a period of 20 steps, fed by a flow of a constant power that is lost again.
      const double amplitude = std::min(1., 1e-3 * std::exp(0.05 * t));
      limit_cycle.add({10 - std::pow(amplitude, 2),
                       std::pow(amplitude, 2),
                       amplitude * std::sin(M_PI / 10 * t),
                       amplitude * std::cos(M_PI / 10 * t),
                       0,
                       0,
                       0,
                       20});
    }
  CHECK(spin_up.verdict() == "stable");
  CHECK(falling.verdict() == "stable");
  CHECK(limit_cycle.verdict() == "stable");
  CHECK(unknown.verdict() != "growing");
}


TEST_CASE("a stream that sets in at once, whose first pressures put means of two ends wrong")
{
  History run;
  run.add({1000, 0, 1, 1, 0, 0, -1e4});
  for (unsigned int n = 0; n < 200; ++n)
    run.add({1000. + 100 * std::min(n, 40u), 0, 1, 1, 0, 0, n < 40 ? 100. : 0.});
  CHECK(run.text() == "stable");
}


TEST_CASE("what starts with a jump is judged after it")
{
  History run;
  run.add({1e3, 1, 10, 1e4});
  for (unsigned int n = 0; n < 200; ++n)
    run.add({1e3 * std::exp(-0.01 * n), 1, 1 + std::exp(-0.1 * n), 5 + 100 * std::exp(-0.5 * n)});
  CHECK(run.text() == "stable");
}


TEST_CASE("what has died away is mentioned only")
{
  History run;
  for (int n = 0; n < 200; ++n)
    {
      const double swing = 0.5 * std::exp(-0.001 * std::pow(n - 90, 2)) * (n % 2 == 0 ? 1 : -1);
      run.add({1e3, 1, 1 + swing, swing});
      if (n == 80)
        CHECK(run.verdict() == "growing");
    }
  CHECK(run.verdict() == "stable");
  CHECK(contains(run.text(), "(body plate) has died away"));
}


TEST_CASE("redone steps and failures are in the text")
{
  History run;
  for (unsigned int n = 0; n < 200; ++n)
    run.add({1, 0, 0, 0, 0, 0, 0, 0, n < 2 ? 1u : 0u});
  CHECK(run.text() == "stable");
  run.add({1, 0, 0, 0, 0, 0, 0, 0, 1});
  CHECK(run.text() == "stable; 3 of 201 steps were redone (1.5 %)");
  CHECK(run.certificate.verdict("no pivot. Try: more") == "failed");
  CHECK(contains(run.certificate.text(201, "no pivot. Try: more"),
                 "failed at t = 201 s: no pivot. Try: more; 3 of 201"));
  const auto grown = exponential(1.1, true);
  CHECK(contains(grown.certificate.text(102, "no pivot"), "no pivot; growing since t = "));
}


TEST_CASE("particles: weight is all that works in a closed tank, and frames are no steps")
{
  const auto run = [](const bool is_closed, const double factor) {
    Certificate::Scope scope;
    scope.is_closed        = is_closed;
    scope.steps_are_frames = true;
    Certificate certificate(scope);
    for (int n = 0; n < 200; ++n)
      {
        const double energy = std::pow(factor, n);
        Report       report;
        report.dt      = 0.01;
        report.columns = {{"Kinetic energy of fluid", "J", energy},
                          {"Potential energy", "J", factor < 1 ? 500 - energy : 500},
                          {"Velocity of block x", "m/s", n % 2 == 0 ? energy : -energy}};
        certificate.observe(0.01 * (n + 1), report);
      }
    return certificate.verdict("");
  };
  CHECK(run(true, 0.98) == "stable");
  CHECK(run(true, 1.02) == "growing");
  CHECK(run(false, 1.02) == "undecided");
}


TEST_CASE("particles that flow in bring energy")
{
  const auto run = [](const double factor) {
    Certificate::Scope scope;
    scope.steps_are_frames = true;
    Certificate certificate(scope);
    CHECK(certificate.text(0, "") == "undecided: no step has been made");
    for (int n = 0; n < 200; ++n)
      {
        const double number = 10 + std::exp(0.02 * n);
        Report       report;
        report.dt      = 0.01;
        report.columns = {{"Fluid particles", "1", number},
                          {"Kinetic energy of fluid", "J", number * std::pow(factor, n)}};
        certificate.observe(0.01 * (n + 1), report);
      }
    return certificate.verdict("");
  };
  CHECK(run(1) == "stable");
  CHECK(run(1.01) == "undecided");
}


TEST_CASE("margins are those of the worst step")
{
  Certificate certificate({});
  for (unsigned int n = 0; n < 10; ++n)
    {
      Report report;
      report.dt      = 0.5;
      report.columns = {{"Fluid divergence", "1", n == 4 ? 1e-4 : 1e-9},
                        {"momentum residual plate", "1", n == 7 ? 2e-3 : 0},
                        {"room volume", "m^2", 2 + 0.5 * n + (n == 9 ? 0.01 : 0)},
                        {"room inflow", "m^2/s", 1}};
      certificate.observe(0.5 * n, report);
    }
  const auto text = certificate.json(5, "");
  CHECK(contains(text,
                 "\"volume of the fluid\", \"value\": 0.0001, \"bound\": 0.001, \"margin\": 0.9,"));
  CHECK(contains(
    text, "\"momentum of body plate\", \"value\": 0.002, \"bound\": 0.001, \"margin\": -1,"));
  CHECK(contains(text, "\"volume of room\", \"value\": 0.005, \"bound\": 0.01, \"margin\": 0.5,"));
  CHECK(certificate.text(5, "") == "stable; not kept: momentum of body plate");
}


TEST_CASE("what swings by less than the rounding of other forces does not matter")
{
  for (const double size : {1e-14, 1e-11, 1e-8, 1e-5})
    {
      History run;
      for (int n = 0; n < 120; ++n)
        {
          History::Step step{1e3, 1e-3, 1, 3 + std::sin(0.05 * n)};
          step.force_on_sides = size * std::pow(1.2, std::min(n, 40)) * (n % 2 == 0 ? 1 : -1);
          run.add(step);
        }
      INFO(size);
      CHECK((run.verdict() == "growing") == (size > 1e-9));
    }
}


TEST_CASE("an energy that ripples while it dies away does not grow")
{
  for (const double rate : {0.97, 0.99})
    for (const double ripple : {0.5, 0.9})
      {
        History run;
        for (int n = 0; n < 250; ++n)
          {
            run.add({0, std::pow(rate, n) * (1 + ripple * std::cos(0.3 * n))});
            INFO("rate " << rate << ", ripple " << ripple << ", step " << n);
            REQUIRE(run.verdict() == "stable");
          }
      }
}
