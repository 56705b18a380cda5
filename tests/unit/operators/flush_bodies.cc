// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <operators/immersed.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A box in the unit cube that ends at `place` above or below along `axis`, in cells of 1/5.
  template <int dim>
  Immersed<dim>
  standing_box(const unsigned int axis, const int end, const double place)
  {
    typename MacGrid<dim>::Planes planes;
    for (auto &of_axis : planes)
      for (int i = 0; i <= 5; ++i)
        of_axis.push_back(i / 5.);
    std::array<int, dim> cells;
    cells.fill(2);
    auto lower = all_equal<dim>(.25), upper = all_equal<dim>(.65);
    (end == 0 ? lower : upper)[axis] = place;
    const auto bodies = box<dim>(dealii::Point<dim>(lower), dealii::Point<dim>(upper), cells);
    return Immersed<dim>(planes, bodies.surface(), bodies.nodes);
  }


  /// Whether the same is left of the grid, but for rounding.
  template <int dim>
  bool
  same_parts(const FluidTopology<dim> &a, const FluidTopology<dim> &b)
  {
    const auto same_measures = [](const auto &x, const auto &y) {
      if (x.all().size() != y.all().size())
        return false;
      for (std::size_t k = 0; k < x.all().size(); ++k)
        if (!(x.all()[k].index == y.all()[k].index) ||
            std::abs(x.all()[k].measure - y.all()[k].measure) > 1e-15 ||
            x.all()[k].place.distance(y.all()[k].place) > 1e-14)
          return false;
      return true;
    };
    bool result = same_measures(a.cells, b.cells);
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        result = result && same_measures(a.faces[axis], b.faces[axis]);
        for (std::size_t k = 0; k < a.pieces[axis].size() && result; ++k)
          result = std::abs(a.pieces[axis][k].volume - b.pieces[axis][k].volume) <= 1e-15 &&
                   a.pieces[axis][k].components == b.pieces[axis][k].components;
      }
    return result;
  }


  /// How many components there are, over all ranks.
  template <int dim>
  int
  count_components(const Immersed<dim> &immersed)
  {
    const auto &cells = immersed.open().cells;
    int         n     = 0;
    for (std::size_t k = 0; k < cells.all().size(); ++k)
      n += cells.owns(k);
    return dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
  }


  template <int dim>
  void
  check_sides()
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const int end : {0, 1})
        {
          INFO(dim << "D, axis " << axis << ", end " << end);
          const auto at = [&](const double gap) {
            return standing_box<dim>(axis, end, end == 0 ? gap : 1 - gap);
          };
          const auto beyond = at(-.3), flush = at(0);
          CHECK(same_parts(flush.open(), beyond.open()));
          CHECK(flush.cut.counts.sampled_cells == 0);
          // A gap of rounding size is none, all others are.
          CHECK(count_components(at(end == 0 ? 1e-17 : 2e-16)) == count_components(beyond));
          const int with_gap = count_components(at(.1));
          CHECK(with_gap > count_components(beyond));
          for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12})
            CHECK(count_components(at(gap)) == with_gap);
        }
  }
} // namespace


TEST_CASE("A body that stands on a side of the grid leaves what one leaves that reaches through",
          "[interface][mpi]")
{
  check_sides<2>();
  check_sides<3>();
}


TEST_CASE("A body that fills the grid leaves nothing", "[interface][mpi]")
{
  const auto check = [](auto &&immersed) {
    CHECK(count_components(immersed) == 0);
    CHECK(immersed.cut.pieces.empty());
  };
  const auto cube = [](auto dimension) {
    constexpr int                 dim = decltype(dimension)::value;
    typename MacGrid<dim>::Planes planes;
    for (auto &of_axis : planes)
      of_axis = {-1, -.5, 0, .5};
    std::array<int, dim> cells;
    cells.fill(3);
    const auto bodies = box<dim>(
      dealii::Point<dim>(all_equal<dim>(-1.)), dealii::Point<dim>(all_equal<dim>(.5)), cells);
    return Immersed<dim>(planes, bodies.surface(), bodies.nodes);
  };
  check(cube(std::integral_constant<int, 2>()));
  check(cube(std::integral_constant<int, 3>()));
}
