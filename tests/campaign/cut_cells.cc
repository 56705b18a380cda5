// SPDX-License-Identifier: LGPL-2.1-or-later
// Random configurations of bodies, each kind COUNT times in 2D and in 3D, on unit and graded grids:
//   campaign_cut_cells COUNT SEED [KIND]
// With more than one rank blocks are compared with the whole, bit by bit. Exit code 1 if anything
// is wrong.
#include <interface/cut_checks.h>
#include <interface/kinds.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdio>

using namespace undine_tests;

namespace
{
  /// Totals over the configurations of one kind.
  struct Totals
  {
    Defects worst;
    double  closure = 0; ///< before debris is dropped
    int     n = 0, flagged = 0, sampled = 0, wrong_regions = 0, reordered = 0, debris = 0;

    void
    add(const Defects &defects)
    {
      worst.closure  = std::max(worst.closure, defects.closure);
      worst.linear   = std::max(worst.linear, defects.linear);
      worst.volume   = std::max(worst.volume, defects.volume);
      worst.moment   = std::max(worst.moment, defects.moment);
      worst.facets   = std::max(worst.facets, defects.facets);
      worst.smallest = std::min(worst.smallest, defects.smallest);
      worst.leaks += defects.leaks;
    }

    bool
    good() const
    {
      return worst.closure <= 1e-12 && worst.linear <= 1e-12 && worst.volume <= 1e-13 &&
             worst.moment <= 1e-12 && worst.facets <= 1e-12 && worst.leaks == 0 && flagged == 0 &&
             wrong_regions == 0;
    }
  };


  template <int dim>
  bool
  regions_differ(const CutCells<dim>      &cut,
                 const Configuration<dim> &configuration,
                 const double              unit)
  {
    const double negligible = 1e-13 * unit;
    auto         found      = fluid_regions(cut, negligible);
    if (configuration.regions.empty())
      return static_cast<int>(found.size()) != configuration.n_regions;
    // The outer region is whatever is left.
    std::vector<double> expected;
    for (const double volume : configuration.regions)
      if (volume * unit > negligible)
        expected.push_back(volume * unit);
    std::sort(expected.begin(), expected.end());
    if (found.size() != expected.size() + 1)
      return true;
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (std::abs(found[i] - expected[i]) > 1e-11 * unit)
        return true;
    return false;
  }


  template <int dim>
  bool
  run_kind(const Kind<dim> &kind, const Grid grid, const int count, const std::uint64_t seed)
  {
    Totals     totals;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < count; ++i)
      {
        Random     random(seed * 1000003 + i);
        auto       configuration = kind.make(random);
        auto      &bodies        = configuration.bodies;
        const auto stretched     = make_planes(bodies, grid, random);
        const auto surface       = bodies.surface();
        check_closed(surface, bodies.nodes);
        const auto   cut     = cut_all<dim>(stretched.planes, surface, bodies.nodes);
        const auto   defects = check_cut(cut, bodies, surface, random);
        const double unit    = stretched.volume;
        const bool   wrong   = regions_differ(cut, configuration, unit);
        int          flagged = 0;
        for (const auto &cell : cut.cells)
          flagged += cell.flags != 0;
        totals.add(defects);
        totals.closure = std::max(totals.closure, cut.counts.closure);
        ++totals.n;
        totals.flagged += flagged;
        totals.sampled += cut.counts.sampled_cells;
        totals.wrong_regions += wrong;
        totals.reordered += cut.counts.reordered_edges;
        totals.debris += cut.counts.debris;
        Totals one;
        one.add(defects);
        one.flagged       = flagged;
        one.wrong_regions = wrong;
        if (!one.good())
          std::printf(
            "  %s #%d: closure %.1e linear %.1e volume %.1e moment %.1e facets %.1e leaks %d "
            "flagged %d regions %zu of %d reordered %d\n",
            kind.name.c_str(),
            i,
            defects.closure,
            defects.linear,
            defects.volume,
            defects.moment,
            defects.facets,
            defects.leaks,
            flagged,
            fluid_regions(cut, 1e-13 * unit).size(),
            configuration.n_regions,
            cut.counts.reordered_edges);
      }
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    std::printf(
      "%dD %-7s%-16s n %6d closure %.1e (%.1e) linear %.1e volume %.1e moment %.1e facets "
      "%.1e smallest %.1e | flagged %d sampled %d leaks %d wrong regions %d | reordered %d "
      "debris %d %.1f s%s\n",
      dim,
      grid == Grid::unit ? "unit" : "graded",
      kind.name.c_str(),
      totals.n,
      totals.worst.closure,
      totals.closure,
      totals.worst.linear,
      totals.worst.volume,
      totals.worst.moment,
      totals.worst.facets,
      totals.worst.smallest,
      totals.flagged,
      totals.sampled,
      totals.worst.leaks,
      totals.wrong_regions,
      totals.reordered,
      totals.debris,
      time.count(),
      totals.good() ? "" : "  BAD");
    std::fflush(stdout);
    return totals.good();
  }


  template <int dim>
  bool
  run(const int count, const std::uint64_t seed, const std::string &name)
  {
    bool good = true;
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (const auto &kind : kinds<dim>())
        if (name.empty() || name == kind.name)
          good = run_kind(kind, grid, count, seed) && good;
    return good;
  }

  /// Microseconds for a ball in n^3 cells, as in the prototype's table.
  void
  measure_time()
  {
    for (const int n : {64, 128})
      for (const int level : {4, 5, 6})
        {
          auto body = ball<3>(level, n * .35);
          body.shift(dealii::Point<3>(n * .5 + .01, n * .5 + .02, n * .5 + .03));
          Planes<3> planes;
          for (auto &p : planes)
            for (int i = 0; i <= n; ++i)
              p.push_back(i);
          const auto      surface = body.surface();
          const auto      grid    = std::make_shared<const GridPlanes<3>>(planes);
          CutCells<3>     cut(GridBlock<3>(grid, all_cells(*grid), 0));
          CutWorkspace<3> work;
          double          best = 1e9;
          for (int repeat = 0; repeat < 5; ++repeat)
            {
              const auto start = std::chrono::steady_clock::now();
              cut_block(cut, work, {surface, body.nodes});
              const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
              best                                     = std::min(best, time.count());
            }
          std::printf(
            "n=%3d triangles %6zu cut cells %6zu fragments %6zu: %.1f ms = %.2f us/triangle, "
            "%.2f us/cut cell, %.2f us/fragment\n",
            n,
            surface.facets().size(),
            cut.cells.size(),
            cut.fragments.size(),
            1e3 * best,
            1e6 * best / surface.facets().size(),
            1e6 * best / cut.cells.size(),
            1e6 * best / cut.fragments.size());
        }
  }
} // namespace


int
main(int argc, char **argv)
{
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  if (argc > 1 && std::string(argv[1]) == "time")
    {
      measure_time();
      return 0;
    }
  const int           count = argc > 1 ? std::atoi(argv[1]) : 20;
  const std::uint64_t seed  = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::string   name  = argc > 3 ? argv[3] : "";
  bool                good  = run<2>(count, seed, name);
  good                      = run<3>(count, seed, name) && good;
  return good ? 0 : 1;
}
