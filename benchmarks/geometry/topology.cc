// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <operators/immersed.h>

#include "stopwatch.h"

#include <iostream>

using namespace undine_benchmarks;
using namespace undine_tests;

TEST_CASE("20,000 triangles in a million cells: cut cells, open parts, forces")
{
  const auto         bodies  = ball<3>(5, .3).shift(all_equal<3>(.5));
  const auto         surface = bodies.surface();
  MacGrid<3>::Planes planes;
  for (auto &along : planes)
    for (int i = 0; i <= 100; ++i)
      along.push_back(i / 100.);
  const MacGrid<3> grid(MPI_COMM_WORLD, planes, {});
  CutCells<3>      cut(block_of_rank(grid));
  CutWorkspace<3>  work;
  for (int repetition = 0; repetition < 3; ++repetition)
    {
      const double cutting   = seconds([&] {
        cut_block(cut, work, {surface, bodies.nodes}, grid.cells()->blocks());
      });
      const double opening   = seconds([&] { make_cut_topology(grid, cut); });
      std::size_t  n_entries = 0;
      const double entries =
        seconds([&] { n_entries = BoundaryFlux<3>(cut, surface).entries().size(); });
      const BoundaryFlux<3>     flux(cut, surface);
      const std::vector<double> ones(cut.components.size(), 1.);
      const double              forces = seconds([&] {
        nodal_forces(flux, ones, MPI_COMM_WORLD);
        gravity_loads(
          cut, surface, bodies.nodes, ones, dealii::Point<3>::unit_vector(2), MPI_COMM_WORLD);
      });
      std::cout << fmt::format(
        "{} triangles, {} cut cells: cutting {:.1f} ms, open parts {:.1f} ms, "
        "{} entries {:.1f} ms, forces {:.1f} ms\n",
        surface.facets().size(),
        cut.cells.size(),
        1e3 * cutting,
        1e3 * opening,
        n_entries,
        1e3 * entries,
        1e3 * forces);
    }
  CHECK(cut.counts.closure <= 1e-12);
}
