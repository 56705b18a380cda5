// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/diffusion_matrix.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <vector>

namespace undine
{
  template <int dim>
  DiffusionMatrix<dim>::DiffusionMatrix(const DiffusionProblem<dim> &problem)
    : problem(problem)
  {
  }


  template <int dim>
  void
  DiffusionMatrix<dim>::collect(Row &row, const GridIndex<dim> &index, const double dt) const
  {
    const auto  &grid = problem.model.grid();
    const double mass = volume(grid, *problem.lattice, index);
    row.columns.assign(1, problem.lattice->number(index));
    row.values.assign(1, mass);
    if (is_prescribed(problem.model, *problem.lattice, index))
      return;
    for_each_step<dim>([&](const unsigned int direction, const int step) {
      const auto   other = moved<dim>(index, direction, step);
      const auto   what  = beyond(*problem.lattice, index, direction, step);
      const double value =
        what == Beyond::nothing
          ? 0.
          : dt * problem.diffusivity * coupling(grid, *problem.lattice, index, direction, step);
      if (what == Beyond::neighbour)
        {
          row.values[0] += value;
          if (!is_prescribed(problem.model, *problem.lattice, other))
            {
              row.columns.push_back(problem.lattice->number(other));
              row.values.push_back(-value);
            }
        }
      else if (what == Beyond::boundary)
        for_each_boundary_around(
          problem.model.boundaries(),
          *problem.lattice,
          {direction, step < 0 ? 0u : 1u},
          other,
          [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
            if (problem.condition.is_dirichlet(boundary))
              row.values[0] += fraction * value;
          });
    });
  }


  template <int dim>
  void
  DiffusionMatrix<dim>::assemble(const double dt, const double diffusion_number)
  {
    auto &matrix = solver.matrix;
    Row   row;
    if (assembled_dt == 0)
      {
        dealii::TrilinosWrappers::SparsityPattern pattern(
          problem.lattice->owned_numbers(), problem.model.grid().communicator(), 2 * dim + 1);
        for_each(problem.lattice->owned(), [&](const GridIndex<dim> &index) {
          collect(row, index, dt);
          pattern.add_entries(row.columns[0], row.columns.begin(), row.columns.end());
        });
        pattern.compress();
        matrix.reinit(pattern);
      }
    matrix = 0;
    for_each(problem.lattice->owned(), [&](const GridIndex<dim> &index) {
      collect(row, index, dt);
      matrix.add(row.columns[0], row.columns.size(), row.columns.data(), row.values.data(), false);
    });
    matrix.compress(dealii::VectorOperation::add);
    solver.set_up(diffusion_number);
    assembled_dt = dt;
  }


  template <int dim>
  std::vector<double>
  DiffusionMatrix<dim>::right_side(const Field<dim> &field, const double time) const
  {
    const auto         &grid = problem.model.grid();
    std::vector<double> result;
    result.reserve(problem.lattice->owned().size());
    for_each(problem.lattice->owned(), [&](const GridIndex<dim> &index) {
      double sum = volume(grid, *problem.lattice, index) * field(index);
      if (!is_prescribed(problem.model, *problem.lattice, index))
        for_each_step<dim>([&](const unsigned int direction, const int step) {
          const auto other = moved<dim>(index, direction, step);
          const auto what  = beyond(*problem.lattice, index, direction, step);
          if (what == Beyond::nothing ||
              (what == Beyond::neighbour && !is_prescribed(problem.model, *problem.lattice, other)))
            return;
          const double factor = assembled_dt * problem.diffusivity *
                                coupling(grid, *problem.lattice, index, direction, step);
          if (what == Beyond::neighbour)
            sum += factor * field(other);
          else
            for_each_boundary_around(
              problem.model.boundaries(),
              *problem.lattice,
              {direction, step < 0 ? 0u : 1u},
              other,
              [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
                if (problem.condition.is_dirichlet(boundary))
                  sum += fraction * factor *
                         problem.condition.dirichlet_value(
                           boundary, direction, problem.lattice->point(other), time);
              });
        });
      result.push_back(sum);
    });
    return result;
  }


  template <int dim>
  unsigned int
  DiffusionMatrix<dim>::step(Field<dim>  &field,
                             const double time,
                             const double dt,
                             const double diffusion_number)
  {
    if (dt != assembled_dt)
      assemble(dt, diffusion_number);
    field.exchange(1);
    using Vector = DiffusionSolver::Vector;
    Vector     solution(problem.lattice->owned_numbers(), problem.model.grid().communicator());
    Vector     load(solution);
    const auto values = right_side(field, time);
    const auto guess  = field.owned_values();
    std::copy(values.begin(), values.end(), load.begin());
    std::copy(guess.begin(), guess.end(), solution.begin());

    const unsigned int n_iterations = solver.solve(solution, load);
    field.set_owned_values({solution.begin(), solution.end()});
    return n_iterations;
  }


  template <int dim>
  std::size_t
  DiffusionMatrix<dim>::memory_consumption() const
  {
    return solver.memory_consumption();
  }


  template class DiffusionMatrix<2>;
  template class DiffusionMatrix<3>;
} // namespace undine
