// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/planar_regions.h>

#include <catch2/catch.hpp>

using namespace undine;

namespace
{
  using Place = std::array<double, 2>;


  /// Is a loop the rim of the face, or does it lie within?
  enum class Loop
  {
    rim,
    within
  };


  /// On which side of a loop the fluid is.
  enum class Fluid
  {
    inside,
    outside
  };


  /// Append the edges of a closed loop through `places`, with the fluid on its left.
  void
  add_loop(std::vector<PlanarEdge> &edges, const std::vector<Place> &places, const Loop loop)
  {
    const bool on_rim = loop == Loop::rim;
    const int  first = edges.size(), n = places.size();
    for (int i = 0; i < n; ++i)
      edges.push_back(
        {first + i, first + (i + 1) % n, first + i, on_rim, places[i], places[(i + 1) % n]});
  }


  std::vector<Place>
  square(const Place &middle, const double half, const Fluid fluid)
  {
    std::vector<Place> result{{{middle[0] - half, middle[1] - half}},
                              {{middle[0] + half, middle[1] - half}},
                              {{middle[0] + half, middle[1] + half}},
                              {{middle[0] - half, middle[1] + half}}};
    if (fluid == Fluid::outside)
      std::swap(result[1], result[3]);
    return result;
  }
} // namespace


TEST_CASE("A hole is cut out of the region around it", "[interface]")
{
  std::vector<PlanarEdge> edges;
  add_loop(edges, square({{.5, .5}}, .5, Fluid::inside), Loop::rim);
  add_loop(edges, square({{.25, .5}}, .125, Fluid::outside), Loop::within);
  PlanarProblem problem;
  CHECK(problem.find_regions(edges, 0, edges.size(), 1e-14) == 0);
  REQUIRE(problem.regions().size() == 1);
  const auto &region = problem.regions()[0];
  CHECK(region.area == Approx(1 - .0625));
  CHECK(region.centroid(0) == Approx((.5 - .0625 * .25) / (1 - .0625)));
  CHECK(region.centroid(1) == Approx(.5));
}


TEST_CASE("A hollow island has a region of its own, found by rays", "[interface]")
{
  std::vector<PlanarEdge> edges;
  add_loop(edges, square({{.5, .5}}, .5, Fluid::inside), Loop::rim);
  add_loop(edges, square({{.5, .5}}, .375, Fluid::outside), Loop::within);
  add_loop(edges, square({{.5, .5}}, .25, Fluid::inside), Loop::within);
  add_loop(edges, square({{.5, .5}}, .125, Fluid::outside), Loop::within);
  PlanarProblem problem;
  CHECK(problem.find_regions(edges, 0, edges.size(), 1e-14) == 0);
  REQUIRE(problem.regions().size() == 2);
  CHECK(problem.regions()[0].area == Approx(1 - .75 * .75));
  CHECK(problem.regions()[1].area == Approx(.25 - .0625));
  CHECK(edges[4].region == 0);
  CHECK(edges[12].region == 1);
}


TEST_CASE("Loops of rounding size are debris and join nothing", "[interface]")
{
  std::vector<PlanarEdge> edges;
  add_loop(edges, square({{.5, .5}}, .5, Fluid::inside), Loop::rim);
  add_loop(edges, square({{.25, .5}}, 1e-9, Fluid::outside), Loop::within);
  PlanarProblem problem;
  CHECK(problem.find_regions(edges, 0, edges.size(), 1e-14) == 0);
  REQUIRE(problem.regions().size() == 2);
  CHECK_FALSE(problem.regions()[0].debris);
  CHECK(problem.regions()[1].debris);
}


TEST_CASE("Outlines that do not close are flagged", "[interface]")
{
  std::vector<PlanarEdge> edges;
  add_loop(edges, square({{.5, .5}}, .5, Fluid::inside), Loop::rim);
  edges.pop_back();
  PlanarProblem problem;
  CHECK((problem.find_regions(edges, 0, edges.size(), 1e-14) & cut_loop) != 0);

  edges.clear();
  add_loop(edges, square({{.5, .5}}, .25, Fluid::outside), Loop::within);
  CHECK((problem.find_regions(edges, 0, edges.size(), 1e-14) & cut_nesting) != 0);
}
