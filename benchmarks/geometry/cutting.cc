// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <fmt/format.h>
#include <surface/balls.h>

#include "stopwatch.h"

#include <iostream>

using namespace undine_benchmarks;
using namespace undine_tests;

namespace
{
  /// A ball of diameter 0.7 n in n^dim unit cells, as in every step of a run: memory is there.
  template <int dim>
  void
  measure(const int n, const int level)
  {
    auto bodies = ball<dim>(level, .35 * n);
    for (auto &x : bodies.nodes)
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += .5 * n + .013 + .1 * d;
    Planes<dim> planes;
    for (auto &along : planes)
      for (int i = 0; i <= n; ++i)
        along.push_back(i);
    const auto        surface = bodies.surface();
    const auto        grid    = std::make_shared<const GridPlanes<dim>>(planes);
    CutCells<dim>     cut(GridBlock<dim>(grid, all_cells(*grid), 0));
    CutWorkspace<dim> work;
    const auto        once = [&] { cut_block<dim>(cut, work, {surface, bodies.nodes}); };
    once();
    const double time = least_seconds(once);
    std::cout << fmt::format(
      "{}D {:5} cells along an edge, {:7} facets, {:6} cut cells: {:7.2f} ms, {:7.2f} us "
      "per facet, {:5.2f} us per cut cell\n",
      dim,
      n,
      surface.facets().size(),
      cut.cells.size(),
      1e3 * time,
      1e6 * time / surface.facets().size(),
      1e6 * time / cut.cells.size());
    CHECK(cut.counts.closure <= 1e-12);
  }
} // namespace


TEST_CASE("a ball of more and more facets cuts finer and finer grids")
{
  for (const int n : {64, 128})
    for (int level = 3; level <= 7; ++level)
      measure<3>(n, level);
  for (const int n : {512, 2048})
    for (int level = 8; level <= 14; level += 3)
      measure<2>(n, level);
}


TEST_CASE("cells in which finely meshed bodies overlap")
{
  auto       bodies = ball<3>(5, 1.3);
  const auto other  = bodies;
  bodies.append(other);
  for (std::size_t i = 0; i < bodies.nodes.size(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      bodies.nodes[i][d] += 2.013 + .1 * d + (i < other.nodes.size() ? 0 : .45);
  const std::vector<double> along{0, 1, 2, 3, 4, 5};

  const auto      surface = bodies.surface();
  const auto      grid    = std::make_shared<const GridPlanes<3>>(Planes<3>{{along, along, along}});
  CutCells<3>     cut(GridBlock<3>(grid, all_cells(*grid), 0));
  CutWorkspace<3> work;
  const double    time = seconds([&] { cut_block<3>(cut, work, {surface, bodies.nodes}); });
  std::cout << fmt::format("{} facets, {} of {} cut cells sampled: {:.2f} ms per sampled cell\n",
                           surface.facets().size(),
                           cut.counts.sampled_cells,
                           cut.cells.size(),
                           1e3 * time / cut.counts.sampled_cells);
  CHECK(cut.counts.sampled_cells > 20);
}
