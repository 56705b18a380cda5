// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/model/lattice.h>

#include <catch2/catch.hpp>

#include "particle_scene.h"

#include <cmath>

using namespace undine_tests;
using particles::Kind;

namespace
{
  template <int dim>
  std::string
  ball_obstacle(const double radius)
  {
    const std::string centre = dim == 2 ? "10.2, 9.9" : "10.2, 9.9, 10.1";
    return section("Obstacles",
                   section("ball",
                           "set Shape = ball\n set Centre = " + centre +
                             "\n set Radius = " + std::to_string(radius)));
  }


  /// sum w of a place over all particles but one in it.
  template <int dim>
  double
  number_density(const particles::ParticleState<dim>  &state,
                 const particles::Vector<dim, double> &place,
                 const double                          reach)
  {
    double sum = 0;
    for (const auto &other : state.positions)
      {
        const double distance = std::sqrt(norm_square(place - other));
        if (distance > 0 && distance < reach)
          sum += reach / distance - 1;
      }
    return sum;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "particles: walls behind a ball lie at exact depths, evenly", "", ((int dim), dim), 2, 3)
{
  const double radius = 6;
  const auto   model  = read_particles<dim>(particle_box<dim>(20) + ball_obstacle<dim>(radius) +
                                         section("Fluid", "set Density = 1000"));
  const auto  &state  = model.initial_state();
  const particles::Vector<dim, double> centre = [] {
    particles::Vector<dim, double> result;
    for (int axis = 0; axis < dim; ++axis)
      result[axis] = axis == 0 ? 10.2 : axis == 1 ? 9.9 : 10.1;
    return result;
  }();

  std::array<unsigned int, 3> in_layer{};
  double                      worst_depth = 0, least = 1e100;
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    {
      const double r = std::sqrt(norm_square(state.positions[k] - centre));
      if (state.tags[k].is_free() || r > radius + 0.5)
        continue;
      const int layer = std::floor(radius - r);
      REQUIRE(layer >= 0);
      REQUIRE(layer < 3);
      ++in_layer[layer];
      CHECK((layer == 0) == (state.tags[k].kind() == Kind::wall));
      worst_depth = std::max(worst_depth, std::abs(radius - r - layer - 0.5));
      for (std::size_t j = 0; j < k; ++j)
        least = std::min(least, norm_square(state.positions[k] - state.positions[j]));
    }
  CHECK(worst_depth < 0.02); // the ball has facets
  CHECK(std::sqrt(least) > 0.6);
  for (unsigned int layer = 0; layer < 3; ++layer)
    {
      const double outer = radius - layer, inner = outer - 1;
      const double volume = dim == 2 ? M_PI * (outer * outer - inner * inner)
                                     : 4. / 3 * M_PI * (std::pow(outer, 3) - std::pow(inner, 3));
      CHECK(in_layer[layer] == Approx(volume).epsilon(0.1));
    }
}


TEMPLATE_TEST_CASE_SIG("particles: fluid before a curved wall has nearly its full number density",
                       "",
                       ((int dim), dim),
                       2,
                       3)
{
  const auto   model   = read_particles<dim>(particle_box<dim>(20) + ball_obstacle<dim>(6) +
                                         section("Fluid", "set Density = 1000"));
  const auto  &state   = model.initial_state();
  const auto   lattice = particles::full_lattice(dim, 2.1);
  double       sum = 0, lowest = 1e100, highest = 0;
  unsigned int n = 0;
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    {
      if (state.tags[k].kind() != Kind::fluid)
        continue;
      const double share = number_density(state, state.positions[k], 2.1) / lattice.number_density;
      if (std::abs(share - 1) < 1e-9)
        continue; // far from the ball
      sum += share;
      lowest  = std::min(lowest, share);
      highest = std::max(highest, share);
      ++n;
    }
  REQUIRE(n > 20);
  INFO("mean " << sum / n << ", from " << lowest << " to " << highest);
  CHECK(sum / n > 0.9);
  CHECK(sum / n < 1.05);
  CHECK(lowest > 0.6);
  CHECK(highest < 1.35);
}


TEST_CASE("particles: an obstacle that fits the lattice is a lattice")
{
  const auto  model = read_particles<2>(particle_box<2>(20) +
                                       section("Obstacles",
                                               section("step",
                                                       "set Lower corner = 8, -4\n "
                                                        "set Upper corner = 16, 6")) +
                                       section("Fluid", "set Density = 1000"));
  const auto &state = model.initial_state();
  CHECK(count(model, Kind::fluid) == 400 - 48);
  for (const auto &position : state.positions)
    for (int axis = 0; axis < 2; ++axis)
      CHECK(std::abs(position[axis] - std::floor(position[axis]) - 0.5) < 1e-5);
}


TEST_CASE("particles: a wall as thin as two spacings has them")
{
  const auto model = read_particles<2>(
    particle_box<2>(10) +
    section("Obstacles",
            section("sheet", "set Lower corner = 4.5, 0\n set Upper corner = 6.5, 10")) +
    section("Fluid", "set Density = 1000\n set Region = 4 - x"));
  unsigned int inside = 0;
  const auto  &state  = model.initial_state();
  for (std::size_t k = 0; k < state.tags.size(); ++k)
    if (!state.tags[k].is_free() &&
        model.domain().contains({state.positions[k][0], state.positions[k][1]}))
      {
        ++inside;
        CHECK(std::min(std::abs(state.positions[k][0] - 5), std::abs(state.positions[k][0] - 6)) <
              1e-6);
      }
  CHECK(inside == 20);
}


TEST_CASE("particles: obstacles move as prescribed, and come from outside the domain")
{
  // Turns about the origin; half of it is below the floor.
  const auto model =
    read_particles<2>(particle_box<2>(20, "set Open sides = top") +
                      section("Obstacles",
                              section("paddle",
                                      "set Lower corner = 6, -5\n set Upper corner = 8, 5\n"
                                      "set Displacement = (cos(t)-1)*x - sin(t)*y; "
                                      "(cos(t)-1)*y + sin(t)*x") +
                                section("gate",
                                        "set Lower corner = 12, 0\n set Upper corner = 13, 15\n"
                                        "set Displacement = 0; 3*t")) +
                      section("Fluid", "set Density = 1000"));
  CHECK(model.setup().n_moving == 2 * 10 + 15);
  const double time = .3, length = .01;
  const auto   paths = model.wall_paths(time, length);
  REQUIRE(paths.size() == 35);
  const auto &rest = model.initial_state().positions;
  for (std::size_t k = 0; k < paths.size(); ++k)
    {
      const bool turns = k < 20;
      CHECK(model.initial_state().tags[k].material() == particles::moving_material);
      const auto place = [&](const double t) -> particles::Vector<2, double> {
        if (!turns)
          return {{rest[k][0], rest[k][1] + 3 * t}};
        return {{std::cos(t) * rest[k][0] - std::sin(t) * rest[k][1],
                 std::cos(t) * rest[k][1] + std::sin(t) * rest[k][0]}};
      };
      CHECK(norm_square(paths[k].start - place(time)) < 1e-20);
      CHECK(norm_square(paths[k].start + paths[k].way - place(time + length)) < 1e-20);
      const auto speed = (1 / (2 * 1e-6)) * (place(time + 1e-6) - place(time - 1e-6));
      CHECK(norm_square(paths[k].v_start - speed) < 1e-8);
    }
  // Fluid keeps off them.
  for (std::size_t k = 35; k < rest.size(); ++k)
    if (model.initial_state().tags[k].kind() == Kind::fluid)
      for (std::size_t m = 0; m < 35; ++m)
        REQUIRE(norm_square(rest[k] - rest[m]) > .8);
}
