// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <cmath>
#include <complex>
#include <functional>

using namespace undine_tests;

namespace
{
  constexpr double dynamic_viscosity = .05;

  /// The fluid between two plane walls normal to y. They are sides of the domain, or surfaces of
  /// obstacles between planes of the grid.
  struct Layer
  {
    double lower, upper;
    bool   of_obstacles;

    double
    width() const
    {
      return upper - lower;
    }
  };

  const Layer              sides{0, 1, false};
  const std::vector<Layer> among_obstacles{
    {.137, .871, true}, {.15, .884, true}, {.164, .898, true}};

  using Exact = std::function<double(double y, double t)>;


  /// Rest, until at t = 0 a pressure gradient of -1 sets in: the series of sines.
  Exact
  starting_flow(const Layer &layer)
  {
    return [layer](const double y, const double t) {
      const double H = layer.width(), s = y - layer.lower;
      double       result = s * (H - s) / (2 * dynamic_viscosity);
      for (int n = 1; n < 60; n += 2)
        result -= 4 * H * H / (dynamic_viscosity * std::pow(n * pi, 3)) * std::sin(n * pi * s / H) *
                  std::exp(-n * n * pi * pi * dynamic_viscosity * t / (H * H));
      return result;
    };
  }


  /// The lower wall moves with cos(w t), the upper one is at rest: Stokes' second problem with an
  /// end, v = Re exp(i w t) sinh(k (H - s)) / sinh(k H), k = (1 + i) sqrt(w / 2 nu).
  constexpr double frequency = 2; // [1/s]

  Exact
  swinging_flow(const Layer &layer)
  {
    return [layer](const double y, const double t) {
      const double               H = layer.width(), s = y - layer.lower;
      const std::complex<double> k(std::sqrt(frequency / (2 * dynamic_viscosity)),
                                   std::sqrt(frequency / (2 * dynamic_viscosity)));
      return std::real(std::polar(1., frequency * t) * std::sinh(k * (H - s)) / std::sinh(k * H));
    };
  }


  /// swinging_flow() at t = 0 as an expression, without complex numbers.
  std::string
  swinging_flow_at_start(const Layer &layer)
  {
    const double k    = std::sqrt(frequency / (2 * dynamic_viscosity));
    const double H    = layer.width();
    const double even = std::sinh(k * H) * std::cos(k * H),
                 odd  = std::cosh(k * H) * std::sin(k * H);
    const auto rest   = fmt::format("({:.17g}*({:.17g}-y))", k, layer.upper);
    const auto sum =
      fmt::format("({0:.17g})*sinh{2}*cos{2}+({1:.17g})*cosh{2}*sin{2}", even, odd, rest);
    return fmt::format("if(y<{:.17g},1,if(y>{:.17g},0,({})/{:.17g}))",
                       layer.lower,
                       layer.upper,
                       sum,
                       even * even + odd * odd);
  }


  /// Four cells along the flow, three across it in 3D, n from wall to wall.
  template <int dim>
  std::string
  scene(const Layer       &layer,
        const unsigned int n,
        const double       dt,
        const double       drop,
        const std::string &initial,
        const std::string &wall,
        const std::string &path)
  {
    const double length = 4. / n;
    const auto   still  = plane_or_space<dim>("; 0", "; 0; 0");
    const auto   box    = [&](const std::string &name,
                         const double       from,
                         const double       to,
                         const std::string &displacement) {
      return obstacle(name,
                      "box",
                      fmt::format("set Lower corner = -1, {:.17g}{}\nset Upper corner = 2, "
                                       "{:.17g}{}\nset Displacement = {}{}",
                                  from,
                                  plane_or_space<dim>("", ", -1"),
                                  to,
                                  plane_or_space<dim>("", ", 2"),
                                  displacement,
                                  still));
    };
    std::string text =
      steps_of(dt) +
      section("Domain",
              fmt::format("set Cells = 4, {}{}\nset Upper corner = {:.17g}, 1{}",
                          n,
                          plane_or_space<dim>("", ", 3"),
                          length,
                          plane_or_space<dim>("", fmt::format(", {:.17g}", 3. / n)))) +
      section(
        "Fluid",
        "set Density = 1\nset Initial velocity = " + initial + still + "\n" +
          section(
            "Boundaries",
            boundary(
              "high", "left", "pressure", fmt::format("set Pressure = {:.17g}", drop * length)) +
              boundary("low", "right", "pressure", "set Pressure = 0") +
              (layer.of_obstacles
                 ? ""
                 : boundary("lower", "bottom", "moving wall", "set Velocity = " + wall + still) +
                     boundary("upper", "top", "no-slip wall")))) +
      section("Effects", convection() + viscosity(dynamic_viscosity));
    if (layer.of_obstacles)
      text += section("Obstacles",
                      box("lower", -1, layer.lower, path) + box("upper", layer.upper, 2, "0"));
    return text;
  }


  template <int dim>
  double
  largest_difference(const CoupledRun<dim> &run, const Layer &layer, const Exact &exact)
  {
    return largest_on_faces(
      run.state.fluid.velocity, [&](const double v, const auto &place, const unsigned int axis) {
        if (place[1] < layer.lower || place[1] > layer.upper)
          return 0.;
        return std::abs(v - (axis == 0 ? exact(place[1], run.state.clock.time) : 0.));
      });
  }


  template <int dim>
  double
  starting_error(const Layer &layer, const unsigned int n, const unsigned int steps)
  {
    CoupledRun<dim> run(scene<dim>(layer, n, 1. / steps, 1, "0", "0", "0"));
    for (unsigned int k = 0; k < steps; ++k)
      run.step();
    return largest_difference(run, layer, starting_flow(layer));
  }


  template <int dim>
  double
  swinging_error(const Layer &layer, const unsigned int n, const unsigned int steps)
  {
    CoupledRun<dim> run(scene<dim>(layer,
                                   n,
                                   1. / steps,
                                   0,
                                   swinging_flow_at_start(layer),
                                   fmt::format("cos({}*t)", frequency),
                                   fmt::format("sin({0}*t)/{0}", frequency)));
    double          result = 0;
    for (unsigned int k = 0; k < steps; ++k)
      {
        run.step();
        result = std::max(result, largest_difference(run, layer, swinging_flow(layer)));
      }
    return result;
  }


  /// From 32 to 64 cells across, with half the step.
  void
  check_orders(const std::vector<Layer> &layers)
  {
    std::array<double, 2> starting{}, swinging{};
    for (const auto &layer : layers)
      for (const unsigned int k : {0, 1})
        {
          const unsigned int cells = 32 << k;
          starting[k] += starting_error<2>(layer, cells, cells / 2) / layers.size();
          swinging[k] += swinging_error<2>(layer, cells, 2 * cells) / layers.size();
        }
    const auto observed = [](const std::array<double, 2> &errors) {
      return std::log2(errors[0] / errors[1]);
    };
    UNSCOPED_INFO(fmt::format("start {:.3e} {:.3e} {:.2f}, swing {:.3e} {:.3e} {:.2f}",
                              starting[0],
                              starting[1],
                              observed(starting),
                              swinging[0],
                              swinging[1],
                              observed(swinging)));
    CHECK(observed(starting) >= 1.8);
    CHECK(observed(swinging) >= 1.8);
  }
} // namespace


TEST_CASE("Layers that start and layers that swing are of second order in space and time",
          "[friction]")
{
  SECTION("between sides of the domain")
  {
    check_orders({sides});
  }
  SECTION("between obstacles, wherever they cut the cells")
  {
    check_orders(among_obstacles); // errors depend on where: the mean over several places
  }
}


TEST_CASE("Layers of fluid flow in 3D as in 2D", "[friction][mpi]")
{
  auto layers = among_obstacles;
  layers.push_back(sides);
  for (const auto &layer : layers)
    {
      INFO(layer.lower);
      CHECK(starting_error<3>(layer, 16, 8) ==
            Approx(starting_error<2>(layer, 16, 8)).epsilon(1e-4));
      CHECK(swinging_error<3>(layer, 16, 8) ==
            Approx(swinging_error<2>(layer, 16, 8)).epsilon(1e-4));
    }
}
