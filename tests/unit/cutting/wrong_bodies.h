// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_wrong_bodies_h
#define undine_tests_cutting_wrong_bodies_h

#include <undine/cutting/cut_flags.h>
#include <undine/cutting/cut_report.h>

#include <cutting/trial.h>

namespace undine_tests
{
  /// Bodies that no scene should have.
  template <int dim>
  std::vector<Kind<dim>>
  wrong_kinds()
  {
    const auto in_the_middle = [](Bodies<dim> bodies, Random &random) {
      place(bodies, random);
      return Configuration<dim>{bodies, {}, 0};
    };
    return {{"overlapping boxes",
             [=](Random &random) {
               const auto half   = all_equal<dim>(1.);
               auto       bodies = box<dim>(-half, half, random_cells<dim>(random, 4), &random);
               auto       other  = bodies;
               dealii::Tensor<1, dim> distance;
               distance[0] = 2 - random.power(-3, -.3);
               bodies.append(other.shift(distance));
               return in_the_middle(bodies.rotate(random), random);
             }},
            {"overlapping balls",
             [=](Random &random) {
               auto                   bodies = ball<dim>(2, 1.5), other = bodies;
               dealii::Tensor<1, dim> distance;
               distance[0] = 2.9;
               bodies.rotate(random).append(other.rotate(random).shift(distance));
               return in_the_middle(bodies, random);
             }},
            {"crumpled ball",
             [=](Random &random) {
               auto bodies = ball<dim>(3, 3.);
               for (auto &x : bodies.nodes)
                 for (unsigned int d = 0; d < dim; ++d)
                   x[d] += random.between(-.4, .4);
               return in_the_middle(bodies, random);
             }},
            {"random nodes",
             [=](Random &random) {
               auto bodies = ball<dim>(2, 1.);
               for (auto &x : bodies.nodes)
                 for (unsigned int d = 0; d < dim; ++d)
                   x[d] = random.between(.1, 9.9);
               return Configuration<dim>{bodies, {}, 0};
             }},
            {"inside out",
             [=](Random &random) {
               auto bodies = ball<dim>(2, 2.);
               bodies.flip();
               return in_the_middle(bodies, random);
             }},
            {"exploded", [=](Random &random) {
               auto bodies = ball<dim>(2, 2.);
               place(bodies, random);
               for (auto &x : bodies.nodes)
                 for (unsigned int d = 0; d < dim; ++d)
                   if (random.below(10) == 0)
                     x[d] = random.between(-1e9, 1e9);
               return Configuration<dim>{bodies, {}, 0};
             }}};
  }


  struct WrongOutcome
  {
    int    n = 0, flagged_configurations = 0;
    long   cells = 0, flagged = 0, sampled = 0;
    double closure = 0; ///< in cells that are not flagged

    void
    add(const WrongOutcome &other)
    {
      n += other.n;
      flagged_configurations += other.flagged_configurations;
      cells += other.cells;
      flagged += other.flagged;
      sampled += other.sampled;
      closure = std::max(closure, other.closure);
    }

    std::string
    text() const
    {
      char line[200];
      std::snprintf(
        line,
        sizeof(line),
        "%d configurations, %d flagged; %ld cut cells, %.1f %% flagged, %.1f %% sampled; "
        "closure elsewhere %.1e",
        n,
        flagged_configurations,
        cells,
        100. * flagged / std::max(1l, cells),
        100. * sampled / std::max(1l, cells),
        closure);
      return line;
    }
  };


  /// Cut bodies that are wrong. Every part of the result must still be well formed.
  template <int dim>
  WrongOutcome
  try_wrong(const Kind<dim> &kind, const std::uint64_t seed, const int number)
  {
    Random     random(seed * 1000003 + number);
    auto       bodies    = kind.make(random).bodies;
    const auto stretched = make_planes(bodies, number % 2 == 0 ? Grid::unit : Grid::graded, random);
    const auto surface   = bodies.surface();
    const auto cut       = cut_all<dim>(stretched.planes, surface, bodies.nodes);

    WrongOutcome outcome;
    outcome.n       = 1;
    outcome.cells   = cut.cells.size();
    outcome.sampled = cut.counts.sampled_cells;
    outcome.closure = cut.counts.closure;
    for (const auto &cell : cut.cells)
      outcome.flagged += cell.flags != 0;
    outcome.flagged_configurations = outcome.flagged > 0;
    const int  n_components        = cut.components.size();
    const auto expect              = [&](const bool condition) {
      if (!condition)
        throw std::runtime_error("malformed result of " + kind.name + ' ' + std::to_string(number));
    };
    for (const auto &fragment : cut.fragments)
      expect(fragment.component >= -1 && fragment.component < n_components &&
             std::isfinite(fragment.area_vector.norm()));
    for (const auto &piece : cut.pieces)
      for (const int c : piece.components)
        expect(c >= CutCells<dim>::uncut && c < n_components && std::isfinite(piece.area));
    for (const auto &component : cut.components)
      expect(std::isfinite(component.volume) && std::isfinite(component.centroid.norm()));
    return outcome;
  }
} // namespace undine_tests

#endif
