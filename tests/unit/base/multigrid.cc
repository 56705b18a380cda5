// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/base/multigrid/coarsening.h>
#include <undine/base/multigrid/geometric_multigrid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace undine;

namespace
{
  using Matrix = CellEquations::Matrix;
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Cell   = std::array<int, 3>;

  /// Diffusion in a box of cells between walls, with a given value beyond the last cells along the
  /// last direction. Ranks own slabs across it.
  struct Box
  {
    Cell                                            n{{1, 1, 1}};
    std::array<double, 3>                           spacing{{1, 1, 1}};
    std::function<bool(const Cell &, unsigned int)> has_wall = {};   /// above a cell, along an axis
    bool                                            is_open  = true; ///< at the end
    int                                             periodic = -1;   ///< axis, or none

    unsigned int
    last_axis() const
    {
      return n[2] > 1 ? 2 : 1;
    }

    unsigned int
    open_axis() const
    {
      return periodic == static_cast<int>(last_axis()) ? 0 : last_axis();
    }

    unsigned int
    number(const Cell &cell) const
    {
      return (cell[2] * n[1] + cell[1]) * n[0] + cell[0];
    }

    Cell
    cell(const unsigned int number) const
    {
      const int k = number;
      return {{k % n[0], k / n[0] % n[1], k / n[0] / n[1]}};
    }

    double
    coupling(const unsigned int axis) const
    {
      return 1 / (spacing[axis] * spacing[axis]);
    }

    dealii::IndexSet
    owned() const
    {
      const unsigned int rank  = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
      const unsigned int ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const unsigned int size = n[0] * n[1] * n[2], layers = n[last_axis()], layer = size / layers;
      dealii::IndexSet   result(size);
      result.add_range(layers * rank / ranks * layer, layers * (rank + 1) / ranks * layer);
      return result;
    }

    CellsOfUnknowns
    places() const
    {
      PlanesOfCells planes;
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (int plane = 0; plane <= n[axis]; ++plane)
          planes[axis].push_back(plane * spacing[axis]);
      CellsOfUnknowns result;
      result.planes = std::make_shared<const PlanesOfCells>(planes);
      for (const auto number : owned())
        result.cells.push_back(cell(number));
      return result;
    }

    /// Call `action(i, j, coupling)` for all neighbours, and with j = i for what is beyond the end.
    template <class Action>
    void
    for_each_coupling(const Action &action) const
    {
      for (unsigned int i = 0; i < static_cast<unsigned int>(n[0] * n[1] * n[2]); ++i)
        for (unsigned int axis = 0; axis < 3; ++axis)
          {
            Cell       here = cell(i), next = here;
            const bool is_last = ++next[axis] == n[axis];
            if (has_wall && has_wall(here, axis))
              continue;
            if (is_last && is_open && axis == open_axis())
              action(i, i, 2 * coupling(axis));
            if (is_last && periodic != static_cast<int>(axis))
              continue;
            next[axis] %= n[axis];
            action(i, number(next), coupling(axis));
          }
    }

    void
    fill(Matrix &matrix) const
    {
      const auto                                mine = owned();
      dealii::TrilinosWrappers::SparsityPattern pattern(mine, MPI_COMM_WORLD, 7);
      for (const auto i : mine)
        pattern.add(i, i);
      for_each_coupling([&](const unsigned int i, const unsigned int j, double) {
        if (mine.is_element(i))
          pattern.add(i, j);
        if (mine.is_element(j))
          pattern.add(j, i);
      });
      pattern.compress();
      matrix.reinit(pattern);
      for_each_coupling([&](const unsigned int i, const unsigned int j, const double value) {
        if (mine.is_element(i))
          {
            matrix.add(i, i, value);
            if (j != i)
              matrix.add(i, j, -value);
          }
        if (j != i && mine.is_element(j))
          {
            matrix.add(j, j, value);
            matrix.add(j, i, -value);
          }
      });
      matrix.compress(dealii::VectorOperation::add);
      // The constant of a closed box is fixed as in the equations of the pressure.
      if (!is_open && mine.is_element(0))
        matrix.set(0, 0, 2 * matrix.diag_element(0));
      matrix.compress(dealii::VectorOperation::insert);
    }
  };


  Vector
  noise(const dealii::IndexSet &owned, const unsigned int seed)
  {
    // The same on every number of ranks.
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector                                 result(owned, MPI_COMM_WORLD);
    for (unsigned int k = 0; k < owned.size(); ++k)
      {
        const double value = uniform(random);
        if (owned.is_element(k))
          result(k) = value;
      }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  /// Iterations of conjugate gradients that reduce noise to 1e-10.
  unsigned int
  iterations(const Box &box, const std::string &name = "geometric")
  {
    Matrix matrix;
    box.fill(matrix);
    const auto multigrid = Registry<CellPreconditioner>::instance().make(name);
    multigrid->initialize(matrix, matrix, box.places());
    Vector b = noise(box.owned(), 1);
    if (!box.is_open)
      b.add(-b.mean_value());
    Vector                x(b.locally_owned_elements(), MPI_COMM_WORLD);
    dealii::SolverControl control(200, 1e-10 * b.l2_norm());
    dealii::SolverCG<Vector>(control).solve(matrix, x, b, *multigrid);
    return control.last_step();
  }


  /// A wall as thin as a plane, across the middle of the first direction, open at its ends.
  bool
  sheet(const Cell &n, const Cell &cell, const unsigned int axis)
  {
    return axis == 0 && cell[0] == n[0] / 2 && cell[1] >= n[1] / 8 && cell[1] < 7 * n[1] / 8;
  }
} // namespace


TEST_CASE("Multigrid on blocks takes few iterations, as many on fine grids as on coarse ones",
          "[multigrid][mpi]")
{
  const auto check = [](const std::function<Box(int)> &box, const std::vector<int> &sizes) {
    std::vector<unsigned int> counts;
    for (const int size : sizes)
      counts.push_back(iterations(box(size)));
    INFO("iterations: " << Catch::StringMaker<std::vector<unsigned int>>::convert(counts));
    CHECK(counts.back() <= 22);
    CHECK(counts.back() <= 1.2 * counts.front() + 1);
  };
  SECTION("plane")
  check([](const int n) { return Box{{{n, n, 1}}}; }, {32, 64, 128, 256});
  SECTION("space")
  check([](const int n) { return Box{{{n, n, n}}}; }, {12, 24, 40});
  SECTION("odd numbers of cells")
  check([](const int n) { return Box{{{2 * n + 1, n + 3, n}}}; }, {13, 25});
  SECTION("stretched cells")
  check([](const int n) { return Box{{{n, n, 1}}, {{1, 7, 1}}}; }, {32, 64, 128});
  SECTION("a sheet that divides cells of all levels")
  check(
    [](const int n) {
      Box box{{{n, n, 1}}};
      box.has_wall = [n](const Cell &cell, const unsigned int axis) {
        return sheet({{n, n, 1}}, cell, axis);
      };
      return box;
    },
    {32, 64, 128});
  SECTION("a sheet in space")
  check(
    [](const int n) {
      Box box{{{n, n, n}}};
      box.has_wall = [n](const Cell &cell, const unsigned int axis) {
        return sheet({{n, n, n}}, cell, axis);
      };
      return box;
    },
    {12, 24, 40});
  SECTION("around a cylinder")
  check(
    [](const int n) {
      Box box{{{n, n, 1}}};
      box.periodic = 0;
      return box;
    },
    {32, 64, 128});
  SECTION("ranks around a ring, on coarse levels a block each")
  check(
    [](const int n) {
      Box box{{{4 * n, 4 * n, n}}};
      box.periodic = 2;
      return box;
    },
    {6, 12});
}


TEST_CASE("Multigrid is symmetric and positive, whatever it is made from", "[multigrid][mpi]")
{
  const auto name = GENERATE("algebraic", "geometric");
  INFO(name);
  const Box box{{{16, 12, 9}}, {{1, 2, 3}}};
  Matrix    matrix;
  box.fill(matrix);
  const auto multigrid = Registry<CellPreconditioner>::instance().make(name);
  multigrid->initialize(matrix, matrix, box.places());
  const Vector a = noise(box.owned(), 2), b = noise(box.owned(), 3);
  Vector       inverse_a(a), inverse_b(b);
  multigrid->vmult(inverse_a, a);
  multigrid->vmult(inverse_b, b);
  CHECK(inverse_a * b == Approx(a * inverse_b).epsilon(1e-5));
  CHECK(inverse_a * a > 0);
  CHECK(inverse_b * b > 0);
}


TEST_CASE("Coarse equations are those of a grid of the double width", "[multigrid][mpi]")
{
  // Ranks must not divide blocks of eight.
  const Box fine{{{8, 8, 48}}, {{1, 1, 1}}}, coarse{{{4, 4, 24}}, {{2, 2, 2}}};
  Matrix    matrix, expected_matrix;
  fine.fill(matrix);
  coarse.fill(expected_matrix);
  const auto equations = make_cell_equations(matrix, matrix, fine.places());
  Cell       origin    = fine.places().cells.front();
  const auto result =
    coarsen(equations, {{2, 2, 2}}, origin, {{{0, 0, 0}}, {{8, 8, 48}}}).equations;
  const auto expected = make_cell_equations(expected_matrix, expected_matrix, coarse.places());
  REQUIRE(result.n_owned() == expected.n_owned());
  for (unsigned int i = 0; i < result.n_owned(); ++i)
    {
      // Per volume: eight times as large.
      CHECK(result.diagonal(i) == Approx(8 * expected.diagonal(i)));
      CHECK(result.outward[i] == Approx(8 * expected.outward[i]).margin(1e-12));
      CHECK(result.row_begins[i + 1] - result.row_begins[i] ==
            expected.row_begins[i + 1] - expected.row_begins[i]);
    }
}


TEST_CASE("What a wall divides remains divided on all levels", "[multigrid]")
{
  // Through a whole block, beside its middle.
  Box box{{{8, 8, 1}}};
  box.has_wall = [](const Cell &cell, const unsigned int axis) {
    return axis == 0 && cell[0] == 4;
  };
  Matrix matrix;
  box.fill(matrix);
  auto equations = make_cell_equations(matrix, matrix, box.places());
  for (const int width : {2, 4, 8})
    {
      equations =
        coarsen(equations, {{width, width, 1}}, {{0, 0, 0}}, {{{0, 0, 0}}, {{8, 8, 1}}}).equations;
      // All blocks across the wall are two unknowns.
      const unsigned int blocks = 8 / width;
      CHECK(equations.n_owned() == blocks * (blocks + 1));
      for (unsigned int i = 0; i < equations.n_owned(); ++i)
        for (std::size_t k = equations.row_begins[i]; k < equations.row_begins[i + 1]; ++k)
          {
            const auto side = [&](const unsigned int unknown) {
              return equations.boxes[unknown].lower[0] > 4;
            };
            CHECK(side(i) == side(equations.entries[k].column));
          }
    }
}


TEST_CASE("Multigrid serves a closed box, whose solution is fixed in one cell", "[multigrid][mpi]")
{
  for (const int n : {12, 24, 40})
    {
      Box box{{{n, n, n}}};
      box.is_open = false;
      CHECK(iterations(box) <= 22);
    }
}
