// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/sampled_regions.h>
#include <undine/operators/dual_volumes.h>

#include <catch2/catch.hpp>
#include <cutting/trial.h>

using namespace undine_tests;

namespace
{
  /// n cells of width 1 along each axis.
  template <int dim>
  Planes<dim>
  unit_planes(const int n)
  {
    Planes<dim> planes;
    for (auto &p : planes)
      for (int i = 0; i <= n; ++i)
        p.push_back(i);
    return planes;
  }


  template <int dim>
  void
  try_all_kinds(const int count)
  {
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (const auto &kind : kinds<dim>())
        {
          Outcome total;
          for (int i = 0; i < count; ++i)
            total.add(try_configuration(kind, grid, 7, i));
          INFO(dim << "D " << kind.name << (grid == Grid::unit ? " unit: " : " graded: ")
                   << total.text());
          CHECK(total.n == count);
          CHECK(total.good());
        }
  }


  /// Integrals of p N_i n over the surface, node by node, n into the body: from the fragments, for
  /// a pressure that is linear in space.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  forces_on_fragments(const CutCells<dim>                                     &cut,
                      const Surface<dim>                                      &surface,
                      const std::vector<dealii::Point<dim>>                   &positions,
                      const std::function<double(const dealii::Point<dim> &)> &pressure)
  {
    std::vector<dealii::Tensor<1, dim>> forces(positions.size());
    for (const auto &fragment : cut.fragments)
      {
        const auto &nodes = surface.facets()[fragment.facet];
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            forces[nodes[i]] +=
              pressure(positions[nodes[j]]) * fragment.product(i, j) * fragment.area_vector;
      }
    return forces;
  }


  /// The same from the uncut facets, in closed form.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  forces_on_facets(const Surface<dim>                                      &surface,
                   const std::vector<dealii::Point<dim>>                   &positions,
                   const std::function<double(const dealii::Point<dim> &)> &pressure)
  {
    std::vector<dealii::Tensor<1, dim>> forces(positions.size());
    for (unsigned int f = 0; f < surface.facets().size(); ++f)
      for (const unsigned int i : surface.facets()[f])
        for (const unsigned int j : surface.facets()[f])
          forces[i] -= pressure(positions[j]) * (i == j ? 2. : 1.) / (dim * (dim + 1)) *
                       area_vector(surface, f, positions);
    return forces;
  }


  template <int dim>
  void
  check_forces(const std::string &name)
  {
    for (const auto &kind : kinds<dim>())
      if (kind.name == name)
        for (int number = 0; number < 10; ++number)
          {
            Random     random(number);
            auto       bodies    = kind.make(random).bodies;
            const auto stretched = make_planes(bodies, Grid::graded, random);
            const auto surface   = bodies.surface();
            const auto cut       = cut_all<dim>(stretched.planes, surface, bodies.nodes);
            for (unsigned int direction = 0; direction <= dim; ++direction)
              {
                const auto pressure = [&](const dealii::Point<dim> &x) {
                  return direction == dim ? 1. : x[direction];
                };
                const auto exact   = forces_on_facets<dim>(surface, bodies.nodes, pressure);
                const auto found   = forces_on_fragments<dim>(cut, surface, bodies.nodes, pressure);
                double     largest = 0, defect = 0;
                for (unsigned int node = 0; node < exact.size(); ++node)
                  {
                    largest = std::max(largest, exact[node].norm());
                    defect  = std::max(defect, (exact[node] - found[node]).norm());
                  }
                INFO(dim << "D " << name << ' ' << number << " direction " << direction);
                CHECK(defect <= 1e-12 * largest);
              }
          }
  }


  template <int dim>
  void
  check_dual_volumes(const std::string &name, const double smallest, const double largest)
  {
    for (const auto &kind : kinds<dim>())
      if (kind.name == name)
        for (int number = 0; number < 5; ++number)
          {
            Random     random(number);
            auto       bodies  = kind.make(random).bodies;
            const auto planes  = make_planes(bodies, Grid::unit, random).planes;
            const auto surface = bodies.surface();
            const auto cut     = cut_all<dim>(planes, surface, bodies.nodes);
            const auto dual    = dual_volumes(cut);
            INFO(dim << "D " << name << ' ' << number);

            // What pieces have, what they got from uncut cells and what components kept.
            dealii::Tensor<1, dim> balance = -1. * dual.added;
            for (std::size_t p = 0; p < cut.pieces.size(); ++p)
              {
                const auto &piece = cut.pieces[p];
                const auto  axis  = cut.faces[piece.face].axis;
                balance[axis] += dual.volumes[p];
                bool inside = true;
                for (const int c : piece.components)
                  {
                    balance[axis] -= c == cut.uncut ? piece.area / 2 : 0;
                    inside = inside && c != cut.outside;
                  }
                if (inside)
                  {
                    CHECK(dual.volumes[p] >= smallest * piece.area);
                    CHECK(dual.volumes[p] <= largest * piece.area);
                  }
              }
            for (std::size_t c = 0; c < cut.components.size(); ++c)
              for (unsigned int axis = 0; axis < dim; ++axis)
                balance[axis] += dual.unassigned[c][axis] - std::max(0., cut.components[c].volume);
            CHECK(balance.norm() <= 1e-12);
          }
  }
} // namespace


TEST_CASE("Random bodies cut cells exactly", "[interface]")
{
  try_all_kinds<2>(40);
  try_all_kinds<3>(12);
}


TEST_CASE("A square that covers a quarter of four cells", "[interface]")
{
  const auto body    = box<2>({1.5, 1.5}, {2.5, 2.5}, {{1, 1}});
  const auto surface = body.surface();
  const auto cut     = cut_all<2>(unit_planes<2>(4), surface, body.nodes);
  REQUIRE(cut.cells.size() == 4);
  REQUIRE(cut.components.size() == 4);
  for (const auto &component : cut.components)
    CHECK(component.volume == Approx(.75).margin(1e-15));
  CHECK(cut.components[0].centroid[0] == Approx(1 + (.5 - .75 * .25) / .75).margin(1e-14));
  REQUIRE(cut.cut_face(0, {{2, 1}}) >= 0);
  const auto &piece = cut.pieces[cut.faces[cut.cut_face(0, {{2, 1}})].first_piece];
  CHECK(piece.area == .5);
  CHECK(piece.centroid == dealii::Point<2>(2, 1.25));
  CHECK(piece.components == std::array<int, 2>{{0, 1}});
  CHECK(cut.cut_cell({{0, 0}}) == -1);
  CHECK_FALSE(cut.in_solid({{0, 0}}));
}


TEST_CASE("Cells that bodies cover are solid, outside ones fluid", "[interface]")
{
  const auto body    = box<3>({1.5, 1.5, 1.5}, {4.5, 4.5, 4.5}, {{2, 2, 2}});
  const auto surface = body.surface();
  const auto cut     = cut_all<3>(unit_planes<3>(6), surface, body.nodes);
  CHECK(cut.cells.size() == 4 * 4 * 4 - 2 * 2 * 2);
  for_each(cut.block.cells(), [&](const GridIndex<3> &cell) {
    int inside = 0, outside = 0;
    for (unsigned int d = 0; d < 3; ++d)
      {
        inside += cell[d] == 2 || cell[d] == 3;
        outside += cell[d] == 0 || cell[d] == 5;
      }
    const bool uncut = inside == 3 || outside > 0;
    REQUIRE((cut.cut_cell(cell) < 0) == uncut);
    if (uncut)
      REQUIRE(cut.in_solid(cell) == (inside == 3));
  });
}


TEST_CASE("A sheet thinner than rounding lets nothing through", "[interface]")
{
  for (const double thickness : {1e-12, 1e-6, 1e-2, .5, 1., 2.})
    for (const double offset : {0., .5, .3, 1e-12})
      {
        INFO("thickness " << thickness << " offset " << offset);
        const auto body = box<3>({1 + offset, -1, -1}, {1 + offset + thickness, 5, 5}, {{1, 3, 2}});
        const auto surface = body.surface();
        const auto cut     = cut_all<3>(unit_planes<3>(4), surface, body.nodes);
        const auto regions = fluid_regions(cut, 1e-13);
        REQUIRE(regions.size() == 2);
        const double lower = (1 + offset) * 16, upper = (3 - offset - thickness) * 16;
        CHECK(regions[0] == Approx(std::min(lower, upper)).epsilon(1e-13));
        CHECK(regions[1] == Approx(std::max(lower, upper)).epsilon(1e-13));
      }
}


TEST_CASE("Forces of linear pressures do not depend on the cells", "[interface]")
{
  for (const auto &name : {"ball", "wave", "snapped star", "nested bodies", "egg box"})
    {
      check_forces<2>(name);
      check_forces<3>(name);
    }
}


TEST_CASE("Dual volumes add up to the fluid", "[interface]")
{
  check_dual_volumes<2>("ball", .1, 2);
  check_dual_volumes<3>("ball", .1, 2);
  check_dual_volumes<2>("hairpin", .049, 4);
  check_dual_volumes<3>("wave", .049, 4);
  check_dual_volumes<3>("aligned box", .049, 4);
}


TEST_CASE("Samples agree with exact volumes", "[interface]")
{
  // What wrong bodies fall back on, on right ones: an independent count of the fluid. Where planes
  // of the grid touch bodies' corners whole cells must not be taken for the other side.
  for (const auto &kind : kinds<3>())
    {
      double difference = 0, worst = 0;
      int    n = 0;
      for (int number = 0; number < 8; ++number)
        {
          Random     random(number);
          auto       bodies  = kind.make(random).bodies;
          const auto planes  = make_planes(bodies, Grid::unit, random).planes;
          const auto surface = bodies.surface();
          const auto cut     = cut_all<3>(planes, surface, bodies.nodes);
          for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
            {
              double defect = 0;
              for (int c = cut.cells[cell].first_component; c < cut.end_component(cell); ++c)
                defect += cut.components[c].volume;
              const auto fluid = sample_fluid(cut, cell);
              for (const auto &region : fluid.regions())
                defect -= region.volume;
              difference += std::abs(defect);
              worst = std::max(worst, std::abs(defect));
              ++n;
            }
        }
      INFO(kind.name << ' ' << n << " cells, mean difference " << difference / n << ", worst "
                     << worst);
      CHECK(n > 40);
      CHECK(difference / n < .021);
      CHECK(worst < .13); // the distance of samples
    }
}


TEST_CASE("Bodies that leave the domain: fluid and complement fill it", "[interface]")
{
  for (int number = 0; number < 40; ++number)
    {
      Random random(number);
      auto   body = number % 2 == 0 ? ball<3>(random.below(3), random.between(.5, 6))
                                    : box<3>({-3, -3, -3}, {3, 3, 3}, {{2, 3, 4}}, &random);
      if (number % 4 > 0)
        body.rotate(random);
      body.shift(
        dealii::Tensor<1, 3>({3 * offset(random), 3 * offset(random), 2 * offset(random)}));
      auto complement = box<3>({-30, -30, -30}, {40, 40, 40}, {{1, 1, 1}});
      complement.append_cavity(body);
      double volume = -6 * 6 * 6;
      for (const auto *bodies : {&body, &complement})
        {
          const auto surface = bodies->surface();
          const auto cut     = cut_all<3>(unit_planes<3>(6), surface, bodies->nodes);
          CHECK(cut.counts.closure <= 1e-13);
          for (const double region : fluid_regions(cut, 0))
            volume += region;
        }
      INFO(number);
      CHECK(std::abs(volume) <= 1e-12);
    }
}
