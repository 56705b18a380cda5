// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/surface_queries.h>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <operators/immersed.h>

#include "stopwatch.h"

#include <iostream>
#include <memory>

using namespace undine_benchmarks;
using namespace undine_tests;

TEST_CASE("questions to a surface of 20,000 facets")
{
  const std::vector<double> along{-3, -1, 1, 3};
  const MacGrid<3>          grid(MPI_COMM_SELF, {{along, along, along}}, {});
  const auto                bodies  = ball<3>(5, 1);
  const auto                surface = bodies.surface();
  MovedSurface<3>           moved{&surface, bodies.nodes, bodies.nodes, {}};
  for (auto &x : moved.positions)
    {
      moved.velocities.push_back(x + all_equal<3>(1));
      x[0] += .01;
    }
  std::unique_ptr<const SurfaceQueries<3>> queries;
  const double                             set_up =
    seconds([&] { queries = std::make_unique<SurfaceQueries<3>>(grid, moved); });
  std::cout << fmt::format("{} facets: set-up {:.1f} ms\n", surface.facets().size(), 1e3 * set_up);

  Random                        random(1);
  const int                     n = 100000;
  std::vector<dealii::Point<3>> places, ends;
  for (int k = 0; k < n; ++k)
    {
      const auto direction = random_point<3>(random, 1);
      places.emplace_back(random.between(.9, 1.1) / direction.norm() * direction);
      ends.push_back(places.back() + random_point<3>(random, .05));
    }
  int        hits = 0, n_swept = 0;
  double     sum  = 0;
  const auto each = [&](const auto &ask) { // [us]
    return 1e6 / n * seconds([&] {
             for (int k = 0; k < n; ++k)
               ask(k);
           });
  };
  const double first_hit =
    each([&](const int k) { hits += queries->first_hit(places[k], ends[k]) <= 1; });
  const double swept = each([&](const int k) { n_swept += queries->is_freshly_cleared(places[k]); });
  const double nearest =
    each([&](const int k) { sum += queries->nearest_velocity(places[k]).norm(); });
  std::cout << fmt::format("first_hit {:.2f} us ({} hits), swept {:.2f} us ({}), nearest_velocity "
                           "{:.2f} us (mean {:.3f})\n",
                           first_hit,
                           hits,
                           swept,
                           n_swept,
                           nearest,
                           sum / n);
  CHECK(hits > 0);
  CHECK(n_swept > 0);
}
