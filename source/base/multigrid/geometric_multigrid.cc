// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/multigrid/geometric_multigrid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    using Box = CellEquations::Box;

    // A dense matrix of so many unknowns is factorised within a millisecond or two.
    constexpr unsigned int few_unknowns = 200;

    // More are left where bodies part the fluid again and again; they are relaxed only.
    constexpr unsigned int most_unknowns = 2000;

    // Directions in which blocks are less than this times as long as the shortest are coarsened.
    constexpr double isotropic = 1.5;


    /// The box around all owned cells of this rank.
    Box
    hull(const CellEquations &equations)
    {
      constexpr int far = std::numeric_limits<int>::max();
      Box           result{{{far, far, far}}, {{-far, -far, -far}}};
      for (unsigned int i = 0; i < equations.n_owned(); ++i)
        for (unsigned int axis = 0; axis < 3; ++axis)
          {
            result.lower[axis] = std::min(result.lower[axis], equations.boxes[i].lower[axis]);
            result.upper[axis] = std::max(result.upper[axis], equations.boxes[i].upper[axis]);
          }
      return result;
    }


    /// The hulls of all ranks together.
    Box
    united(const Box &hull, const MPI_Comm communicator)
    {
      Box result;
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          result.lower[axis] = dealii::Utilities::MPI::min(hull.lower[axis], communicator);
          result.upper[axis] = dealii::Utilities::MPI::max(hull.upper[axis], communicator);
        }
      return result;
    }


    /// Make blocks longer where they are, in the mean, the shortest. False: they reach through the
    /// domain.
    bool
    lengthen(std::array<int, 3> &width, const PlanesOfCells &planes, const Box &domain)
    {
      double                shortest = std::numeric_limits<double>::infinity();
      std::array<double, 3> length;
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          const auto &along = planes[axis];
          length[axis]      = width[axis] * (along.back() - along.front()) / (along.size() - 1);
          if (width[axis] < domain.upper[axis] - domain.lower[axis])
            shortest = std::min(shortest, length[axis]);
        }
      bool longer = false;
      for (unsigned int axis = 0; axis < 3; ++axis)
        if (width[axis] < domain.upper[axis] - domain.lower[axis] &&
            length[axis] < isotropic * shortest)
          {
            width[axis] *= 2;
            longer = true;
          }
      return longer;
    }
  } // namespace


  GeometricMultigrid::GeometricMultigrid(const CellEquations::Matrix &diffusion,
                                         const CellEquations::Matrix &whole,
                                         const CellsOfUnknowns       &places)
    : communicator(whole.get_mpi_communicator())
  {
    auto               equations = make_cell_equations(diffusion, whole, places);
    const Box          own       = hull(equations);
    const Box          domain    = united(own, communicator);
    std::array<int, 3> width{{1, 1, 1}};
    while (equations.partitioner->size() > few_unknowns && lengthen(width, *places.planes, domain))
      {
        auto coarser = coarsen(equations, width, own.lower, domain);
        add_level(equations, std::move(coarser.aggregates));
        equations = std::move(coarser.equations);
      }
    add_level(equations, {});
    factorise(equations);
  }


  void
  GeometricMultigrid::add_level(const CellEquations &equations, std::vector<int> aggregates)
  {
    const MultigridLevel::Vector vector(equations.partitioner);
    levels.push_back({make_multigrid_level(equations), std::move(aggregates), vector, vector});
  }


  /// By ranks together: none knows the whole matrix before.
  void
  GeometricMultigrid::factorise(const CellEquations &equations)
  {
    const unsigned int n = equations.partitioner->size();
    if (n == 0 || n > most_unknowns)
      return;
    dealii::FullMatrix<double> matrix(n, n);
    const auto                &numbers = *equations.partitioner;
    double                     largest = 0;
    first_of_coarsest                  = equations.n_owned() > 0 ? numbers.local_to_global(0) : 0;
    for (unsigned int i = 0; i < equations.n_owned(); ++i)
      {
        const auto row   = numbers.local_to_global(i);
        matrix(row, row) = equations.diagonal(i);
        largest          = std::max(largest, matrix(row, row));
        for (std::size_t k = equations.row_begins[i]; k < equations.row_begins[i + 1]; ++k)
          {
            const auto &entry                                  = equations.entries[k];
            matrix(row, numbers.local_to_global(entry.column)) = entry.rest - entry.coupling;
          }
      }
    dealii::Utilities::MPI::sum(matrix, communicator, matrix);
    // Regions that nothing fixes have a pressure up to a constant, of which single precision knows
    // no more than this.
    const double shift = 1e-7 * dealii::Utilities::MPI::max(largest, communicator);
    for (unsigned int i = 0; i < n; ++i)
      matrix(i, i) += matrix(i, i) > 0 ? shift : 1.;
    coarsest.reinit(n);
    coarsest = matrix;
    coarsest.set_property(dealii::LAPACKSupport::symmetric);
    coarsest.compute_cholesky_factorization();
  }


  void
  GeometricMultigrid::solve_coarsest(const Level &level) const
  {
    if (coarsest.m() == 0)
      {
        level.matrix->relax_from_zero(level.x, level.b);
        level.matrix->relax_backward(level.x, level.b);
        return;
      }
    dealii::Vector<double> solution(coarsest.m());
    for (unsigned int i = 0; i < level.b.locally_owned_size(); ++i)
      solution(first_of_coarsest + i) = level.b.local_element(i);
    dealii::Utilities::MPI::sum(solution, communicator, solution);
    coarsest.solve(solution);
    for (unsigned int i = 0; i < level.b.locally_owned_size(); ++i)
      level.x.local_element(i) = static_cast<float>(solution(first_of_coarsest + i));
  }


  void
  GeometricMultigrid::cycle(const unsigned int number) const
  {
    const Level &level = levels[number];
    if (number + 1 == levels.size())
      {
        solve_coarsest(level);
        return;
      }
    const Level &coarser = levels[number + 1];
    level.matrix->relax_from_zero(level.x, level.b);
    level.matrix->restrict_residual(coarser.b, level.x, level.aggregates);
    cycle(number + 1);
    level.matrix->prolongate(level.x, coarser.x, level.aggregates);
    level.matrix->relax_backward(level.x, level.b);
  }


  void
  GeometricMultigrid::vmult(Vector &x, const Vector &b) const
  {
    const double size = b.l2_norm();
    if (!(size > 0) || !std::isfinite(size))
      {
        x = b;
        return;
      }
    const auto &finest = levels.front();
    // Right-hand sides may be smaller than the least number of single precision.
    std::transform(b.begin(), b.end(), finest.b.begin(), [&](const double value) {
      return static_cast<float>(value / size);
    });
    cycle(0);
    std::transform(finest.x.begin(),
                   finest.x.begin() + finest.x.locally_owned_size(),
                   x.begin(),
                   [&](const float value) { return size * value; });
  }


  unsigned int
  GeometricMultigrid::n_levels() const
  {
    return levels.size();
  }


  std::size_t
  GeometricMultigrid::memory_consumption() const
  {
    std::size_t result = 0;
    for (const auto &level : levels)
      result += level.matrix->memory_consumption() + level.aggregates.capacity() * sizeof(int) +
                level.x.memory_consumption() + level.b.memory_consumption();
    return result;
  }
} // namespace undine
