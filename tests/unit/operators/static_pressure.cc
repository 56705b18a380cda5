// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/outside_forces.h>
#include <undine/operators/static_pressure.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <fluid/fluid_scene.h>
#include <operators/immersed.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  StaticPressure<dim>
  some_pressure()
  {
    StaticPressure<dim> pressure;
    pressure.at_origin = 0.7;
    for (unsigned int d = 0; d < dim; ++d)
      pressure.gradient[d] = std::sin(1 + 2.3 * d);
    return pressure;
  }


  /// The work against the pressure changes by the forces of that pressure along the way of nodes:
  /// the difference over twice a small way is exact but for its third power and rounding.
  template <int dim>
  void
  check_work_of_forces(const std::string &kind)
  {
    INFO(dim << "D " << kind);
    Random              random(1);
    auto                bodies    = bodies_of_kind<dim>(kind, random);
    const auto          stretched = make_planes(bodies, Grid::unit, random);
    const Immersed<dim> immersed(stretched.planes, bodies.surface(), bodies.nodes);
    const auto          pressure = some_pressure<dim>();
    const auto          forces   = forces_by_quadrature<dim>(
      immersed.surface, immersed.positions, [&](const dealii::Point<dim> &x) {
        return pressure.at_origin + pressure.gradient * x;
      });

    constexpr double way     = 1e-5;
    const double     largest = largest_norm(forces);
    auto             there = immersed.positions, back = immersed.positions;
    double           work = 0, size = 0;
    for (std::size_t node = 0; node < there.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double step = way * (std::sin(7. * node + d) + forces[node][d] / largest);
          there[node][d] += step;
          back[node][d] -= step;
          work -= 2 * step * forces[node][d];
          size += 2 * std::abs(step * forces[node][d]);
        }
    const auto against = [&](const auto &positions) {
      return work_against(
        pressure, immersed.grid, immersed.surface, positions, immersed.surface.n_nodes());
    };
    CHECK(std::abs(against(there) - against(back) - work) < 1e-6 * size);
    CHECK(std::abs(work) > 1e-3 * size); // else this tests nothing
  }


  /// The same of what is outside of openings on all sides, for a ball beyond a corner of the
  /// domain: pressures differ from place to place, one side of the three is a wall.
  template <int dim>
  void
  check_work_outside(const double shift)
  {
    INFO(dim << "D, by " << shift);
    Random              random(2);
    auto                bodies    = bodies_of_kind<dim>("ball", random);
    const auto          stretched = make_planes(bodies, Grid::unit, random);
    const Immersed<dim> immersed(stretched.planes, bodies.surface(), bodies.nodes);
    const Options       options = read_scene_text(
      boundary("open", "left, right, top, bottom", "pressure", "set Pressure = 1 + x - 2*y + 3*t"));
    const auto             boundaries = read_boundaries<dim>(options);
    const BoundaryMap<dim> map(options, boundaries, immersed.grid);
    dealii::Tensor<1, dim> weight;
    weight[1]   = -2;
    auto places = immersed.positions;
    for (auto &place : places)
      for (unsigned int d = 0; d < dim; ++d)
        place[d] += shift * (immersed.grid.upper()[d] - immersed.grid.lower()[d]) * (1 - .1 * d);
    const auto forces  = outside_forces(map, immersed.surface, places, weight, .7);
    const auto work_at = [&](const auto &positions) {
      return work_outside(map, immersed.surface, positions, immersed.surface.n_nodes(), weight, .7);
    };
    constexpr double way   = 1e-6;
    auto             there = places, back = places;
    double           work = 0, size = 0;
    for (std::size_t node = 0; node < there.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double step = way * (std::sin(7. * node + d) + (d == 1 ? 1 : 0));
          there[node][d] += step;
          back[node][d] -= step;
          work -= 2 * step * forces[node][d];
          size += 2 * std::abs(step * forces[node][d]);
        }
    CHECK(std::abs(work_at(there) - work_at(back) - work) < 1e-5 * size);
    CHECK(std::abs(work) > 1e-3 * size);
  }


  /// Of four nodes that run clockwise: the solid lies to the left of its facets.
  Surface<2>
  rectangle()
  {
    return {4, {{{0, 3}}, {{3, 2}}, {{2, 1}}, {{1, 0}}}, {0, 0, 0, 0}, {"box"}};
  }
} // namespace


TEST_CASE("The work against a static pressure is that of its forces", "[operators]")
{
  for (const std::string kind : {"ball", "wave", "nested bodies"})
    {
      check_work_of_forces<2>(kind);
      check_work_of_forces<3>(kind);
    }
}


TEST_CASE("The work against what is outside of openings is that of its forces", "[operators]")
{
  for (const double shift : {.3, -.5, -.6})
    {
      check_work_outside<2>(shift);
      check_work_outside<3>(shift);
    }
}


TEST_CASE("Only what is within the domain does work against its pressure", "[operators]")
{
  const MacGrid<2> grid(MPI_COMM_WORLD, {{{0, .5, 1, 1.5, 2}, {0, .5, 1}}}, {});
  const auto       surface = rectangle();
  // From x = -1 to 1, and y from .25 to 3: a square of 1 by .75 is in the domain.
  const std::vector<dealii::Point<2>> corners{{-1, .25}, {-1, 3}, {1, 3}, {1, .25}};
  const auto against = [&](const StaticPressure<2> &pressure, const unsigned int n_nodes) {
    return work_against(pressure, grid, surface, corners, n_nodes);
  };
  const double volume = against({1, {}}, 4);
  CHECK(std::abs(volume - .75) < 1e-14);
  const double moment = against({0, dealii::Tensor<1, 2>({0, 1})}, 4);
  CHECK(std::abs(moment - volume * (.25 + 1) / 2) < 1e-14);
  CHECK(against({1, {}}, 0) == 0); // of obstacles, whose nodes come after those of bodies
}
