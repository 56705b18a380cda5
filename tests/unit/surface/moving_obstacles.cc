// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/obstacles.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <solid/solid_scene.h>

#include <cmath>
#include <functional>

using namespace undine_tests;

namespace
{
  template <int dim>
  Obstacles<dim>
  moving_obstacle(const std::string &keys)
  {
    return Obstacles<dim>(
      read_scene_text("subsection Obstacles\nsubsection thing\n" + keys + "\nend\nend\n"));
  }
} // namespace


TEST_CASE("What is moved along arrives where it shall", "[interface]")
{
  const auto obstacles =
    moving_obstacle<2>("set Displacement = 0.1 * sin(3 * t); -t^2\nset Refinements = 2");
  CHECK(obstacles.move());
  const auto before = obstacles.positions(.3), after = obstacles.positions(.8);
  const auto velocities = obstacles.velocities(.3, .5);
  for (unsigned int node = 0; node < before.size(); ++node)
    {
      const auto x = obstacles.positions(0)[node];
      CHECK(before[node][0] == Approx(x[0] + .1 * std::sin(.9)));
      CHECK(before[node][1] == Approx(x[1] - .09).margin(1e-15));
      CHECK((before[node] + .5 * velocities[node]).distance(after[node]) <= 1e-15);
    }
  CHECK_FALSE(moving_obstacle<2>("set Shape = ball").move());
}


namespace
{
  template <int dim>
  Obstacles<dim>
  moving_ball(const std::string &displacement)
  {
    return moving_obstacle<dim>("set Shape = ball\nset Refinements = 3\nset Displacement = " +
                                displacement);
  }


  /// Of these velocities through the surface at `places`.
  template <int dim>
  double
  flux_through(const Surface<dim>                        &surface,
               const std::vector<dealii::Point<dim>>     &places,
               const std::vector<dealii::Tensor<1, dim>> &velocities)
  {
    double flux = 0;
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (const unsigned int node : surface.facets()[facet])
        flux += velocities[node] * area_vector(surface, facet, places) / dim;
    return flux;
  }


  /// Largest distance in a step of `dt` between where nodes are to be and where their velocities
  /// take them; the flux of these velocities through the surface is checked.
  template <int dim>
  double
  largest_detour(const std::string &displacement, const double dt)
  {
    const auto   obstacles = moving_ball<dim>(displacement);
    const auto  &surface   = obstacles.surface();
    const auto   before = obstacles.positions(.3), after = obstacles.positions(.3 + dt);
    const auto   velocities = obstacles.velocities(.3, dt);
    const double growth     = body_volumes(surface, after)[0] - body_volumes(surface, before)[0];
    CHECK(flux_through(surface, before, velocities) * dt == Approx(growth).margin(1e-14));
    double detour = 0;
    for (unsigned int node = 0; node < before.size(); ++node)
      detour = std::max(detour, (before[node] + dt * velocities[node]).distance(after[node]));
    return detour;
  }
} // namespace


TEST_CASE("What turns or grows displaces the fluid that it shall", "[interface]")
{
  const std::string turn  = "x * (cos(2*t) - 1) - y * sin(2*t); x * sin(2*t) + y * (cos(2*t) - 1)";
  const auto        check = [](const auto &detour) {
    const double coarse = detour(.1), fine = detour(.05);
    CHECK(coarse > 0);
    CHECK(coarse / fine == Approx(4).epsilon(.2)); // to follow an arc is of second order
  };
  check([&](const double dt) { return largest_detour<2>(turn, dt); });
  check([&](const double dt) { return largest_detour<3>(turn + "; 0", dt); });
  check([&](const double dt) { return largest_detour<2>("x * t; -t^2 * y", dt); });
  check([&](const double dt) { return largest_detour<3>("x * t; -t^2 * y; 0.5 * t * z", dt); });
}


namespace
{
  /// At one time, by differences over `around`: nodes have the velocity `exact` [m/s], to second
  /// order in these, and the flux through the surface there is that by which its volume grows.
  template <int dim>
  void
  check_velocities_at(const std::string                                               &displacement,
                      const double                                                     around,
                      const double                                                     growth_rate,
                      const std::function<dealii::Tensor<1, dim>(dealii::Point<dim>)> &exact)
  {
    const auto   obstacles  = moving_ball<dim>(displacement);
    const auto   places     = obstacles.positions(.3);
    const auto   velocities = obstacles.velocities_at(.3, around);
    const double volume     = body_volumes(obstacles.surface(), places)[0];
    CHECK(flux_through(obstacles.surface(), places, velocities) ==
          Approx(growth_rate * volume).margin(1e-15 / around + 1e-13));
    for (unsigned int node = 0; node < places.size(); ++node)
      CHECK((velocities[node] - exact(places[node])).norm() <= 3 * around * around);
  }
} // namespace


TEST_CASE("At any time what turns displaces no fluid, and what grows as much as it grows",
          "[interface]")
{
  const std::string turn = "x * (cos(2*t) - 1) - y * sin(2*t); x * sin(2*t) + y * (cos(2*t) - 1)";
  const auto        turning = [](const auto &place) {
    auto velocity = place - place;
    velocity[0] = -2 * place[1], velocity[1] = 2 * place[0];
    return velocity;
  };
  const auto growing = [](const auto &place) {
    return dealii::Tensor<1, std::decay_t<decltype(place)>::dimension>(place) / 1.3;
  };
  for (const double around : {.1, .01, .001})
    {
      check_velocities_at<2>(turn, around, 0, turning);
      check_velocities_at<3>(turn + "; 0", around, 0, turning);
      check_velocities_at<2>("x * t; y * t", around, 2 / 1.3, growing);
    }
}
