// SPDX-License-Identifier: LGPL-2.1-or-later
// Random configurations of bodies that cut a grid; `campaign_cut_cells --help` says how to use it.
#include <cutting/block_checks.h>
#include <cutting/trial.h>
#include <cutting/wrong_bodies.h>

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

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
} // namespace


int
main(int argc, char **argv)
{
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);

  int           count = 20;
  std::uint64_t seed  = 1;
  std::string   kind;
  CLI::App      app("Random configurations of bodies that cut a grid, in 2D and 3D, on unit and "
                    "graded grids. Exit code 1 if anything is wrong.");
  app.add_option("--count", count, "of every kind and grid")->capture_default_str();
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--kind", kind, "this kind only");
  const auto *blocks =
    app.add_subcommand("blocks", "blocks of ranks against the whole, bit by bit")->fallthrough();
  const auto *wrong =
    app.add_subcommand("wrong", "overlapping, folded, inverted and exploded bodies")->fallthrough();
  CLI11_PARSE(app, argc, argv);

  bool good = true;
  if (*blocks)
    {
      good = run_blocks<2>(count, seed);
      good = run_blocks<3>(count, seed) && good;
    }
  else if (*wrong)
    {
      run_wrong<2>(count, seed);
      run_wrong<3>(count, seed);
    }
  else
    {
      good = run<2>(count, seed, kind);
      good = run<3>(count, seed, kind) && good;
    }
  return good ? 0 : 1;
}
