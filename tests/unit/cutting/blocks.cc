// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <cutting/block_checks.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  void
  compare_all_kinds(const int count)
  {
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (const auto &kind : kinds<dim>())
        for (int i = 0; i < count; ++i)
          {
            const auto comparison = compare_blocks(kind, grid, 5, i, MPI_COMM_WORLD);
            INFO(dim << "D " << kind.name << ' ' << i);
            CHECK(comparison.differences == 0);
            CHECK(comparison.cells > 0);
          }
  }
} // namespace


TEST_CASE("The block of a rank has a halo inside the domain", "[interface][mpi]")
{
  const MacGrid<2> grid(MPI_COMM_WORLD, {{{0., 1., 2., 3., 4.}, {0., .5, 1.5, 3.}}}, {});
  const auto       block = block_of_rank(grid);
  CHECK(block.owned() == grid.cells()->owned());
  for (unsigned int d = 0; d < 2; ++d)
    {
      CHECK(block.cells().lower[d] == std::max(0, block.owned().lower[d] - 1));
      CHECK(block.cells().upper[d] == std::min(grid.cells_along()[d], block.owned().upper[d] + 1));
    }
}


TEST_CASE("Blocks agree with the whole to the bit", "[interface][mpi]")
{
  compare_all_kinds<2>(5);
  compare_all_kinds<3>(2);
}
