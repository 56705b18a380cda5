// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/flush_facets.h>

#include <catch2/catch.hpp>
#include <operators/immersed.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  GridPlanes<dim>
  fifths()
  {
    std::array<std::vector<double>, dim> planes;
    for (auto &of_axis : planes)
      for (int i = 0; i <= 5; ++i)
        of_axis.push_back(i / 5.);
    return GridPlanes<dim>(planes);
  }


  /// Whether the body's lowest and highest nodes along axis 0, moved, lie beyond the planes 1 and
  /// 3, and all others where they were.
  template <int dim>
  bool
  is_just_beyond(const double lower, const double upper)
  {
    std::array<int, dim> cells;
    cells.fill(2);
    auto from = all_equal<dim>(.25), to = all_equal<dim>(.65);
    from[0]           = lower;
    to[0]             = upper;
    const auto bodies = box<dim>(dealii::Point<dim>(from), dealii::Point<dim>(to), cells);
    const auto planes = fifths<dim>();
    const auto moved  = beyond_planes(planes, bodies.surface(), bodies.nodes);
    bool       result = true;
    for (std::size_t node = 0; node < moved.size(); ++node)
      {
        const double x = bodies.nodes[node][0], now = moved[node][0];
        if (x == lower)
          result = result && planes.slab(0, now) == 0 && std::abs(now - x) <= 2e-4;
        else if (x == upper)
          result = result && planes.slab(0, now) == 3 && std::abs(now - x) <= 2e-4;
        else
          result = result && now == x;
        for (unsigned int d = 1; d < dim; ++d)
          result = result && moved[node][d] == bodies.nodes[node][d];
      }
    return result;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "What lies in a plane of the grid is cut just beyond it", "[interface]", ((int dim), dim), 2, 3)
{
  for (const double off : {-1.9e-4, -1e-9, 0., 1e-9, 1.9e-4})
    {
      INFO(off);
      CHECK(is_just_beyond<dim>(.2 + off, 3 / 5. - off));
    }
  CHECK_FALSE(is_just_beyond<dim>(.2 + 3e-4, 3 / 5.));
  CHECK_FALSE(is_just_beyond<dim>(.2, 3 / 5. - 3e-4));
}


TEST_CASE("Facets that face each other at a plane of the grid stay where they are", "[interface]")
{
  const auto planes = fifths<2>();
  // A slit around the plane .4 between two boxes, and the same with one box shifted aside.
  const auto moved = [&](const double aside) {
    auto bodies = box<2>({.25, .25}, {.4 - 1e-5, .65}, {{2, 2}});
    bodies.append(box<2>({.4 + 1e-5, .25 + aside}, {.55, .65 + aside}, {{2, 2}}));
    return beyond_planes(planes, bodies.surface(), bodies.nodes) != bodies.nodes;
  };
  CHECK_FALSE(moved(0.));
  CHECK(moved(.5));
}


TEST_CASE("Both sides of a thin plate at a plane of the grid are moved", "[interface]")
{
  // There is solid between them, not a gap that must stay open.
  const auto planes = fifths<2>();
  const auto plate  = box<2>({.4 + 1e-5, .25}, {.4 + 1.6e-4, .65}, {{1, 2}});
  const auto moved  = beyond_planes(planes, plate.surface(), plate.nodes);
  for (std::size_t node = 0; node < moved.size(); ++node)
    CHECK(planes.slab(0, moved[node][0]) == (plate.nodes[node][0] < .4 + 1e-4 ? 1 : 2));
}
