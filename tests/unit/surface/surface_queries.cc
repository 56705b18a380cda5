// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/facet_geometry.h>
#include <undine/surface/surface_queries.h>

#include <catch2/catch.hpp>
#include <operators/immersed.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A box from -3 to 3 around `middle` in all directions.
  template <int dim>
  MacGrid<dim>
  box_grid(const std::array<bool, dim> periodic = {}, const double middle = 0)
  {
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      planes[d] = {middle - 3, middle - 1, middle + 1, middle + 3};
    return MacGrid<dim>(MPI_COMM_SELF, planes, periodic);
  }


  /// A surface at rest, whose velocity is 1 + x.
  template <int dim>
  MovedSurface<dim>
  at_rest(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    MovedSurface<dim> result{&surface, positions, positions, {}};
    for (const auto &x : positions)
      result.velocities.push_back(x + all_equal<dim>(1));
    return result;
  }


  template <int dim>
  FacetNodes<dim>
  nodes_of(const Bodies<dim> &bodies, const unsigned int facet)
  {
    FacetNodes<dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      result[k] = bodies.nodes[bodies.facets[facet][k]];
    return result;
  }


  /// Against every single facet: where a way crosses its plane, by determinants.
  template <int dim>
  double
  hit_by_brute_force(const Bodies<dim>        &bodies,
                     const dealii::Point<dim> &from,
                     const dealii::Point<dim> &to)
  {
    double result = std::numeric_limits<double>::infinity();
    for (unsigned int f = 0; f < bodies.facets.size(); ++f)
      {
        // from + t (to - from) = x_0 + sum_k l_k (x_k - x_0)
        const auto             nodes = nodes_of(bodies, f);
        dealii::Tensor<2, dim> matrix;
        for (unsigned int d = 0; d < dim; ++d)
          {
            matrix[d][0] = from[d] - to[d];
            for (unsigned int k = 1; k < dim; ++k)
              matrix[d][k] = nodes[k][d] - nodes[0][d];
          }
        const auto solution = invert(matrix) * (from - nodes[0]);
        double     rest     = 1;
        bool       inside   = solution[0] >= 0 && solution[0] <= 1;
        for (unsigned int k = 1; k < dim; ++k)
          {
            inside = inside && solution[k] >= 0;
            rest -= solution[k];
          }
        if (inside && rest >= 0)
          result = std::min(result, solution[0]);
      }
    return result;
  }


  template <int dim>
  void
  compare_hits(const Bodies<dim> &bodies, const double reach)
  {
    const auto                grid    = box_grid<dim>();
    const auto                surface = bodies.surface();
    const SurfaceQueries<dim> queries(grid, at_rest(surface, bodies.nodes));
    Random                    random(1);
    int                       hits = 0;
    for (int number = 0; number < 2000; ++number)
      {
        const auto   from  = random_point<dim>(random, 2);
        const auto   to    = from + random_point<dim>(random, reach);
        const double exact = hit_by_brute_force(bodies, from, to);
        const double found = queries.first_hit(from, to);
        if (exact <= 1)
          {
            ++hits;
            CHECK(found == Approx(exact).margin(1e-9));
          }
        else
          CHECK(found > 1);
      }
    CHECK(hits > 20);
  }


  /// Ways into a body around `middle` through its nodes and through points of its edges.
  template <int dim>
  void
  check_leaks(const Bodies<dim> &bodies, const double length, const double middle = 0)
  {
    const auto                grid    = box_grid<dim>({}, middle);
    const auto                centre  = all_equal<dim>(middle);
    const auto                surface = bodies.surface();
    const SurfaceQueries<dim> queries(grid, at_rest(surface, bodies.nodes));
    Random                    random(2);
    for (const auto &facet : bodies.facets)
      for (unsigned int k = 0; k < dim; ++k)
        for (const double share : {0., .5, random.between(0, 1)})
          {
            const auto &a = bodies.nodes[facet[k]], &b = bodies.nodes[facet[(k + 1) % dim]];
            const dealii::Point<dim> at       = a + share * (b - a);
            const auto               outwards = dealii::Point<dim>(at + length * (at - centre));
            const auto               inwards  = dealii::Point<dim>(at - length * (at - centre));
            CHECK(queries.first_hit(outwards, inwards) == Approx(.5).margin(1e-7));
            CHECK(queries.first_hit(inwards, outwards) == Approx(.5).margin(1e-7));
            CHECK(queries.first_hit(at, outwards) == Approx(0).margin(1e-7));
            CHECK(queries.first_hit(outwards, at) == Approx(1).margin(1e-7));
          }
  }


  template <int dim>
  void
  compare_velocities(const Bodies<dim> &bodies)
  {
    const auto                grid    = box_grid<dim>();
    const auto                surface = bodies.surface();
    const SurfaceQueries<dim> queries(grid, at_rest(surface, bodies.nodes));
    Random                    random(3);
    for (int number = 0; number < 500; ++number)
      {
        const auto place = random_point<dim>(random, 3);
        // The velocity names the point: x = velocity - 1.
        const auto nearest = queries.nearest_velocity(place) - all_equal<dim>(1);
        double     least   = 1e10;
        for (unsigned int f = 0; f < bodies.facets.size(); ++f)
          {
            const auto         nodes       = nodes_of(bodies, f);
            const auto         coordinates = nearest_point(nodes, place);
            dealii::Point<dim> x;
            for (unsigned int k = 0; k < dim; ++k)
              x += coordinates[k] * nodes[k];
            least = std::min(least, x.distance(place));
          }
        CHECK((nearest - place).norm() == Approx(least).epsilon(1e-12));
      }
  }


  /// A ball that moves by `way` and grows has passed over what one of its two places holds, and
  /// over what lies between them.
  template <int dim>
  void
  check_swept()
  {
    const auto        grid    = box_grid<dim>();
    const auto        bodies  = ball<dim>(3, 1);
    const auto        surface = bodies.surface();
    MovedSurface<dim> moved   = at_rest(surface, bodies.nodes);
    const auto        path    = .3 * dealii::Point<dim>::unit_vector(dim - 1);
    for (auto &x : moved.positions)
      x += path;
    const SurfaceQueries<dim> queries(grid, moved);
    Random                    random(5);
    int                       n_swept = 0;
    for (int number = 0; number < 3000; ++number)
      {
        const auto   place  = random_point<dim>(random, 1.5);
        const double before = place.norm(), after = (place - path).norm();
        // A chord of the facets lies within 2 % of the ball's radius.
        const bool inside_before = before < .95, inside_after = after < .95;
        const bool outside_before = before > 1, outside_after = after > 1;
        if ((inside_before && outside_after) || (inside_after && outside_before))
          {
            ++n_swept;
            CHECK(queries.is_freshly_cleared(place));
          }
        else if (inside_before && inside_after)
          CHECK_FALSE(queries.is_freshly_cleared(place));
        // Beyond both, and beside the way between them.
        const double along = std::clamp(place[dim - 1], 0., .3);
        if ((place - along * dealii::Point<dim>::unit_vector(dim - 1)).norm() > 1)
          CHECK_FALSE(queries.is_freshly_cleared(place));
      }
    CHECK(n_swept > 50);
  }


  /// What lies on the common sides of the simplices of neighbouring facets is not lost.
  template <int dim>
  void
  check_swept_without_gaps()
  {
    const auto        grid    = box_grid<dim>();
    const auto        bodies  = ball<dim>(1, 1);
    const auto        surface = bodies.surface();
    MovedSurface<dim> moved   = at_rest(surface, bodies.nodes);
    for (auto &x : moved.positions)
      x *= 1.5;
    const SurfaceQueries<dim> queries(grid, moved);
    for (const auto &facet : bodies.facets)
      for (unsigned int k = 0; k < dim; ++k)
        for (const double share : {0., .25, .5})
          for (const double factor : {1., 1.1, 1.25, 1.4, 1.5})
            {
              const auto &a = bodies.nodes[facet[k]], &b = bodies.nodes[facet[(k + 1) % dim]];
              CHECK(queries.is_freshly_cleared(dealii::Point<dim>(factor * (a + share * (b - a)))));
            }
    CHECK_FALSE(queries.is_freshly_cleared(dealii::Point<dim>()));
  }


  template <int dim>
  void
  check_periodic()
  {
    std::array<bool, dim> periodic{};
    periodic[0]        = true;
    const auto grid    = box_grid<dim>(periodic);
    const auto bodies  = ball<dim>(4, .5).shift(2. * dealii::Point<dim>::unit_vector(0));
    const auto surface = bodies.surface();
    const SurfaceQueries<dim> queries(grid, at_rest(surface, bodies.nodes));
    const auto                along = dealii::Point<dim>::unit_vector(0);
    const auto                at    = [&](const double x) { return dealii::Point<dim>(x * along); };
    CHECK(queries.first_hit(at(-2), at(-4)) == Approx(.75).epsilon(1e-2));    // image at -4
    CHECK(queries.first_hit(at(4), at(10)) == Approx(3.5 / 6).epsilon(1e-2)); // image at 8
    CHECK(queries.first_hit(at(-2), at(-3)) > 1);
    CHECK(queries.nearest_velocity(at(-2.9))[0] == Approx(3.5).epsilon(1e-2));
    CHECK(queries.nearest_velocity(at(-.6))[0] == Approx(2.5).epsilon(1e-2));
    CHECK(queries.nearest_velocity(at(20.9))[0] == Approx(3.5).epsilon(1e-2)); // 2.9 + 18
    CHECK_FALSE(queries.is_freshly_cleared(at(2)));
  }


  template <int dim>
  std::vector<Bodies<dim>>
  some_bodies()
  {
    Random                   random(9);
    std::vector<Bodies<dim>> result{ball<dim>(2, 1.5)};
    std::array<int, dim>     cells;
    cells.fill(3);
    result.push_back(lattice<dim>(cells, [](const dealii::Point<dim> &x) {
      auto y = dealii::Point<dim>(3. * (x - all_equal<dim>(.5)));
      y[dim - 1] /= 1000;
      return y;
    }));
    result.back().rotate(random);
    return result;
  }
} // namespace


TEST_CASE("First hits are those of all facets, one by one", "[interface]")
{
  for (const double reach : {.3, 4.})
    {
      for (const auto &bodies : some_bodies<2>())
        compare_hits(bodies, reach);
      for (const auto &bodies : some_bodies<3>())
        compare_hits(bodies, reach);
    }
}


TEST_CASE("No way into a body leads past its edges and nodes", "[interface]")
{
  for (const double length : {1e-3, .5})
    {
      check_leaks(ball<2>(3, 1.), length);
      check_leaks(ball<3>(2, 1.), length);
    }
  // Far from the origin, where coordinates have few digits left.
  check_leaks(ball<2>(3, 1.).shift(all_equal<2>(1000)), .01, 1000);
  check_leaks(ball<3>(2, 1.).shift(all_equal<3>(1000)), .01, 1000);
  // A cube whose faces, edges and nodes are met exactly.
  check_leaks(box<3>({-1, -1, -1}, {1, 1, 1}, {{2, 3, 4}}), .5);
}


TEST_CASE("Velocities of the nearest points", "[interface]")
{
  for (const auto &bodies : some_bodies<2>())
    compare_velocities(bodies);
  for (const auto &bodies : some_bodies<3>())
    compare_velocities(bodies);
}


TEST_CASE("What a moving surface has passed over", "[interface]")
{
  check_swept<2>();
  check_swept<3>();
  check_swept_without_gaps<2>();
  check_swept_without_gaps<3>();
}


TEST_CASE("Surfaces repeat in periodic directions", "[interface]")
{
  check_periodic<2>();
  check_periodic<3>();
}


TEST_CASE("Without bodies nothing is in the way", "[interface]")
{
  const auto              grid = box_grid<3>();
  const Surface<3>        surface(0, {}, {}, {});
  const SurfaceQueries<3> queries(grid, at_rest<3>(surface, {}));
  CHECK(queries.first_hit({0, 0, 0}, {1, 1, 1}) > 1);
  CHECK_FALSE(queries.is_freshly_cleared({0, 0, 0}));
  CHECK(queries.nearest_velocity({0, 0, 0}).norm() == 0);
}
