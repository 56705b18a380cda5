// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/interpolation.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

#include <map>
#include <set>

using namespace undine_tests;

namespace
{
  /// Planes that are not at equal distances.
  template <int dim>
  typename MacGrid<dim>::Planes
  graded_planes()
  {
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      for (int i = 0; i <= 7 + int(d); ++i)
        planes[d].push_back(std::pow(i / (7. + d), 1.3) * (1 + d));
    return planes;
  }


  template <int dim>
  std::array<bool, dim>
  first_axis_periodic()
  {
    std::array<bool, dim> periodic{};
    periodic[0] = true;
    return periodic;
  }


  template <int dim>
  std::vector<std::shared_ptr<const Lattice<dim>>>
  lattices(const MacGrid<dim> &grid)
  {
    std::vector<std::shared_ptr<const Lattice<dim>>> result{grid.cells()};
    for (unsigned int axis = 0; axis < dim; ++axis)
      result.push_back(grid.faces(axis));
    return result;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "every point has one owner and one number", "[fields][mpi]", ((int dim), dim), 2, 3)
{
  const MacGrid<dim> grid(MPI_COMM_WORLD, graded_planes<dim>(), first_axis_periodic<dim>());
  for (const auto &lattice : lattices(grid))
    {
      std::set<dealii::types::global_dof_index> numbers;
      for_each(IndexBox<dim>{{}, lattice->shape()},
               [&](const GridIndex<dim> &index) { numbers.insert(lattice->number(index)); });
      CHECK(numbers.size() == lattice->n_points());
      CHECK(*numbers.rbegin() + 1 == lattice->n_points());
      CHECK(dealii::Utilities::MPI::sum(lattice->owned().size(), MPI_COMM_WORLD) ==
            lattice->n_points());
      const auto owned    = lattice->owned_numbers();
      auto       expected = owned.begin();
      for_each(lattice->owned(), [&](const GridIndex<dim> &index) {
        REQUIRE(lattice->number(index) == *expected++);
      });
    }
}


TEMPLATE_TEST_CASE_SIG("ghost layers of any width hold the values of their owners",
                       "[fields][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const MacGrid<dim> grid(MPI_COMM_WORLD, graded_planes<dim>(), first_axis_periodic<dim>());
  for (const auto &lattice : lattices(grid))
    for (const int width : {0, 1, 3, 20})
      {
        Field<dim> field(lattice);
        fill_scattered(field, 5);
        field.exchange(width);
        std::size_t checked = 0;
        for_each(field.stored(), [&](const GridIndex<dim> &index) {
          bool is_point = true;
          for (unsigned int d = 0; d < dim; ++d)
            is_point = is_point && (lattice->row(d).periodic() ||
                                    (index[d] >= 0 && index[d] < lattice->shape()[d]));
          if (!is_point)
            return;
          REQUIRE(field(index) == scatter<dim>(lattice->wrapped(index), 5));
          ++checked;
        });
        CHECK(checked >= lattice->owned().size());
        // The periodic direction stretches by exactly the width on both sides.
        CHECK(field.stored().upper[0] - lattice->owned().upper[0] == width);
        CHECK(lattice->owned().lower[0] - field.stored().lower[0] == width);
      }
}


TEST_CASE("a narrow exchange after a wide one leaves no stale values", "[fields][mpi]")
{
  const MacGrid<2> grid(MPI_COMM_WORLD, graded_planes<2>(), first_axis_periodic<2>());
  Field<2>         field(grid.faces(1));
  fill_scattered(field, 1);
  field.exchange(3);
  fill_scattered(field, 2);
  field.exchange(1);
  const GridIndex<2> beside = moved<2>(field.owned().lower, 0, -1);
  CHECK(field(beside) == scatter<2>(grid.faces(1)->wrapped(beside), 2));
}


TEST_CASE("owned values come back as they were written", "[fields][mpi]")
{
  const MacGrid<3> grid(MPI_COMM_WORLD, graded_planes<3>(), first_axis_periodic<3>());
  Field<3>         field(grid.faces(2)), copy(grid.faces(2));
  fill_scattered(field, 3);
  field.exchange(2);
  copy.set_owned_values(field.owned_values());
  for_each(field.owned(), [&](const GridIndex<3> &index) { REQUIRE(copy(index) == field(index)); });
}


TEST_CASE("blocks are balanced and fit every rank count", "[fields]")
{
  const GridIndex<3> cells{{10, 7, 5}};
  const Blocks<3>    one(MPI_COMM_SELF, cells, {});
  CHECK(one.cells_of_rank(0) == IndexBox<3>{{}, cells});
  for (int n = 1; n <= 12; ++n)
    for (int blocks = 1; blocks <= n; ++blocks)
      for (int cell = 0; cell < n; ++cell)
        {
          // The formulas of Blocks, for any number of blocks along one direction.
          const int block = ((cell + 1) * blocks - 1) / n;
          REQUIRE(block * n / blocks <= cell);
          REQUIRE((block + 1) * n / blocks > cell);
        }
}


TEST_CASE("rows find the points around a place", "[fields]")
{
  const std::vector<double> planes{0, 0.1, 0.3, 0.6, 1};
  for (const auto ends : {Row::Ends::bounded, Row::Ends::periodic})
    for (const auto &row : {Row::of_planes(planes, ends), Row::of_centres(planes, ends)})
      for (double place = row.periodic() ? -2.7 : 0.; place < (row.periodic() ? 3.7 : 1.);
           place += 0.013)
        {
          const auto   bracket = row.locate(place);
          const double below   = row.position(bracket.lower);
          const double above   = row.position(bracket.lower + 1);
          REQUIRE(below <= place + 1e-14);
          REQUIRE(above >= place - 1e-14);
          REQUIRE(below + bracket.weight * (above - below) == Approx(place).margin(1e-14));
        }
  const auto centres = Row::of_centres(planes, Row::Ends::bounded);
  CHECK(centres.position(-1) == 0);
  CHECK(centres.position(4) == 1);
  CHECK(centres.locate(7.).lower == 3);
  CHECK(centres.locate(7.).weight == 1);
}


TEST_CASE("a way never crosses more planes than promised", "[fields]")
{
  const auto       planes = graded_planes<2>();
  const MacGrid<2> grid(MPI_COMM_SELF, planes, first_axis_periodic<2>());
  for (const double length : {0.01, 0.3, 0.9, 2.6})
    {
      const auto crossed = grid.planes_crossed(dealii::Tensor<1, 2>({length, length}));
      for (double from = 0; from < 1; from += 0.003)
        for (unsigned int d = 0; d < 2; ++d)
          {
            const auto  &row = grid.faces(d)->row(d);
            const double to  = from * planes[d].back() + length;
            if (d == 1 && to > planes[d].back())
              continue;
            REQUIRE(row.locate(to).lower - row.locate(to - length).lower <= crossed[d]);
          }
    }
}


TEMPLATE_TEST_CASE_SIG("interpolation is exact for linear fields on graded grids",
                       "[fields][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const MacGrid<dim> grid(MPI_COMM_WORLD, graded_planes<dim>(), {});
  const auto         linear = [](const dealii::Point<dim> &place) {
    double value = 1;
    for (unsigned int d = 0; d < dim; ++d)
      value += (2 + d) * place[d];
    return value;
  };
  for (const auto &lattice : lattices(grid))
    {
      Field<dim> field(lattice);
      field.exchange(1);
      for_each(field.stored(),
               [&](const GridIndex<dim> &index) { field(index) = linear(lattice->point(index)); });
      for_each(field.owned(), [&](const GridIndex<dim> &index) {
        auto place = lattice->point(index);
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = std::min(place[d] + 0.01, grid.upper()[d]);
        REQUIRE(interpolate(field, place) == Approx(linear(place)));
        const auto bounded = interpolate_with_bounds(field, place);
        REQUIRE(bounded.value == Approx(linear(place)));
        REQUIRE(bounded.smallest <= bounded.value);
        REQUIRE(bounded.largest >= bounded.value);
      });
    }
}


TEST_CASE("areas and volumes fill the domain", "[fields][mpi]")
{
  const MacGrid<3> grid(MPI_COMM_WORLD, graded_planes<3>(), first_axis_periodic<3>());
  const double     volume = 1. * 2 * 3;
  CHECK(sum_over(*grid.cells(), [&](const auto &cell) { return grid.cell_volume(cell); }) ==
        Approx(volume));
  for (unsigned int axis = 0; axis < 3; ++axis)
    CHECK(sum_over(*grid.faces(axis), [&](const auto &face) {
            return grid.dual_volume(axis, face);
          }) == Approx(volume));
  for_each(grid.cells()->owned(), [&](const GridIndex<3> &cell) {
    REQUIRE(grid.cell_at(grid.cells()->point(cell)) == cell);
  });
}


TEST_CASE("planes are read from corners, gradings and lists, and checked", "[fields]")
{
  const auto read   = [](const std::string &keys) { return read_planes<2>(read_scene_text(keys)); };
  const auto planes = read("set Cells = 4, 2\nset Upper corner = 2, 3\nset Grading x = x^2\n"
                           "set Planes y = 0, 0.5, 3\n");
  CHECK(planes[0] == std::vector<double>{0, 0.125, 0.5, 1.125, 2});
  CHECK(planes[1] == std::vector<double>{0, 0.5, 3});
  CHECK_THROWS_AS(read(""), InputError);
  CHECK_THROWS_AS(read("set Cells = 0, 4"), InputError);
  CHECK_THROWS_AS(read("set Cells = 4, 4\nset Upper corner = 1, 0"), InputError);
  CHECK_THROWS_AS(read("set Cells = 4, 4\nset Grading x = 1-x"), InputError);
  CHECK_THROWS_AS(read("set Cells = 4, 4\nset Grading y = x/2"), InputError);
  CHECK_THROWS_AS(read("set Cells = 4, 4\nset Planes y = 0, 2, 1"), InputError);
}
