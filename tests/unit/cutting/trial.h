// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_trial_h
#define undine_tests_cutting_trial_h

#include <cutting/cut_checks.h>
#include <cutting/kinds.h>

#include <cstdio>

namespace undine_tests
{
  /// What came out of cutting one configuration, or the worst of several.
  struct Outcome
  {
    Defects defects;
    double  closure       = 0; ///< before debris is dropped
    int     n             = 0;
    int     flagged       = 0; ///< cells
    int     wrong_regions = 0; ///< configurations in which the fluid has not the right parts
    int     reordered     = 0;
    int     debris        = 0;

    bool
    good() const
    {
      return closure <= 1e-12 && defects.closure <= 1e-12 && defects.halves <= 1e-11 &&
             defects.linear <= 1e-12 && defects.volume <= 1e-13 && defects.moment <= 1e-13 &&
             defects.facets <= 1e-12 && defects.smallest >= -1e-12 && defects.leaks == 0 &&
             flagged == 0 && wrong_regions == 0;
    }

    void
    add(const Outcome &other)
    {
      defects.closure  = std::max(defects.closure, other.defects.closure);
      defects.halves   = std::max(defects.halves, other.defects.halves);
      defects.linear   = std::max(defects.linear, other.defects.linear);
      defects.volume   = std::max(defects.volume, other.defects.volume);
      defects.moment   = std::max(defects.moment, other.defects.moment);
      defects.facets   = std::max(defects.facets, other.defects.facets);
      defects.smallest = std::min(defects.smallest, other.defects.smallest);
      defects.leaks += other.defects.leaks;
      closure = std::max(closure, other.closure);
      n += other.n;
      flagged += other.flagged;
      wrong_regions += other.wrong_regions;
      reordered += other.reordered;
      debris += other.debris;
    }

    std::string
    text() const
    {
      char line[300];
      std::snprintf(
        line,
        sizeof(line),
        "closure %.1e (%.1e) halves %.1e linear %.1e volume %.1e moment %.1e facets %.1e smallest "
        "%.1e leaks %d flagged %d wrong regions %d reordered %d debris %d",
        defects.closure,
        closure,
        defects.halves,
        defects.linear,
        defects.volume,
        defects.moment,
        defects.facets,
        defects.smallest,
        defects.leaks,
        flagged,
        wrong_regions,
        reordered,
        debris);
      return line;
    }
  };


  /// Whether the fluid has other connected parts than it should; `unit`: volume of a unit cube.
  template <int dim>
  bool
  regions_differ(const CutCells<dim>      &cut,
                 const Configuration<dim> &configuration,
                 const double              unit)
  {
    const double negligible = 1e-13 * unit;
    const auto   found      = fluid_regions(cut, negligible);
    if (configuration.regions.empty())
      return static_cast<int>(found.size()) != configuration.n_regions;
    // The outer region is whatever is left, and the largest.
    std::vector<double> expected;
    for (const double volume : configuration.regions)
      if (volume * unit > negligible)
        expected.push_back(volume * unit);
    std::sort(expected.begin(), expected.end());
    bool differ = found.size() != expected.size() + 1;
    for (std::size_t i = 0; i < expected.size() && !differ; ++i)
      differ = std::abs(found[i] - expected[i]) > 1e-11 * unit;
    return differ;
  }


  /// Configuration number `number` of a kind; always the same for the same seed.
  template <int dim>
  Outcome
  try_configuration(const Kind<dim>    &kind,
                    const Grid          grid,
                    const std::uint64_t seed,
                    const int           number)
  {
    Random     random(seed * 1000003 + number);
    auto       configuration = kind.make(random);
    auto      &bodies        = configuration.bodies;
    const auto stretched     = make_planes(bodies, grid, random);
    const auto surface       = bodies.surface();
    check_closed(surface, bodies.nodes);
    const auto cut = cut_all<dim>(stretched.planes, surface, bodies.nodes);

    Outcome outcome;
    outcome.n             = 1;
    outcome.defects       = check_cut(cut, bodies, surface, random);
    outcome.closure       = cut.counts.closure;
    outcome.wrong_regions = regions_differ(cut, configuration, stretched.volume);
    outcome.reordered     = cut.counts.reordered_edges;
    outcome.debris        = cut.counts.debris;
    for (const auto &cell : cut.cells)
      outcome.flagged += cell.flags != 0;
    return outcome;
  }
} // namespace undine_tests

#endif
