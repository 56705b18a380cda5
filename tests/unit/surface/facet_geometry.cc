// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/facet_geometry.h>

#include <catch2/catch.hpp>
#include <operators/immersed.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// The facet's nearest point against many points of the facet.
  template <int dim>
  void
  check_nearest_point()
  {
    Random random(4);
    for (int number = 0; number < 200; ++number)
      {
        FacetNodes<dim> nodes;
        for (auto &node : nodes)
          node = random_point<dim>(random, 1);
        const auto place       = random_point<dim>(random, 2);
        const auto coordinates = nearest_point(nodes, place);
        const auto distance    = [&](const std::array<double, dim> &c) {
          dealii::Point<dim> x;
          for (unsigned int k = 0; k < dim; ++k)
            x += c[k] * nodes[k];
          return x.distance(place);
        };
        double sum = 0;
        for (const double c : coordinates)
          {
            CHECK(c >= 0);
            sum += c;
          }
        CHECK(sum == Approx(1).epsilon(1e-12));
        const double found = distance(coordinates);
        for (int sample = 0; sample < 200; ++sample)
          {
            std::array<double, dim> other;
            double                  total = 0;
            for (double &c : other)
              total += c = random.power(-3, 0);
            for (double &c : other)
              c /= total;
            CHECK(distance(other) >= found - 1e-12);
          }
      }
  }


  /// The simplices fill the way of a facet without overlap: a random place in the prism between two
  /// parallel facets lies in it, one beside it does not.
  template <int dim>
  void
  check_prism()
  {
    Random random(6);
    for (int number = 0; number < 300; ++number)
      {
        FacetNodes<dim> before, after;
        const auto      path = random_point<dim>(random, 1);
        for (unsigned int k = 0; k < dim; ++k)
          {
            before[k] = random_point<dim>(random, 1);
            after[k]  = before[k] + path;
          }
        std::array<unsigned int, dim> order;
        for (unsigned int k = 0; k < dim; ++k)
          order[k] = (k + number) % dim;

        // sum_k l_k x_k + t way with sum_k l_k = 1; one of them may be negative.
        std::array<double, dim> share;
        double                  sum = 0;
        for (unsigned int k = 1; k < dim; ++k)
          sum += share[k] = random.between(-.3, 1);
        share[0]           = 1 - sum;
        const double along = random.between(-.3, 1.3);
        const bool   inside =
          along > 0 && along < 1 && *std::min_element(share.begin(), share.end()) > 0;
        dealii::Point<dim> place(along * path);
        for (unsigned int k = 0; k < dim; ++k)
          place += share[k] * before[k];
        CHECK(passes_over<dim>(before, after, order, place, 1e-14) == inside);
      }
  }
} // namespace


TEST_CASE("The nearest point of a facet is nearer than all others", "[interface]")
{
  check_nearest_point<2>();
  check_nearest_point<3>();
}


TEST_CASE("A facet passes over the prism between its places", "[interface]")
{
  check_prism<2>();
  check_prism<3>();
}


TEST_CASE("Ways that touch a facet, begin or end on it, meet it", "[interface]")
{
  const ThickFacet<3> facet(FacetNodes<3>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, 1e-13);
  const double        inf = std::numeric_limits<double>::infinity();
  CHECK(facet.first_hit({.2, .2, 1}, {.2, .2, -1}) == Approx(.5));
  CHECK(facet.first_hit({.2, .2, 0}, {.2, .2, -1}) == Approx(0).margin(1e-12));
  CHECK(facet.first_hit({.2, .2, 1}, {.2, .2, 0}) == Approx(1));
  CHECK(facet.first_hit({-1, .25, 0}, {1, .25, 0}) == Approx(.5)); // in its plane
  CHECK(facet.first_hit({.2, .2, 0}, {.3, .2, 0}) == 0);           // wholly on it
  CHECK(facet.first_hit({-1, 1, 0}, {1, -1, 0}) == Approx(.5));    // through a node
  CHECK(facet.first_hit({.2, .2, 1}, {.2, .2, 1e-6}) == inf);
  CHECK(facet.first_hit({.5, .5 + 1e-6, 1}, {.5, .5 + 1e-6, -1}) == inf);
  const ThickFacet<3> line(FacetNodes<3>{{{0, 0, 0}, {1, 0, 0}, {.5, 0, 0}}}, 1e-13);
  CHECK(line.first_hit({.2, 0, 1}, {.2, 0, -1}) == inf); // no area: its neighbours' task

  const ThickFacet<2> segment(FacetNodes<2>{{{0, 0}, {1, 0}}}, 1e-13);
  CHECK(segment.first_hit({1, 1}, {1, -1}) == Approx(.5));
  CHECK(segment.first_hit({-1, 0}, {1, 0}) == Approx(.5));
  CHECK(segment.first_hit({1 + 1e-6, 1}, {1 + 1e-6, -1}) == inf);
}
