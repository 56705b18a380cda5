// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_block.h>

#include <deal.II/base/mpi.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>

using namespace undine_tests;

namespace
{
  /// Are two lists alike to the bit, as `alike` says of their items?
  template <class List, class Alike>
  bool
  all_alike(const List &a, const List &b, const Alike &alike)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), alike);
  }


  template <class Piece>
  bool
  same_rims(const Piece &a, const Piece &b)
  {
    for (std::size_t side = 0; side < a.shape.rims.size(); ++side)
      if (a.shape.rims[side].length != b.shape.rims[side].length ||
          a.shape.rims[side].middle != b.shape.rims[side].middle)
        return false;
    return true;
  }

  template <int dim>
  bool
  same_cells(const CutCells<dim> &a, const CutCells<dim> &b)
  {
    using Cut = CutCells<dim>;
    return all_alike(a.cells,
                     b.cells,
                     [](const typename Cut::Cell &x, const typename Cut::Cell &y) {
                       return x.index == y.index && x.first_component == y.first_component &&
                              x.first_fragment == y.first_fragment && x.flags == y.flags;
                     }) &&
           all_alike(a.components,
                     b.components,
                     [](const typename Cut::Component &x, const typename Cut::Component &y) {
                       return x.cell == y.cell && x.volume == y.volume && x.centroid == y.centroid;
                     }) &&
           all_alike(a.fragments,
                     b.fragments,
                     [](const typename Cut::Fragment &x, const typename Cut::Fragment &y) {
                       return x.component == y.component && x.facet == y.facet &&
                              x.area_vector == y.area_vector && x.mean == y.mean &&
                              x.products == y.products;
                     }) &&
           a.corners.first == b.corners.first && a.corners.points == b.corners.points;
  }

  template <int dim>
  bool
  same_faces(const CutCells<dim> &a, const CutCells<dim> &b)
  {
    using Cut = CutCells<dim>;
    return all_alike(a.faces,
                     b.faces,
                     [](const typename Cut::Face &x, const typename Cut::Face &y) {
                       return x.axis == y.axis && x.index == y.index &&
                              x.first_piece == y.first_piece;
                     }) &&
           all_alike(
             a.pieces, b.pieces, [](const typename Cut::Piece &x, const typename Cut::Piece &y) {
               return x.face == y.face && x.area == y.area && x.centroid == y.centroid &&
                      x.components == y.components && same_rims(x, y);
             });
  }

  template <int dim>
  bool
  same_counts(const CutCells<dim> &a, const CutCells<dim> &b)
  {
    return a.counts.sampled_cells == b.counts.sampled_cells &&
           a.counts.sampled_faces == b.counts.sampled_faces &&
           a.counts.reordered_edges == b.counts.reordered_edges &&
           a.counts.debris == b.counts.debris && a.counts.closed_pieces == b.counts.closed_pieces &&
           a.counts.closure == b.counts.closure;
  }

  /// A ball and a wavy sheet that rest, a small ball that roams among them, and one that is large
  /// enough to lie around the first. Which nodes are whose follows from their order.
  template <int dim>
  struct Company
  {
    static constexpr unsigned int n_bodies = 4;

    explicit Company(Random &random)
    {
      add(ball<dim>(3, 1.2), .3, random);
      add(wave<dim>(random), .6, random);
      add(ball<dim>(2, .7), .8, random);
      add(ball<dim>(2, 3.), .55, random);
    }

    void
    add(Bodies<dim> body, const double share, Random &random)
    {
      begins.push_back(all.nodes.size());
      dealii::Tensor<1, dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = box_cells<dim>()[d] * (share + random.between(-.1, .1));
      all.append(body.without_parts().shift(place));
    }

    void
    move(const unsigned int body, const double path, Random &random)
    {
      dealii::Tensor<1, dim> shift;
      for (unsigned int d = 0; d < dim; ++d)
        shift[d] = random.between(-path, path);
      const auto end = body + 1 < n_bodies ? begins[body + 1] : all.nodes.size();
      for (auto node = begins[body]; node < end; ++node)
        all.nodes[node] += shift;
    }

    Bodies<dim>              all;
    std::vector<std::size_t> begins; ///< of the nodes of each body
  };
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "Cells in which nothing has moved are kept, and are those cut anew, to the bit",
  "[interface][mpi]",
  ((int dim), dim),
  2,
  3)
{
  int n_cached = 0, n_cut = 0;
  for (int trial = 0; trial < (dim == 2 ? 40 : 12); ++trial)
    {
      Random             random(trial);
      Company<dim>       company(random);
      const auto         grid_kind = trial % 2 == 0 ? Grid::unit : Grid::graded;
      const auto         planes    = make_planes(company.all, grid_kind, random).planes;
      const MacGrid<dim> grid(MPI_COMM_WORLD, planes, {});
      const auto         surface = company.all.surface();
      CutCells<dim>      cut(block_of_rank(grid));
      CutWorkspace<dim>  work;
      for (int step = 0; step < 30; ++step)
        {
          // The small ball mostly moves, the large one jumps now and then, the others hardly ever.
          const double size = planes[0].back() - planes[0].front();
          if (random.below(8) > 0)
            company.move(2, .03 * size, random);
          if (random.below(5) == 0)
            company.move(3, .3 * size, random);
          if (random.below(12) == 0)
            company.move(random.below(2), .05 * size, random);
          const PlacedSurface<dim> placed{surface, company.all.nodes};
          cut_block(cut, work, placed, grid.cells()->blocks());
          CutCells<dim>     anew(block_of_rank(grid));
          CutWorkspace<dim> nothing;
          cut_block(anew, nothing, placed, grid.cells()->blocks());
          INFO("trial " << trial << ", step " << step << ", kept " << work.cache.n_cached());
          REQUIRE(same_cells(cut, anew));
          REQUIRE(same_faces(cut, anew));
          REQUIRE(same_counts(cut, anew));
          REQUIRE(nothing.cache.n_cached() == 0);
          n_cached += work.cache.n_cached();
          n_cut += cut.cells.size();
        }
    }
  INFO("kept " << n_cached << " of " << n_cut);
  CHECK(10 * n_cached > n_cut);
}


TEST_CASE("Cells of another grid or of another surface are not kept", "[interface]")
{
  Random          random(1);
  Company<2>      company(random);
  const auto      planes = make_planes(company.all, Grid::unit, random).planes;
  const auto      grid   = std::make_shared<const GridPlanes<2>>(planes);
  const auto      block  = GridBlock<2>(grid, all_cells(*grid), 0);
  CutCells<2>     cut(block);
  CutWorkspace<2> work;
  const auto      surface   = company.all.surface();
  const auto      cut_again = [&](const Surface<2> &with) {
    cut_block(cut, work, {with, company.all.nodes});
    return work.cache.n_cached();
  };
  CHECK(cut_again(surface) == 0);
  CHECK(cut_again(surface) == 0);
  CHECK(cut_again(surface) > 10);
  auto fewer = company.all;
  fewer.facets.resize(fewer.facets.size() - ball<2>(2, 3.).facets.size());
  fewer.bodies.resize(fewer.facets.size());
  CHECK(cut_again(fewer.surface()) == 0);
  CHECK(cut_again(surface) == 0);
  cut_again(surface);
  CHECK(cut_again(surface) > 10);
  cut.block = GridBlock<2>(std::make_shared<const GridPlanes<2>>(planes), all_cells(*grid), 0);
  CHECK(cut_again(surface) == 0);
}
