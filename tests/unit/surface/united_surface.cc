// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/united_surface.h>

#include <catch2/catch.hpp>
#include <surface/balls.h>

using namespace undine;
using namespace undine_tests;

namespace
{
  /// A box with lower corner `lower` and sides `sides`.
  template <int dim>
  Bodies<dim>
  box(const dealii::Point<dim> &lower, const dealii::Point<dim> &sides, Random &random)
  {
    std::array<int, dim> cells;
    for (int &n : cells)
      n = 1 + random.below(6);
    return lattice<dim>(
      cells,
      [&](dealii::Point<dim> x) {
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = lower[d] + sides[d] * x[d];
        return x;
      },
      &random);
  }


  template <int dim>
  double
  volume(const UnitedSurface<dim> &united)
  {
    double sum = 0;
    for (unsigned int facet = 0; facet < united.surface.facets().size(); ++facet)
      sum += area_vector(united.surface, facet, united.positions) *
             united.positions[united.surface.facets()[facet][0]] / dim;
    return sum;
  }


  /// The largest distance between corners of parts and where their coordinates say they are.
  template <int dim>
  double
  misplacement(const UnitedSurface<dim> &united, const Bodies<dim> &bodies)
  {
    double result = 0;
    for (unsigned int facet = 0; facet < united.parts.size(); ++facet)
      for (unsigned int k = 0; k < dim; ++k)
        {
          const auto        &part = united.parts[facet];
          dealii::Point<dim> place;
          for (unsigned int i = 0; i < dim; ++i)
            place += part.corners[k][i] * bodies.nodes[bodies.facets[part.facet][i]];
          const auto node = united.surface.facets()[facet][k];
          result          = std::max(result, place.distance(united.positions[node]));
        }
    return result;
  }


  /// Two boxes, of which the second, thinner one begins in the first, at any angle.
  template <int dim>
  void
  unite_boxes(Random &random)
  {
    dealii::Point<dim> lower, sides;
    double             size = 1, section = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = d == 0 ? random.between(.2, .9) : random.between(.1, .4);
        sides[d] = d == 0 ? random.between(1, 3) : random.between(.05, .5);
        size *= sides[d];
        section *= d == 0 ? 1 : sides[d];
      }
    auto bodies = box<dim>({}, all_equal<dim>(1), random);
    bodies.append(box<dim>(lower, sides, random));
    bodies.rotate(random);
    const auto united = united_surface<dim>(bodies.surface(), bodies.nodes, {{{0, 1}}});
    REQUIRE(united);
    CHECK(volume(*united) == Approx(1 + size - (1 - lower[0]) * section).epsilon(1e-12));
    CHECK(misplacement(*united, bodies) < 1e-13);
  }


  /// A ball and a bar through it at any angle: what both have in common, by inclusion and
  /// exclusion, is that of two half bars.
  template <int dim>
  void
  unite_ball_and_bars(Random &random)
  {
    const auto ball_with = [&](const double left, const double right, Random at_angle) {
      dealii::Point<dim> lower = all_equal<dim>(-.1), sides = all_equal<dim>(.2);
      lower[0] = left;
      sides[0] = right - left;
      Random shape(3);
      auto   bodies = ball<dim>(2, 1);
      bodies.rotate(at_angle);
      bodies.append(box<dim>(lower, sides, shape));
      const auto united = united_surface<dim>(bodies.surface(), bodies.nodes, {{{0, 1}}});
      REQUIRE(united);
      return volume(*united);
    };
    const double angle = random.below(1000);
    const Random same(angle);
    const double both  = ball_with(-2, 2.5, same);
    const double left  = ball_with(-2, .13, same);
    const double right = ball_with(.13, 2.5, same);
    CHECK(left + right - both == Approx(ball<dim>(2, 1).volume()).epsilon(1e-12));
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "The surface of a union has its volume, whatever the places", "[surface]", ((int dim), dim), 2, 3)
{
  Random random(5);
  for (unsigned int trial = 0; trial < 40; ++trial)
    {
      INFO(trial);
      unite_boxes<dim>(random);
      unite_ball_and_bars<dim>(random);
    }
}


TEMPLATE_TEST_CASE_SIG(
  "Bodies that do not cross are not united", "[surface]", ((int dim), dim), 2, 3)
{
  Random random(2);
  auto   lower = all_equal<dim>(.2);
  lower[0]     = 1.0001;
  auto bodies  = box<dim>({}, all_equal<dim>(1), random);
  bodies.append(box<dim>(lower, all_equal<dim>(.5), random));
  CHECK_FALSE(united_surface<dim>(bodies.surface(), bodies.nodes, {{{0, 1}}}));
}


TEMPLATE_TEST_CASE_SIG(
  "Where rounding decides a union is right or there is none", "[surface]", ((int dim), dim), 2, 3)
{
  Random       random(9);
  unsigned int n_united = 0, n_crossing = 0;
  for (unsigned int trial = 0; trial < 200; ++trial)
    {
      // Edges and nodes of one box lie in sides and edges of the other.
      dealii::Point<dim> lower, sides;
      double             size = 1, both = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = .25 * random.below(4);
          sides[d] = .25 * (1 + random.below(4));
          size *= sides[d];
          both *= std::min(1., lower[d] + sides[d]) - lower[d];
        }
      auto bodies = box<dim>({}, all_equal<dim>(1), random);
      bodies.append(box<dim>(lower, sides, random));
      if (random.below(2) == 1)
        bodies.rotate(random);
      INFO(trial);
      n_crossing += both > 0 && both < size;
      if (const auto united = united_surface<dim>(bodies.surface(), bodies.nodes, {{{0, 1}}}))
        {
          ++n_united;
          CHECK(volume(*united) == Approx(1 + size - both).epsilon(1e-6));
        }
    }
  INFO(n_united << " " << n_crossing);
  CHECK(n_united > .9 * n_crossing);
}
