// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <utility>
#include <vector>

namespace undine
{
  namespace
  {
    /// Extent of the volume around a lattice point along `direction` [m].
    template <int dim>
    double
    extent(const MacGrid<dim>   &grid,
           const Lattice<dim>   &lattice,
           const unsigned int    direction,
           const GridIndex<dim> &index)
    {
      return direction == lattice.normal_axis() ? grid.dual_width(direction, index[direction])
                                                : grid.cell_width(direction, index[direction]);
    }


    template <int dim>
    double
    volume(const MacGrid<dim> &grid, const Lattice<dim> &lattice, const GridIndex<dim> &index)
    {
      double result = 1;
      for (unsigned int d = 0; d < dim; ++d)
        result *= extent(grid, lattice, d, index);
      return result;
    }


    /// Area over distance between a point and the next one along `direction`, which may be a
    /// boundary point.
    template <int dim>
    double
    coupling(const MacGrid<dim>   &grid,
             const Lattice<dim>   &lattice,
             const GridIndex<dim> &index,
             const unsigned int    direction,
             const int             step)
    {
      const auto  &row = lattice.row(direction);
      const double distance =
        row.position(index[direction] + step) - row.position(index[direction]);
      return volume(grid, lattice, index) / extent(grid, lattice, direction, index) /
             std::abs(distance);
    }


    /// True for faces on walls and inflows, whose value is given.
    template <int dim>
    bool
    is_prescribed(const FluidModel<dim> &model,
                  const Lattice<dim>    &lattice,
                  const GridIndex<dim>  &index)
    {
      const unsigned int axis = lattice.normal_axis();
      if (axis == Lattice<dim>::no_axis || !model.grid().at_boundary(axis, index))
        return false;
      const Side side{axis, index[axis] == 0 ? 0u : 1u};
      return model.boundaries().at(side, index).prescribes_normal_velocity();
    }


    /// What lies on one side of a lattice point.
    enum class Beyond
    {
      neighbour, ///< another point
      boundary,  ///< a boundary point, half a cell away
      nothing    ///< the boundary itself runs through the point
    };


    template <int dim>
    Beyond
    beyond(const Lattice<dim>   &lattice,
           const GridIndex<dim> &index,
           const unsigned int    direction,
           const int             step)
    {
      const auto &row  = lattice.row(direction);
      const int   next = index[direction] + step;
      if (row.periodic() || (next >= 0 && next < row.size()))
        return Beyond::neighbour;
      return row.has_boundary_points() ? Beyond::boundary : Beyond::nothing;
    }


    /// Call `action(direction, step)` for the 2 dim steps to neighbours.
    template <int dim, class Action>
    void
    for_each_step(Action &&action)
    {
      for (unsigned int direction = 0; direction < dim; ++direction)
        for (const int step : {-1, 1})
          action(direction, step);
    }
  } // namespace


  template <int dim>
  ImplicitDiffusion<dim>::ImplicitDiffusion(const FluidModel<dim>              &model_,
                                            std::shared_ptr<const Lattice<dim>> lattice_,
                                            const BoundaryCondition<dim>       &condition_,
                                            const double                        diffusivity_)
    : model(model_)
    , lattice(std::move(lattice_))
    , condition(condition_)
    , diffusivity(diffusivity_)
  {
  }


  template <int dim>
  void
  ImplicitDiffusion<dim>::collect(Row &row, const GridIndex<dim> &index, const double dt) const
  {
    const auto  &grid = model.grid();
    const double mass = volume(grid, *lattice, index);
    row.columns.assign(1, lattice->number(index));
    row.values.assign(1, mass);
    if (is_prescribed(model, *lattice, index))
      return;
    for_each_step<dim>([&](const unsigned int direction, const int step) {
      const auto   other = moved<dim>(index, direction, step);
      const auto   what  = beyond(*lattice, index, direction, step);
      const double value = what == Beyond::nothing
                             ? 0.
                             : dt * diffusivity * coupling(grid, *lattice, index, direction, step);
      if (what == Beyond::neighbour)
        {
          row.values[0] += value;
          if (!is_prescribed(model, *lattice, other))
            {
              row.columns.push_back(lattice->number(other));
              row.values.push_back(-value);
            }
        }
      else if (what == Beyond::boundary)
        for_each_boundary_around(
          model.boundaries(),
          *lattice,
          {direction, step < 0 ? 0u : 1u},
          other,
          [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
            if (condition.is_dirichlet(boundary))
              row.values[0] += fraction * value;
          });
    });
  }


  template <int dim>
  void
  ImplicitDiffusion<dim>::assemble(const double dt)
  {
    auto &matrix = solver.matrix;
    Row   row;
    if (assembled_dt == 0)
      {
        dealii::TrilinosWrappers::SparsityPattern pattern(
          lattice->owned_numbers(), model.grid().communicator(), 2 * dim + 1);
        for_each(lattice->owned(), [&](const GridIndex<dim> &index) {
          collect(row, index, dt);
          pattern.add_entries(row.columns[0], row.columns.begin(), row.columns.end());
        });
        pattern.compress();
        matrix.reinit(pattern);
      }
    matrix = 0;
    for_each(lattice->owned(), [&](const GridIndex<dim> &index) {
      collect(row, index, dt);
      matrix.add(row.columns[0], row.columns.size(), row.columns.data(), row.values.data(), false);
    });
    matrix.compress(dealii::VectorOperation::add);
    solver.set_up(diffusion_number(dt));
    assembled_dt = dt;
  }


  template <int dim>
  double
  ImplicitDiffusion<dim>::diffusion_number(const double dt) const
  {
    double result = 0;
    for_each(lattice->owned(), [&](const GridIndex<dim> &index) {
      for (unsigned int d = 0; d < dim; ++d)
        result = std::max(result,
                          dt * diffusivity / std::pow(extent(model.grid(), *lattice, d, index), 2));
    });
    return dealii::Utilities::MPI::max(result, model.grid().communicator());
  }


  template <int dim>
  std::vector<double>
  ImplicitDiffusion<dim>::right_side(const Field<dim> &field, const double time) const
  {
    const auto         &grid = model.grid();
    std::vector<double> result;
    result.reserve(lattice->owned().size());
    for_each(lattice->owned(), [&](const GridIndex<dim> &index) {
      double sum = volume(grid, *lattice, index) * field(index);
      if (!is_prescribed(model, *lattice, index))
        for_each_step<dim>([&](const unsigned int direction, const int step) {
          const auto other = moved<dim>(index, direction, step);
          const auto what  = beyond(*lattice, index, direction, step);
          if (what == Beyond::nothing ||
              (what == Beyond::neighbour && !is_prescribed(model, *lattice, other)))
            return;
          const double factor =
            assembled_dt * diffusivity * coupling(grid, *lattice, index, direction, step);
          if (what == Beyond::neighbour)
            sum += factor * field(other);
          else
            for_each_boundary_around(
              model.boundaries(),
              *lattice,
              {direction, step < 0 ? 0u : 1u},
              other,
              [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
                if (condition.is_dirichlet(boundary))
                  sum +=
                    fraction * factor *
                    condition.dirichlet_value(boundary, direction, lattice->point(other), time);
              });
        });
      result.push_back(sum);
    });
    return result;
  }


  template <int dim>
  unsigned int
  ImplicitDiffusion<dim>::step(Field<dim> &field, const double time, const double dt)
  {
    if (diffusivity == 0)
      return 0;
    if (dt != assembled_dt)
      assemble(dt);
    field.exchange(1);
    using Vector = DiffusionSolver::Vector;
    Vector     solution(lattice->owned_numbers(), model.grid().communicator());
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
  ImplicitDiffusion<dim>::memory_consumption() const
  {
    return solver.memory_consumption();
  }


  template class ImplicitDiffusion<2>;
  template class ImplicitDiffusion<3>;
} // namespace undine
