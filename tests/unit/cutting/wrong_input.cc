// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/cutting/cut_report.h>
#include <undine/cutting/sampled_regions.h>
#include <undine/surface/simplex.h>

#include <catch2/catch.hpp>
#include <cutting/wrong_bodies.h>

#include <limits>

using namespace undine_tests;
using Catch::Matchers::Contains;

namespace
{
  template <int dim>
  Surface<dim>
  without_first_facet(const Bodies<dim> &bodies)
  {
    auto fewer = bodies;
    fewer.facets.erase(fewer.facets.begin());
    fewer.bodies.erase(fewer.bodies.begin());
    return fewer.surface();
  }


  template <int dim>
  std::array<int, dim>
  cells_of_one()
  {
    std::array<int, dim> result;
    result.fill(1);
    return result;
  }


  template <int dim>
  void
  check_surfaces()
  {
    const auto body = box<dim>(all_equal<dim>(1.), all_equal<dim>(2.), cells_of_one<dim>());
    CHECK_NOTHROW(check_closed(body.surface(), body.nodes));
    CHECK_THROWS_WITH(check_closed(without_first_facet(body), body.nodes),
                      Contains("'body 0' is open"));

    auto twice = body;
    twice.append_to_body(body, 0);
    for (auto &facet : twice.facets)
      for (auto &node : facet)
        node %= body.nodes.size();
    CHECK_THROWS_WITH(check_closed(twice.surface(), twice.nodes), Contains("branches"));

    auto one_flipped = body;
    std::swap(one_flipped.facets[0][0], one_flipped.facets[0][1]);
    CHECK_THROWS_AS(check_closed(one_flipped.surface(), one_flipped.nodes), InputError);

    auto shared      = body;
    shared.bodies[0] = 1;
    shared.n_bodies  = 2;
    CHECK_THROWS_WITH(check_closed(shared.surface(), shared.nodes), Contains("another body"));

    auto degenerate         = body;
    degenerate.facets[0][1] = degenerate.facets[0][0];
    CHECK_THROWS_AS(degenerate.surface(), InputError);
    degenerate.facets[0][1] = 1000;
    CHECK_THROWS_AS(degenerate.surface(), InputError);
  }


  template <int dim>
  void
  check_inside_out()
  {
    auto body = ball<dim>(1, 2.);
    CHECK_NOTHROW(check_positions(body.surface(), body.nodes));
    body.flip();
    CHECK_THROWS_WITH(check_positions(body.surface(), body.nodes),
                      Contains("'body 0' is inside out"));
    auto nan  = body.nodes;
    nan[0][1] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(check_positions(body.surface(), nan), SolveError);
    Planes<dim> planes;
    planes.fill({0., 1., 2.});
    const auto surface = body.surface();
    CHECK_THROWS_AS(cut_all<dim>(planes, surface, nan), SolveError);
  }
} // namespace


TEST_CASE("Surfaces that are not closed are named", "[interface]")
{
  check_surfaces<2>();
  check_surfaces<3>();
}


TEST_CASE("Bodies that are inside out or nowhere are named", "[interface]")
{
  check_inside_out<2>();
  check_inside_out<3>();
}


TEST_CASE("Wrong bodies give results that are well formed", "[interface]")
{
  for (const auto &kind : wrong_kinds<2>())
    for (int number = 0; number < 20; ++number)
      CHECK_NOTHROW(try_wrong(kind, 3, number));
  for (const auto &kind : wrong_kinds<3>())
    for (int number = 0; number < 4; ++number)
      {
        const auto outcome = try_wrong(kind, 3, number);
        INFO(kind.name << ' ' << number << ": " << outcome.text());
        CHECK(outcome.closure <= 1e-13);
        if (kind.name != "overlapping balls")
          CHECK(outcome.flagged > 0);
      }
}


namespace
{
  /// Two boxes, of which the second reaches `overlap` into the upper x side of the first.
  Bodies<3>
  boxes(const double end, const double overlap)
  {
    auto bodies = box<3>({1.25, 1.25, 1.25}, {end, 3.25, 3.25}, {{1, 1, 1}});
    bodies.append(box<3>({end - overlap, 1.5, 1.5}, {4.25, 3.5, 3.5}, {{1, 1, 1}}));
    return bodies;
  }


  CutCells<3>
  cut_boxes(const Bodies<3> &bodies, const Surface<3> &surface)
  {
    Planes<3> planes;
    planes.fill({0., 1., 2., 3., 4., 5.});
    return cut_all<3>(planes, surface, bodies.nodes);
  }


  double
  fluid_volume(const CutCells<3> &cut)
  {
    double volume = 0;
    for (const double region : fluid_regions(cut, 0))
      volume += region;
    return volume;
  }
} // namespace


TEST_CASE("Overlaps with or without a node of the grid in them are sampled", "[interface]")
{
  for (const double end : {2.75, 3.25})
    for (const double overlap : {1e-8, .1, .5})
      {
        INFO("overlap of " << overlap << " up to " << end);
        const auto bodies  = boxes(end, overlap);
        const auto surface = bodies.surface();
        const auto cut     = cut_boxes(bodies, surface);
        const auto result  = report(cut, surface, MPI_COMM_SELF);
        CHECK(result.sampled_cells > 0);
        CHECK(result.sampled_cells < result.cut_cells);
        CHECK_THAT(result.message, Contains("'body 0' and 'body 1' overlap near ("));
        CHECK(cut.counts.closure <= 1e-13);
        for (const auto &piece : cut.pieces)
          CHECK(piece.area > 0);
        for (const auto &component : cut.components)
          CHECK(component.volume >= 0);

        // Samples give the volume of the union to a part of a sample in each direction.
        const double exact =
          125 - (end - 1.25) * 4 - (4.25 - end + overlap) * 4 + overlap * 1.75 * 1.75;
        CHECK(fluid_volume(cut) == Approx(exact).margin(.35));
      }
}


TEST_CASE("In sampled cells what lies in another body has no flux, the rest closes", "[interface]")
{
  const auto bodies  = boxes(3.25, .5);
  const auto surface = bodies.surface();
  const auto cut     = cut_boxes(bodies, surface);

  // Outlines of components, and the area of each body's side towards the other that is wet.
  std::vector<dealii::Tensor<1, 3>> defects(cut.components.size());
  std::array<double, 2>             wet{};
  for (const auto &piece : cut.pieces)
    for (const int end : {0, 1})
      if (const int c = piece.components[end]; c >= 0)
        defects[c][cut.faces[piece.face].axis] += (end == 0 ? 1 : -1) * piece.area;
  for (const auto &fragment : cut.fragments)
    if (fragment.component != cut.no_component)
      {
        const unsigned int body = surface.body(fragment.facet);
        const double       x    = bodies.nodes[surface.facets()[fragment.facet][0]][0];
        defects[fragment.component] += fragment.area_vector;
        const auto normal = area_vector(surface, fragment.facet, bodies.nodes);
        if (std::abs(normal[0]) > 0 && x == (body == 0 ? 3.25 : 2.75))
          wet[body] += std::abs(fragment.area_vector[0]);
      }
  for (const auto &defect : defects)
    CHECK(defect.norm() <= 1e-13);
  for (const double area : wet)
    CHECK(area == Approx(4 - 1.75 * 1.75).margin(.25));
}


TEST_CASE("An inverted body is flagged in every cell with a node in it", "[interface]")
{
  auto body = ball<2>(2, 1.2);
  body.flip();
  body.shift(dealii::Tensor<1, 2>({2., 2.}));
  Planes<2> planes;
  planes.fill({0., 1., 2., 3., 4.});
  const auto surface = body.surface();
  const auto result  = report(cut_all<2>(planes, surface, body.nodes), surface, MPI_COMM_SELF);
  CHECK(result.flagged_cells == result.cut_cells);
  CHECK_THAT(result.message, Contains("is inside out near ("));
}


namespace
{
  /// The facets [dim] of a wall across a unit box at this height along axis 0, with this normal.
  template <int dim>
  void
  add_wall(std::vector<typename SampledRegions<dim>::Simplex> &facets,
           const double                                        height,
           const double                                        normal)
  {
    const auto add = [&](const std::vector<std::array<double, 2>> &corners) {
      typename SampledRegions<dim>::Simplex facet;
      for (unsigned int k = 0; k < dim; ++k)
        {
          facet[k][0] = height;
          for (unsigned int d = 1; d < dim; ++d)
            facet[k][d] = corners[k][d - 1];
        }
      if (area_vector(facet)[0] * normal < 0)
        std::swap(facet[0], facet[1]);
      facets.push_back(facet);
    };
    if (dim == 3)
      {
        add({{{0, 0}}, {{1, 0}}, {{1, 1}}});
        add({{{0, 0}}, {{1, 1}}, {{0, 1}}});
      }
    else
      add({{{0, 0}}, {{1, 0}}});
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("What is thinner than samples are apart parts the fluid in sampled cells",
                       "[interface]",
                       ((int dim), dim),
                       2,
                       3)
{
  std::vector<typename SampledRegions<dim>::Simplex> facets;
  add_wall<dim>(facets, .699, -1);
  add_wall<dim>(facets, .701, 1);
  const SampledRegions<dim> sampled({}, dealii::Tensor<1, dim>(all_equal<dim>(1.)), {}, {}, facets);
  REQUIRE(sampled.regions().size() == 2);
  double least = 1, most = 0;
  for (const auto &region : sampled.regions())
    {
      least = std::min(least, region.volume);
      most  = std::max(most, region.volume);
    }
  CHECK(least == Approx(.3).margin(.1));
  CHECK(most == Approx(.7).margin(.1));
  auto below = all_equal<dim>(.5), above = below;
  below[0] = .698;
  above[0] = .702;
  CHECK(sampled.nearest(dealii::Point<dim>(dealii::Tensor<1, dim>(below))) !=
        sampled.nearest(dealii::Point<dim>(dealii::Tensor<1, dim>(above))));
}
