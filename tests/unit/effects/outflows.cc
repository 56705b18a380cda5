// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  const std::vector<std::string> methods = {"semi-Lagrangian", "MacCormack", "cubic"};

  /// A box of 1 x `height`, open at the right, out of whose top a pump draws 1.1 m/s: fluid comes
  /// in through the opening, at 1.1 / height in the mean.
  FluidText
  pumped_box(const double height)
  {
    return FluidText{"16, 4",
                     boundary("out", "right", "outflow") +
                       boundary("pump", "top", "inflow", "set Velocity = 0; 1.1"),
                     "",
                     fmt::format("set Upper corner = 1, {}", height)};
  }


  /// How fast fluid comes in through outflows, at most [m/s], on all ranks.
  template <int dim>
  double
  fastest_entering(const FlowRun<dim> &run)
  {
    double fastest = 0;
    for (const auto &open : open_faces<dim>(run.model, run.state.velocity, nullptr, run.time))
      fastest = std::max(fastest, open.entering);
    return dealii::Utilities::MPI::max(fastest, MPI_COMM_WORLD);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("fluid that is drawn in through an outflow comes from rest: p = -rho v^2/2",
                       "[flows][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const double dt : {0.01, 0.1, 1., 10.})
    {
      FlowRun<dim> run(
        FluidText{dim == 2 ? "8, 5" : "8, 5, 4",
                  boundary("out", "right", "outflow") +
                    boundary("pump",
                             "left",
                             "inflow",
                             dim == 2 ? "set Velocity = -3; 0" : "set Velocity = -3; 0; 0"),
                  "",
                  "",
                  2},
        convection());
      run.run(3, dt);
      INFO("dt = " << dt);
      CHECK(largest_error(run.state.pressure, [](const auto &) { return -9.; }) < 1e-7);
      CHECK(fastest_entering(run) == Approx(3).epsilon(1e-9));
    }
}


TEST_CASE("fluid at rest outside under a pressure comes in by Bernoulli's and Torricelli's laws",
          "[flows][mpi]")
{
  // Through a channel of length 2: rho L du/dt = P - rho u^2/2.
  const double P = 16, U = std::sqrt(2 * P / 2), L = 2;
  for (const double dt : {.002, .1, 10.})
    {
      FlowRun<2> run(FluidText{"16, 3",
                               boundary("reservoir", "left", "outflow", "set Pressure = 16") +
                                 boundary("drain", "right", "outflow"),
                               "",
                               "set Upper corner = 2, 1",
                               2},
                     convection());
      INFO("dt = " << dt);
      while (run.time < .5)
        {
          run.step(dt);
          if (dt < .01)
            CHECK(fastest_entering(run) ==
                  Approx(U * std::tanh(U * run.time / (2 * L))).epsilon(5e-3).margin(5e-3 * U));
        }
      for (unsigned int n = 0; n < 60; ++n)
        run.step(std::max(dt, .2));
      CHECK(fastest_entering(run) == Approx(U).epsilon(1e-6));
      CHECK(largest_error(run.state.pressure, [](const auto &) { return 0.; }) < 1e-4 * P);
    }
}


TEST_CASE("fluid drawn in through an outflow is bounded at large Courant numbers", "[flows]")
{
  for (const auto &method : methods)
    for (const double height : {0.1, 0.2})
      for (const double courant : {3., 10., 100.})
        {
          const double mean = 1.1 / height;
          FlowRun<2>   run(pumped_box(height), convection(method));
          double       largest = 0, fastest = 0;
          for (unsigned int n = 0; n < 60; ++n)
            {
              run.step(courant / 16 / mean);
              largest = std::max(largest, kinetic_energy(run.model, run.state.velocity));
              fastest = std::max(fastest, fastest_entering(run));
            }
          INFO(method << ", height " << height << ", Courant number " << courant);
          // With all of it as fast as what enters in the mean.
          CHECK(largest < mean * mean / 2 * height);
          CHECK(fastest < 1.5 * mean);
        }
}


TEST_CASE("vortices that sit on outflows lose energy at any Courant number", "[flows]")
{
  for (const auto &method : methods)
    for (const double courant : {1., 3., 10., 30.})
      {
        FlowRun<2>   run(FluidText{"24, 24",
                                 boundary("out", "right, left, top", "outflow"),
                                 "sin(pi*x)*cos(3*pi*y) + cos(2*pi*y); sin(4*pi*x)*sin(3*pi*y)"},
                       convection(method));
        double       energy = kinetic_energy(run.model, run.state.velocity);
        const double first = energy, entering = fastest_entering(run);
        for (unsigned int n = 0; n < 60; ++n)
          {
            run.step(courant / 24);
            energy = kinetic_energy(run.model, run.state.velocity);
            INFO(method << ", Courant number " << courant << ", step " << n);
            REQUIRE(energy < 1.02 * first);
          }
        CHECK(entering > 0.3);
        CHECK(energy < 0.6 * first);
      }
}
