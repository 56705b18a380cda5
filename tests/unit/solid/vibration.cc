// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reference_table.h"
#include "solid_scene.h"

#include <undine/solid/step/solid_equations.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace undine_tests;

namespace
{
  const std::string push = "set Initial velocity = 0; x^2*(3-x)/2\n";

  /// A soft cantilever, one that swings with an amplitude of half its length if pushed.
  std::string
  swinging(const std::string &integrator,
           const std::string &keys = "",
           const std::string &ends = "")
  {
    return one_body("set Upper corner = 1, 0.2\n set Cells = 4, 1\n set Density = 1\n"
                    "set Young's modulus = 100\n set Poisson's ratio = 0.3\n" +
                      keys,
                    ends.empty() ? boundary("root", "set Sides = left") : ends,
                    "",
                    "set Integrator = " + integrator);
  }


  template <int dim>
  Vector
  velocity_at(const double end, const unsigned int steps, Solid<dim> &&solid)
  {
    for (unsigned int step = 0; step < steps; ++step)
      solid.advance(end / steps);
    return solid.state.velocity;
  }


  /// Order at which the velocity converges to that of a much finer trapezoid.
  double
  order_in_time(const std::string         &integrator,
                const std::string         &ends,
                const SolidEnvironment<2> &environment)
  {
    const auto run = [&](const std::string &name, const unsigned int steps) {
      return velocity_at(0.5, steps, Solid<2>(swinging(name, "", ends), environment));
    };
    const Vector reference = run("newmark", 1280);
    Vector       coarse = run(integrator, 80), fine = run(integrator, 160);
    coarse.add(-1., reference);
    fine.add(-1., reference);
    return std::log2(coarse.l2_norm() / fine.l2_norm());
  }


  const std::map<std::string, std::string> second_order{{"trapezoid", "newmark"},
                                                        {"midpoint", "theta\n set Theta = 0.5"},
                                                        {"generalised alpha", "generalised_alpha"}};


  double
  total_energy(const Solid<2> &solid)
  {
    return solid.column("solid kinetic energy") + solid.column("solid elastic energy");
  }
} // namespace


TEST_CASE("large vibration: second order in time", "[solid]")
{
  const auto ends =
    boundary("root", "set Sides = left") +
    boundary("tip", "set Sides = right\n set Kind = traction\n set Traction = 0; 4*sin(5*t)^4");
  for (const auto &integrator : second_order)
    {
      INFO(integrator.first);
      CHECK(order_in_time(integrator.second, ends, {}) == Approx(2).margin(0.15));
    }
}


TEST_CASE("large vibration with damping, loads and a moving end: second order", "[solid]")
{
  SolidEnvironment<2> environment;
  environment.gravity[1]        = -5;
  environment.mass_damping      = 1;
  environment.stiffness_damping = 0.01;
  const auto ends =
    boundary("root",
             "set Sides = left\n set Kind = prescribed motion\n"
             "set Displacement = 0.1*(1-cos(10*t)); 0.05*sin(5*t)") +
    boundary("tip",
             "set Sides = right\n set Kind = traction\n"
             "set Traction = 0; 3*sin(8*t)") +
    boundary("roof", "set Sides = top\n set Kind = pressure\n set Pressure = 2*sin(6*t)^2");
  for (const auto &integrator : second_order)
    {
      INFO(integrator.first);
      const double order = order_in_time(integrator.second, ends, environment);
      CHECK(order >= 1.8);
      // Errors of generalised alpha, whose first acceleration is without viscosity, cancel here.
      if (integrator.first != "generalised alpha")
        CHECK(order <= 2.2);
    }
}


TEST_CASE("energy that each integrator keeps of a free vibration", "[solid]")
{
  // Ten periods of 150 steps. Of the energy are left: trapezoid 0.9996, midpoint 1.0003,
  // generalised alpha 0.985, theta = 0.6 0.54, gamma = 1 0.23, backward Euler 0.06.
  struct Bounds
  {
    double least, most;
  };
  const std::map<std::string, Bounds> kept{{"newmark", {0.998, 1.002}},
                                           {"newmark\n set Gamma = 1", {0.15, 0.35}},
                                           {"theta\n set Theta = 0.5", {0.998, 1.002}},
                                           {"theta", {0.45, 0.65}},
                                           {"theta\n set Theta = 1", {0.03, 0.1}},
                                           {"generalised_alpha", {0.97, 1.0}}};
  for (const auto &test : kept)
    {
      Solid<2>     solid(swinging(test.first, push));
      const double start = total_energy(solid);
      for (unsigned int step = 0; step < 1500; ++step)
        solid.advance(0.02);
      const double share = total_energy(solid) / start;
      INFO(test.first << " keeps " << share);
      CHECK(share >= test.second.least);
      CHECK(share <= test.second.most);
    }
}


TEST_CASE("a free body keeps its momentum, and with it its way", "[solid][mpi]")
{
  for (const auto &integrator : {"newmark", "theta", "generalised_alpha"})
    {
      INFO(integrator);
      Solid<2>   solid(one_body("set Shape = ball\n set Density = 2\n set Young's modulus = 50\n"
                                "set Poisson's ratio = 0.3\n set Initial velocity = 1+y; 2-3*x*y",
                              "",
                              "",
                              std::string("set Integrator = ") + integrator));
      const auto before = linear_momentum(solid.model, solid.state.velocity);
      const auto start  = measure_bodies(solid.model, solid.state.displacement)[0];
      const auto turning =
        angular_momentum(solid.model, solid.state.displacement, solid.state.velocity);
      for (unsigned int step = 0; step < 10; ++step)
        solid.advance(0.02);
      const auto after = linear_momentum(solid.model, solid.state.velocity);
      const auto end   = measure_bodies(solid.model, solid.state.displacement)[0];
      CHECK((after - before).norm() < 1e-9 * before.norm());
      CHECK((end.centre_of_mass - start.centre_of_mass - 0.2 * before / start.mass).norm() < 1e-9);
      const auto turned =
        angular_momentum(solid.model, solid.state.displacement, solid.state.velocity);
      CHECK((turned - turning).norm() < 0.02 * turning.norm());
    }
}


TEST_CASE("a thin cantilever swings with its first frequency", "[solid]")
{
  const auto   row  = reference_row("cantilever_frequency_landau_lifshitz", {{"set", "thin"}});
  const double L    = number(row, "L_m");
  const double H    = number(row, "H_m");
  const double rate = number(row, "freq_Hz");
  // The beam's first mode, small.
  const double k = 1.875104 / L;
  const auto   mode =
    fmt::format("0; 1e-5*(cosh({0}*x)-cos({0}*x)-0.734096*(sinh({0}*x)-sin({0}*x)))", k);
  Solid<2> solid(one_body(fmt::format("set Upper corner = {}, {}\n set Cells = 16, 1\n"
                                      "set Density = {}\n set Young's modulus = {}\n"
                                      "set Poisson's ratio = {}\n set Initial velocity = {}",
                                      L,
                                      H,
                                      row.at("rho"),
                                      row.at("E_Pa"),
                                      row.at("nu"),
                                      mode),
                          boundary("root", "set Sides = left"),
                          "",
                          "set Integrator = newmark"));
  // Time of the first return through zero: half a period.
  const double  dt = 1 / rate / 100;
  SolidPoint<2> tip(solid.model, "body", {L, H / 2});
  double        before = 0, now = 0;
  do
    {
      before = now;
      solid.advance(dt);
      now = tip.value(solid.state.displacement)[1];
    }
  while (now > 0 && solid.time < 1 / rate);
  const double half_period = solid.time - dt * now / (now - before);
  CHECK(1 / (2 * half_period) == Approx(rate).epsilon(0.01));
}


TEST_CASE("prescribed motion is met exactly and does not ring", "[solid]")
{
  for (const auto &integrator : Registry<TimeIntegrator>::instance().names())
    {
      INFO(integrator);
      Solid<2> solid(swinging(integrator,
                              "",
                              boundary("root",
                                       "set Sides = left\n set Kind = prescribed motion\n"
                                       "set Displacement = 0.1*t^2*(3-2*t); 0.2*sin(3*t)")));
      for (unsigned int step = 0; step < 20; ++step)
        {
          solid.advance(0.01);
          const double t = solid.time;
          const auto   d = solid.displacement({0, 0.1});
          const auto   u = solid.velocity({0, 0.1});
          CHECK(d[0] == Approx(0.1 * t * t * (3 - 2 * t)).margin(1e-14));
          CHECK(u[0] == Approx(0.6 * t * (1 - t)).margin(1e-8));
          CHECK(u[1] == Approx(0.6 * std::cos(3 * t)).margin(1e-8));
        }
    }
}


TEST_CASE("a prescribed motion may be as fast as the step resolves", "[solid]")
{
  // 1/12 of a period a step.
  const double rate = 2e6, step = 2.5e-7, amplitude = 1e-6;
  for (const auto &integrator : Registry<TimeIntegrator>::instance().names())
    {
      INFO(integrator);
      Solid<2>   solid(swinging(integrator,
                              "",
                              boundary("root",
                                       "set Sides = left\n set Kind = prescribed motion\n"
                                         "set Displacement = 1e-6*(1-cos(2e6*t)); 1e-6*sin(2e6*t)")),
                     {},
                     step);
      const auto check = [&]() {
        const double angle = rate * solid.time;
        const auto   d = solid.displacement({0, 0.1}), u = solid.velocity({0, 0.1});
        CHECK(d[0] == Approx(amplitude * (1 - std::cos(angle))).margin(1e-18));
        CHECK(d[1] == Approx(amplitude * std::sin(angle)).margin(1e-18));
        CHECK(u[0] == Approx(amplitude * rate * std::sin(angle)).margin(1e-6));
        CHECK(u[1] == Approx(amplitude * rate * std::cos(angle)).margin(1e-6));
      };
      check();
      if (solid.model.numerics().integrator->uses_acceleration())
        {
          SolidPoint<2> root(solid.model, "body", {0, 0.1});
          CHECK(root.value(solid.state.acceleration)[0] ==
                Approx(amplitude * rate * rate).epsilon(1e-3));
        }
      for (unsigned int n = 0; n < 24; ++n)
        {
          solid.advance(step);
          check();
        }
    }
}


TEST_CASE("the balance of momentum closes in every step", "[solid][mpi]")
{
  SolidEnvironment<2> environment;
  environment.gravity[1]        = -5;
  environment.mass_damping      = 1;
  environment.stiffness_damping = 0.01;
  const auto ends =
    boundary("root",
             "set Sides = left\n set Kind = prescribed motion\n"
             "set Displacement = 0.1*(1-cos(10*t)); 0.05*sin(5*t)") +
    boundary("tip", "set Sides = right\n set Kind = traction\n set Traction = 0; 3*sin(8*t)") +
    boundary("roof", "set Sides = top\n set Kind = pressure\n set Pressure = 2*sin(6*t)^2");
  for (const auto &integrator : Registry<TimeIntegrator>::instance().names())
    {
      INFO(integrator);
      Solid<2> solid(swinging(integrator, "", ends), environment);
      for (unsigned int step = 0; step < 5; ++step)
        {
          const auto start = solid.state;
          solid.advance(0.02);
          CHECK(solid.column("momentum residual body") < 1e-9);

          // It can fail: a velocity that is not the solution's.
          TimingTree        timing;
          SolidEquations<2> equations(
            solid.model, solid.stepper.mass(), start, environment, solid.time - 0.02, 0.02, timing);
          auto velocity = solid.state.velocity;
          equations.residual(velocity);
          velocity.add(0.1);
          CHECK((equations.is_static() ||
                 equations.momentum_residuals(velocity, solid.report.reactions)[0] > 1e-4));
        }
    }

  // The trapezoid's momentum, reaction and weight as columns.
  SolidEnvironment<2> gravity;
  gravity.gravity[1] = -5;
  Solid<2>     heavy(swinging("newmark"), gravity);
  const double before = heavy.column("solid momentum y");
  heavy.advance(0.02);
  heavy.advance(0.02);
  const double between = heavy.column("solid momentum y");
  heavy.advance(0.02);
  CHECK(before == 0);
  CHECK((heavy.column("solid momentum y") - between) / 0.02 ==
        Approx(heavy.column("reaction body/root y") - 5 * 0.2).epsilon(1e-8));
}


TEST_CASE("columns of speed and volume", "[solid][mpi]")
{
  Solid<2> solid(swinging("newmark",
                          "set Initial displacement = 0.1*x; 0\n"
                          "set Initial velocity = 3*x^2; 4*x^2\n"));
  CHECK(solid.column("max speed body") == Approx(5));
  CHECK(solid.column("volume body") == Approx(0.22));
  CHECK(std::abs(solid.column("volume drift body")) < 1e-14);
  solid.advance(0.01);
  CHECK(solid.column("volume drift body") == Approx(solid.column("volume body") / 0.22 - 1));
  CHECK(std::abs(solid.column("volume drift body")) > 1e-4);
}


TEST_CASE("a load that stops being a number is an error, the state stays", "[solid][mpi]")
{
  for (const auto &integrator : Registry<TimeIntegrator>::instance().names())
    {
      INFO(integrator);
      Solid<2> solid(swinging(integrator,
                              "",
                              boundary("root", "set Sides = left") +
                                boundary("tip",
                                         "set Sides = right\n set Kind = traction\n"
                                         "set Traction = 0; sqrt(0.055-t)")));
      for (unsigned int step = 0; step < 5; ++step)
        solid.advance(0.01);
      const auto before = solid.state.displacement;
      CHECK_THROWS_WITH(solid.advance(0.02), Catch::Contains("not finite"));
      auto change = solid.state.displacement;
      change.add(-1., before);
      CHECK(change.l2_norm() == 0);
      CHECK(before.l2_norm() > 0);
    }
}


TEST_CASE("a step repeats to the same digits on any number of ranks", "[solid][mpi]")
{
  SolidEnvironment<2> environment;
  environment.gravity[1]        = -5;
  environment.stiffness_damping = 0.01;
  for (const std::string linear_solver : {"direct", "multigrid"})
    {
      Solid<2> solid(
        swinging("theta\n set Linear solver = " + linear_solver, push + "set Refinements = 3"),
        environment);
      for (unsigned int step = 0; step < 4; ++step)
        solid.advance(0.05);
      // Recorded on one rank with the direct solver.
      const auto tip = solid.displacement({1, 0.1});
      CHECK(tip[0] == Approx(-0.0094462449156002).epsilon(1e-9));
      CHECK(tip[1] == Approx(0.066612648985634).epsilon(1e-9));
      CHECK(solid.column("reaction body/root y") == Approx(0.45020745901564).epsilon(1e-9));
    }
}
