// SPDX-License-Identifier: LGPL-2.1-or-later
// Random configurations of bodies that cut a grid. Exit code 1 if anything is wrong.
//   campaign_cut_cells COUNT SEED [KIND]   COUNT of every kind, in 2D and 3D, on unit and graded
//   grids campaign_cut_cells blocks COUNT SEED   blocks against the whole, bit by bit; on several
//   ranks campaign_cut_cells wrong COUNT SEED    overlapping, folded, inverted and exploded bodies
//   campaign_cut_cells time                microseconds for a ball, as triangles and cells grow
#include <interface/block_checks.h>
#include <interface/trial.h>
#include <interface/wrong_bodies.h>

#include <deal.II/base/mpi.h>

#include <chrono>

using namespace undine_tests;

namespace
{
  class Stopwatch
  {
  public:
    double
    seconds() const
    {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

  private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  };


  const char *
  name(const Grid grid)
  {
    return grid == Grid::unit ? "unit" : "graded";
  }


  template <int dim>
  bool
  run(const int count, const std::uint64_t seed, const std::string &only)
  {
    bool good = true;
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (const auto &kind : kinds<dim>())
        {
          if (!only.empty() && only != kind.name)
            continue;
          const Stopwatch stopwatch;
          Outcome         total;
          for (int i = 0; i < count; ++i)
            {
              const auto outcome = try_configuration(kind, grid, seed, i);
              total.add(outcome);
              if (!outcome.good())
                std::printf("  BAD %s %d: %s\n", kind.name.c_str(), i, outcome.text().c_str());
            }
          std::printf("%dD %-6s %-16s %6d: %s  %.1f s\n",
                      dim,
                      name(grid),
                      kind.name.c_str(),
                      total.n,
                      total.text().c_str(),
                      stopwatch.seconds());
          std::fflush(stdout);
          good = good && total.good();
        }
    return good;
  }


  template <int dim>
  bool
  run_blocks(const int count, const std::uint64_t seed)
  {
    BlockComparison total;
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (const auto &kind : kinds<dim>())
        for (int i = 0; i < count; ++i)
          total.add(compare_blocks(kind, grid, seed, i, MPI_COMM_WORLD));
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::printf("%dD blocks on %u ranks: %d configurations, %ld cells, %ld pieces, %ld windings "
                  "compared, %ld differences\n",
                  dim,
                  dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                  total.n,
                  total.cells,
                  total.pieces,
                  total.windings,
                  total.differences);
    return total.differences == 0;
  }


  template <int dim>
  void
  run_wrong(const int count, const std::uint64_t seed)
  {
    for (const auto &kind : wrong_kinds<dim>())
      {
        const Stopwatch stopwatch;
        WrongOutcome    total;
        for (int i = 0; i < count; ++i)
          total.add(try_wrong(kind, seed, i));
        std::printf("%dD %-20s %s  %.1f s\n",
                    dim,
                    kind.name.c_str(),
                    total.text().c_str(),
                    stopwatch.seconds());
      }
  }


  template <int dim>
  void
  measure_time(const int n, const int level)
  {
    auto                   body = ball<dim>(level, n * .35);
    dealii::Tensor<1, dim> distance;
    Planes<dim>            planes;
    for (unsigned int d = 0; d < dim; ++d)
      {
        distance[d] = n * .5 + .01 * (d + 1);
        for (int i = 0; i <= n; ++i)
          planes[d].push_back(i);
      }
    body.shift(distance);
    const auto        surface = body.surface();
    const auto        grid    = std::make_shared<const GridPlanes<dim>>(planes);
    CutCells<dim>     cut(GridBlock<dim>(grid, all_cells(*grid), 0));
    CutWorkspace<dim> work;
    double            best = 1e9;
    for (int repeat = 0; repeat < 7; ++repeat)
      {
        const Stopwatch stopwatch;
        cut_block(cut, work, {surface, body.nodes});
        best = std::min(best, stopwatch.seconds());
      }
    std::printf(
      "%dD n=%3d facets %6zu cut cells %6zu fragments %6zu: %.2f ms = %.2f us/facet, %.2f "
      "us/cut cell, %.2f us/fragment\n",
      dim,
      n,
      surface.facets().size(),
      cut.cells.size(),
      cut.fragments.size(),
      1e3 * best,
      1e6 * best / surface.facets().size(),
      1e6 * best / cut.cells.size(),
      1e6 * best / cut.fragments.size());
  }
} // namespace


int
main(int argc, char **argv)
{
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);

  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto                     argument = [&](const std::size_t i) {
    return i < arguments.size() ? arguments[i] : "";
  };
  const auto number = [&](const std::size_t i, const int otherwise) {
    return i < arguments.size() ? std::stoi(arguments[i]) : otherwise;
  };
  bool good = true;
  if (argument(0) == "time")
    {
      for (const int level : {6, 8, 10})
        measure_time<2>(256, level);
      for (const int n : {64, 128})
        for (const int level : {4, 5, 6})
          measure_time<3>(n, level);
    }
  else if (argument(0) == "blocks")
    {
      good = run_blocks<2>(number(1, 20), number(2, 1));
      good = run_blocks<3>(number(1, 20), number(2, 1)) && good;
    }
  else if (argument(0) == "wrong")
    {
      run_wrong<2>(number(1, 20), number(2, 1));
      run_wrong<3>(number(1, 20), number(2, 1));
    }
  else
    {
      good = run<2>(number(0, 20), number(1, 1), argument(2));
      good = run<3>(number(0, 20), number(1, 1), argument(2)) && good;
    }
  return good ? 0 : 1;
}
