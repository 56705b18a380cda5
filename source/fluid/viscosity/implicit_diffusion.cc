// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <limits>
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
    double least = std::numeric_limits<double>::infinity();
    for (unsigned int d = 0; d < dim; ++d)
      {
        along[d] = distances(d);
        for (int i = lattice->owned().lower[d]; i < lattice->owned().upper[d]; ++i)
          least = std::min(least, along[d].extent(i));
      }
    least          = dealii::Utilities::MPI::min(least, model.grid().communicator());
    largest_number = 1 / (least * least);
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
    return dt * diffusivity * largest_number;
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
  ImplicitDiffusion<dim>::solve_with_matrix(Field<dim> &field, const double time, const double dt)
  {
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
  typename ImplicitDiffusion<dim>::Distances
  ImplicitDiffusion<dim>::distances(const unsigned int direction) const
  {
    const auto &mine     = lattice->owned();
    const auto &row      = lattice->row(direction);
    const auto  is_point = [&](const int index) {
      return row.periodic() || (index >= 0 && index < row.size());
    };
    Distances result{mine.lower[direction] - 1, {}, {}};
    for (int i = result.first; i < mine.upper[direction]; ++i)
      {
        GridIndex<dim> index{};
        index[direction] = i;
        result.extents.push_back(is_point(i) ? extent(model.grid(), *lattice, direction, index)
                                             : 0.);
        result.links.push_back(
          is_point(i) && is_point(i + 1) ? 1 / (row.position(i + 1) - row.position(i)) : 0.);
      }
    return result;
  }


  namespace
  {
    /// The entries by friction k = `factor` * `along_row` between the points of a row and the next
    /// ones, and by `step` * rate with which the flow carries from the former to the latter.
    void
    set_couplings(double *__restrict above,
                  double *__restrict below,
                  const double  factor,
                  const double *along_row,
                  const double  step,
                  const double *rates,
                  const int     length)
    {
      for (int i = 0; i < length; ++i)
        {
          const double friction = factor * along_row[i];
          const double carried  = step * rates[i] / 2;
          above[i]              = carried - friction;
          below[i]              = -carried - friction;
        }
    }
  } // namespace


  /// Points with the next ones in a direction, which other ranks may own.
  template <int dim>
  void
  ImplicitDiffusion<dim>::couple(const unsigned int     direction,
                                 const double           dt,
                                 const DualFluxes<dim> *fluxes)
  {
    const auto &row   = lattice->row(direction);
    auto        pairs = lattice->owned();
    if (row.periodic() || pairs.lower[direction] > 0)
      --pairs.lower[direction];
    if (!row.periodic())
      pairs.upper[direction] = std::min(pairs.upper[direction], row.size() - 1);
    std::vector<double> rates(std::max(0, pairs.upper[0] - pairs.lower[0]), 0.);
    const auto         &first_row = direction == 0 ? along[0].links : along[0].extents;
    for_each_row(pairs, [&](const GridIndex<dim> &first, const int length) {
      double factor = dt * diffusivity;
      for (unsigned int d = 1; d < dim; ++d)
        factor *= d == direction ? along[d].link(first[d]) : along[d].extent(first[d]);
      if (fluxes)
        fluxes->rates_to_next(lattice->normal_axis(), direction, first, rates);
      const auto here = equations->position(first);
      set_couplings(equations->above[direction].data() + here,
                    equations->below[direction].data() + here +
                      equations->owned().strides[direction],
                    factor,
                    first_row.data() + (first[0] - along[0].first),
                    dt,
                    rates.data(),
                    length);
    });
  }


  /// Rows of the matrix have the sum V, apart from what sides of the domain add.
  template <int dim>
  void
  ImplicitDiffusion<dim>::fill_points(const Field<dim> &field)
  {
    for_each_row(lattice->owned(), [&](const GridIndex<dim> &first, const int length) {
      double area = 1;
      for (unsigned int d = 1; d < dim; ++d)
        area *= along[d].extent(first[d]);
      const auto    here       = equations->position(first);
      double       *diagonal   = equations->diagonal.data() + here;
      double       *right_side = equations->right_side.data() + here;
      const double *extents    = along[0].extents.data() + (first[0] - along[0].first);
      const double *value      = field.data(first);
      for (int i = 0; i < length; ++i)
        {
          diagonal[i]   = area * extents[i];
          right_side[i] = diagonal[i] * value[i];
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *above = equations->above[d].data() + here;
          const double *below = equations->below[d].data() + here;
          for (int i = 0; i < length; ++i)
            diagonal[i] -= above[i] + below[i];
        }
    });
  }


  /// Friction on Dirichlet boundaries, half a cell away from the points along them.
  template <int dim>
  void
  ImplicitDiffusion<dim>::add_sides(const double time, const double dt)
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int end = 0; end < 2 && lattice->row(d).has_boundary_points(); ++end)
        {
          const Side side{d, end};
          const int  last  = end == 0 ? 0 : lattice->row(d).size() - 1;
          auto       layer = lattice->owned();
          layer.lower[d]   = std::max(layer.lower[d], last);
          layer.upper[d]   = std::min(layer.upper[d], last + 1);
          for_each(layer, [&](const GridIndex<dim> &index) {
            const auto   on_side = moved<dim>(index, d, side.sign());
            const auto   here    = equations->position(index);
            const double factor =
              dt * diffusivity * coupling(model.grid(), *lattice, index, d, side.sign());
            for_each_boundary_around(
              model.boundaries(),
              *lattice,
              side,
              on_side,
              [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
                if (!condition.is_dirichlet(boundary))
                  return;
                equations->diagonal[here] += fraction * factor;
                equations->right_side[here] +=
                  fraction * factor *
                  condition.dirichlet_value(boundary, d, lattice->point(on_side), time);
              });
          });
        }
  }


  template <int dim>
  void
  ImplicitDiffusion<dim>::add_entering(const double dt, const DualFluxes<dim> &fluxes)
  {
    fluxes.for_each_entering(
      lattice->normal_axis(),
      [&](const FacePlace<dim> &place, const double rate, const double velocity) {
        const auto here = equations->position(place.face);
        equations->diagonal[here] += dt * rate;
        equations->right_side[here] += dt * rate * velocity;
      });
  }


  template <int dim>
  void
  ImplicitDiffusion<dim>::keep_prescribed(const Field<dim> &field)
  {
    const unsigned int axis = lattice->normal_axis();
    for (unsigned int end = 0; end < 2 && axis < dim && !model.grid().periodic(axis); ++end)
      {
        const int last    = end == 0 ? 0 : lattice->row(axis).size() - 1;
        auto      layer   = lattice->owned();
        layer.lower[axis] = std::max(layer.lower[axis], last);
        layer.upper[axis] = std::min(layer.upper[axis], last + 1);
        for_each(layer, [&](const GridIndex<dim> &face) {
          if (!is_prescribed(model, *lattice, face))
            return;
          const auto here = equations->position(face);
          for (auto *entries : {&equations->above, &equations->below})
            for (auto &in_direction : *entries)
              in_direction[here] = 0;
          equations->diagonal[here]   = volume(model.grid(), *lattice, face);
          equations->right_side[here] = equations->diagonal[here] * field(face);
        });
      }
  }


  template <int dim>
  std::optional<unsigned int>
  ImplicitDiffusion<dim>::relax(Field<dim>            &field,
                                const double           time,
                                const double           dt,
                                const DualFluxes<dim> *fluxes)
  {
    if (diffusion_number(dt) >= DiffusionSolver::far)
      return {};
    if (!equations)
      equations = std::make_unique<NeighbourEquations<dim>>(lattice);
    for (unsigned int direction = 0; direction < dim; ++direction)
      couple(direction, dt, fluxes);
    fill_points(field);
    if (diffusivity > 0)
      add_sides(time, dt);
    if (fluxes)
      add_entering(dt, *fluxes);
    keep_prescribed(field);
    return equations->solve(field);
  }


  template <int dim>
  unsigned int
  ImplicitDiffusion<dim>::step(Field<dim> &field, const double time, const double dt)
  {
    if (diffusivity == 0)
      return 0;
    const auto n_sweeps = relax(field, time, dt, nullptr);
    return n_sweeps ? *n_sweeps : solve_with_matrix(field, time, dt);
  }


  template <int dim>
  std::size_t
  ImplicitDiffusion<dim>::memory_consumption() const
  {
    return solver.memory_consumption() + (equations ? equations->memory_consumption() : 0);
  }


  template class ImplicitDiffusion<2>;
  template class ImplicitDiffusion<3>;
} // namespace undine
