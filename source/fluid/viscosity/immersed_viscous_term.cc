// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/viscosity/immersed_viscous_term.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace undine
{
  template <int dim>
  ImmersedViscousTerm<dim>::ImmersedViscousTerm(const FluidModel<dim>                     &model,
                                                const unsigned int                         axis,
                                                std::shared_ptr<const FluidTopology<dim>>  open_,
                                                std::shared_ptr<const NoSlipSurfaces<dim>> walls_,
                                                const double viscosity)
    : model(model)
    , axis(axis)
    , open(std::move(open_))
    , no_slip_surfaces(std::move(walls_))
    , terms(model, axis, *open, *no_slip_surfaces, viscosity)
    , viscosity(viscosity)
  {
    number_unknowns();
    std::vector<std::pair<Number, double>> free;
    for_each_viscous_term([&](const ViscousTerm<dim> &term) {
      collect(free, term);
      if (free.size() < term.faces.size() || !term.nodes.empty() || term.wall.boundary)
        given_terms.push_back(term);
    });
  }


  template <int dim>
  template <class Action>
  void
  ImmersedViscousTerm<dim>::for_each_viscous_term(const Action &action) const
  {
    if (viscosity > 0)
      terms.for_each(action);
  }


  /// action(FacePlace) in the order of for_each_value().
  template <int dim>
  template <class Action>
  void
  ImmersedViscousTerm<dim>::for_each_owned(const Action &action) const
  {
    const auto &divided = open->faces[axis];
    for_each(model.grid().faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      if (divided.kind(face) == SubLattice<dim>::Kind::whole)
        action(FacePlace<dim>{face, -1});
    });
    for (std::size_t k = 0; k < divided.all().size(); ++k)
      if (divided.owns(k))
        action(FacePlace<dim>{divided.all()[k].index, static_cast<int>(k)});
  }


  /// Faces and pieces of rank 0 first.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::number_unknowns()
  {
    namespace mpi           = dealii::Utilities::MPI;
    const auto communicator = model.grid().communicator();
    numbers                 = Field<dim>(model.grid().faces(axis), open);
    Number count            = 0;
    for_each_value(numbers, [&](double &, const auto &, const auto &) { ++count; });
    mine =
      mpi::create_ascending_partitioning(communicator, count)[mpi::this_mpi_process(communicator)];
    Number next = count > 0 ? mine.nth_index_in_set(0) : 0;
    for_each_value(numbers, [&](double &number, const auto &, const auto &) { number = next++; });
    numbers.exchange(1);
  }


  template <int dim>
  typename ImmersedViscousTerm<dim>::Number
  ImmersedViscousTerm<dim>::number(const FacePlace<dim> &place) const
  {
    return static_cast<Number>(value_at(numbers, place));
  }


  /// rho V_f [kg]
  template <int dim>
  double
  ImmersedViscousTerm<dim>::mass(const FacePlace<dim> &place) const
  {
    return model.density() * (place.part < 0 ? model.grid().dual_volume(axis, place.face)
                                             : open->pieces[axis][place.part].volume);
  }


  template <int dim>
  bool
  ImmersedViscousTerm<dim>::is_prescribed(const FacePlace<dim> &place) const
  {
    if (!model.grid().at_boundary(axis, place.face))
      return false;
    const Side side{axis, place.face[axis] == 0 ? 0u : 1u};
    return model.boundaries().at(side, place.face).prescribes_normal_velocity();
  }


  /// The unknowns of a term and their coefficients.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::collect(std::vector<std::pair<Number, double>> &free,
                                    const ViscousTerm<dim>                 &term) const
  {
    free.clear();
    for (const auto &[place, coefficient] : term.faces)
      if (!is_prescribed(place))
        free.emplace_back(number(place), coefficient);
  }


  /// The rows that terms and fluxes of this rank may have entries in: its own, and next to it.
  template <int dim>
  dealii::IndexSet
  ImmersedViscousTerm<dim>::relevant_rows() const
  {
    std::vector<Number> rows(mine.begin(), mine.end());
    const auto         &divided = open->faces[axis];
    for_each(numbers.stored(), [&](const GridIndex<dim> &face) {
      if (divided.kind(face) == SubLattice<dim>::Kind::whole)
        rows.push_back(number({face, -1}));
    });
    for (const double number : numbers.parts())
      rows.push_back(static_cast<Number>(number));
    std::sort(rows.begin(), rows.end());
    dealii::IndexSet result(mine.size());
    result.add_indices(rows.begin(), std::unique(rows.begin(), rows.end()));
    result.compress();
    return result;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::make_pattern(const DualFluxes<dim> *fluxes)
  {
    std::vector<std::pair<Number, double>> free;
    std::vector<Number>                    columns;
    const auto                             relevant = relevant_rows();
    dealii::DynamicSparsityPattern         pattern(mine.size(), mine.size(), relevant);
    for (const auto row : mine)
      pattern.add(row, row);
    for_each_viscous_term([&](const ViscousTerm<dim> &term) {
      collect(free, term);
      columns.clear();
      for (const auto &unknown : free)
        columns.push_back(unknown.first);
      for (const auto row : columns)
        pattern.add_entries(row, columns.begin(), columns.end());
    });
    if (fluxes)
      fluxes->for_each_between(
        axis, [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double) {
          if (is_prescribed(from) || is_prescribed(to))
            return;
          pattern.add(number(from), number(to));
          pattern.add(number(to), number(from));
        });
    // A rank without fluid must not announce rows: their numbers would be taken for a huge range.
    dealii::TrilinosWrappers::SparsityPattern result(
      mine, model.grid().communicator(), mine.is_empty() ? 0 : 4 * dim + 1);
    for (const auto row : relevant)
      {
        columns.clear();
        for (auto entry = pattern.begin(row); entry != pattern.end(row); ++entry)
          columns.push_back(entry->column());
        result.add_entries(row, columns.begin(), columns.end(), true);
      }
    result.compress();
    friction.reinit(result);
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::assemble_friction(const double dt)
  {
    std::vector<std::pair<Number, double>> free;
    std::vector<Number>                    columns;
    std::vector<double>                    values;
    for_each_owned([&](const FacePlace<dim> &place) {
      friction.add(number(place), number(place), mass(place));
    });
    for_each_viscous_term([&](const ViscousTerm<dim> &term) {
      collect(free, term);
      columns.clear();
      for (const auto &unknown : free)
        columns.push_back(unknown.first);
      for (const auto &[row, coefficient] : free)
        {
          values.clear();
          for (const auto &unknown : free)
            values.push_back(dt * term.weight * coefficient * unknown.second);
          friction.add(row, columns.size(), columns.data(), values.data(), false);
        }
    });
    friction.compress(dealii::VectorOperation::add);
    assembled_dt = dt;
  }


  /// rho phi (v_to - v_from) / 2 in the equations of both places, phi being what flows from one to
  /// the other, and what prescribed velocities contribute to the load. `leaving` gets what leaves
  /// the dual volumes in a step [kg].
  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_fluxes_between(const DualFluxes<dim> &fluxes,
                                               const Field<dim>      &field,
                                               Vector                &leaving)
  {
    if (convective_entries.empty())
      convective_entries.find(fluxes, axis, solver.matrix, [&](const FacePlace<dim> &place) {
        if (is_prescribed(place) || !mine.is_element(number(place)))
          return ConvectiveEntries<dim>::none;
        return static_cast<int>(mine.index_within_set(number(place)));
      });
    const auto   rows = rows_of(solver.matrix);
    double      *mass = leaving.begin();
    std::size_t  k    = 0;
    const double step = assembled_dt * model.density();
    // A matrix must not get values by address while it collects those of other ranks.
    std::vector<std::tuple<FacePlace<dim>, FacePlace<dim>, double>> others;
    fluxes.for_each_between(
      axis, [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double flux) {
        const auto &pair = convective_entries[k++];
        if (pair.from == ConvectiveEntries<dim>::none)
          {
            others.emplace_back(from, to, flux);
            return;
          }
        const double half = step * flux / 2;
        rows[pair.from][pair.places[0]] -= half;
        rows[pair.from][pair.places[1]] += half;
        rows[pair.to][pair.places[2]] -= half;
        rows[pair.to][pair.places[3]] += half;
        mass[pair.from] += 2 * half;
        mass[pair.to] -= 2 * half;
      });
    for (const auto &[from, to, flux] : others)
      {
        leaving(number(from)) += step * flux;
        leaving(number(to)) -= step * flux;
        for (const auto &row : {from, to})
          if (!is_prescribed(row))
            {
              add_entry(row, from, -step * flux / 2, field);
              add_entry(row, to, step * flux / 2, field);
            }
      }
    leaving.compress(dealii::VectorOperation::add);
  }


  /// To the matrix, or to the load if the velocity of the column is prescribed.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_entry(const FacePlace<dim> &row,
                                      const FacePlace<dim> &column,
                                      const double          mass,
                                      const Field<dim>     &field)
  {
    if (is_prescribed(column))
      right_side(number(row)) -= mass * value_at(field, column);
    else
      solver.matrix.add(number(row), number(column), mass);
  }


  /// To the matrix and the load, from fluxes with `field` = v*.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_convection(const DualFluxes<dim> &fluxes, const Field<dim> &field)
  {
    auto  &matrix = solver.matrix;
    Vector leaving(mine, model.grid().communicator());
    add_fluxes_between(fluxes, field, leaving);
    fluxes.for_each_entering(
      axis, [&](const FacePlace<dim> &place, const double flux, const double velocity) {
        if (is_prescribed(place))
          return;
        const double mass = assembled_dt * model.density() * flux;
        matrix.add(number(place), number(place), mass);
        right_side(number(place)) += mass * velocity;
      });
    matrix.compress(dealii::VectorOperation::add);
    right_side.compress(dealii::VectorOperation::add);
    if (fluxes.start())
      add_shrinkage(fluxes, leaving);
  }


  /// What leaves the dual volumes in a step where surfaces move [kg], besides what crosses sides
  /// in `leaving`. V^0 is not negative, but for what the flow does not fit.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_shrinkage(const DualFluxes<dim> &fluxes, Vector &leaving)
  {
    fluxes.for_each_leaving(axis, [&](const FacePlace<dim> &place, const double flux) {
      leaving(number(place)) += assembled_dt * model.density() * flux;
    });
    leaving.compress(dealii::VectorOperation::add);
    std::size_t k = 0;
    for_each_owned([&](const FacePlace<dim> &place) {
      const double shrinkage =
        is_prescribed(place) ? 0. : std::max(leaving.begin()[k], -mass(place));
      solver.matrix.add(number(place), number(place), shrinkage);
      right_side.begin()[k++] += shrinkage * value_at((*fluxes.start())[axis], place);
    });
    solver.matrix.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  double
  ImmersedViscousTerm<dim>::diffusion_number() const
  {
    double result = 0;
    for_each(model.grid().cells()->owned(), [&](const GridIndex<dim> &cell) {
      for (unsigned int d = 0; d < dim; ++d)
        result = std::max(result,
                          assembled_dt * viscosity /
                            (model.density() * std::pow(model.grid().cell_width(d, cell[d]), 2)));
    });
    return dealii::Utilities::MPI::max(result, model.grid().communicator());
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::set_up_friction(const double dt, const DualFluxes<dim> *fluxes)
  {
    if (dt != assembled_dt || is_replaced)
      {
        is_replaced = false;
        make_pattern(fluxes);
        convective_entries.clear();
        assemble_friction(dt);
        if (!fluxes)
          {
            solver.matrix.copy_from(friction);
            friction.clear();
            solver.set_up(diffusion_number(), DiffusionSolver::Matrices::symmetric);
          }
      }
    if (fluxes)
      solver.matrix.copy_from(friction);
  }


  /// sum c u over the nodes of a term.
  template <int dim>
  double
  ImmersedViscousTerm<dim>::by_nodes(const ViscousTerm<dim> &term, const Motion &of_nodes)
  {
    double sum = 0;
    for (const auto &[node, coefficient] : term.nodes)
      sum += coefficient * of_nodes[node];
    return sum;
  }


  /// sum c v over what is not an unknown.
  template <int dim>
  double
  ImmersedViscousTerm<dim>::given_part(const ViscousTerm<dim> &term, const Field<dim> &field) const
  {
    double sum = 0;
    for (const auto &[place, coefficient] : term.faces)
      if (is_prescribed(place))
        sum += coefficient * value_at(field, place);
    sum += by_nodes(term, nodes);
    if (const auto &wall = term.wall; wall.boundary)
      sum -= wall.boundary->velocity_along(axis, wall.normal, wall.place, time);
    return sum;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::fill(const Field<dim> &field)
  {
    first = Vector(mine, model.grid().communicator());
    right_side.reinit(first);
    std::size_t k = 0;
    for_each_owned([&](const FacePlace<dim> &place) {
      first.begin()[k]        = value_at(field, place);
      right_side.begin()[k++] = mass(place) * value_at(field, place);
    });
    by_given.assign(nodes.size(), 0.);
    std::vector<std::pair<Number, double>> free;
    for (const auto &term : given_terms)
      if (const double given = given_part(term, field); given != 0)
        {
          collect(free, term);
          for (const auto &[row, coefficient] : free)
            right_side(row) -= assembled_dt * term.weight * coefficient * given;
          for (const auto &[node, coefficient] : term.nodes)
            by_given[node] -= term.weight * coefficient * given;
        }
    right_side.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  typename ImmersedViscousTerm<dim>::Motion
  ImmersedViscousTerm<dim>::given_friction() const
  {
    Motion result(by_given.size());
    dealii::Utilities::MPI::sum(by_given, model.grid().communicator(), result);
    return result;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::start(Field<dim>                                &field,
                                  const std::vector<dealii::Tensor<1, dim>> &node_velocities,
                                  const double                               end_time,
                                  const double                               dt,
                                  const DualFluxes<dim>                     *fluxes)
  {
    time = end_time;
    nodes.clear();
    for (const auto &velocity : node_velocities)
      nodes.push_back(velocity[axis]);
    set_up_friction(dt, fluxes);
    field.exchange(1);
    fill(field);
    if (!fluxes)
      return;
    add_convection(*fluxes, field);
    solver.set_up(diffusion_number(), DiffusionSolver::Matrices::with_convection);
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::set_values(Field<dim> &field, const Vector &values) const
  {
    std::size_t k = 0;
    for_each_owned([&](const FacePlace<dim> &place) {
      const double value = values.begin()[k++];
      if (place.part < 0)
        field(place.face) = value;
      else
        field.parts()[place.part] = value;
    });
    set_means(field, model.grid());
    field.exchange(1);
  }


  template <int dim>
  typename ImmersedViscousTerm<dim>::Motion
  ImmersedViscousTerm<dim>::friction_by(const Vector &change, const Motion &of_nodes) const
  {
    Field<dim> field(model.grid().faces(axis), open);
    set_values(field, change);
    Motion on_nodes(of_nodes.size(), 0.);
    for (const auto &term : given_terms)
      {
        double sum = by_nodes(term, of_nodes);
        for (const auto &[place, coefficient] : term.faces)
          if (!is_prescribed(place))
            sum += coefficient * value_at(field, place);
        for (const auto &[node, coefficient] : term.nodes)
          on_nodes[node] -= term.weight * coefficient * sum;
      }
    dealii::Utilities::MPI::sum(on_nodes, model.grid().communicator(), on_nodes);
    return on_nodes;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::vmult(Vector       &result,
                                  const Vector &change,
                                  const Motion &of_nodes) const
  {
    solver.matrix.vmult(result, change);
    std::vector<std::pair<Number, double>> free;
    for (const auto &term : given_terms)
      {
        const double sum = by_nodes(term, of_nodes);
        if (sum == 0)
          continue;
        collect(free, term);
        for (const auto &[row, coefficient] : free)
          result(row) += assembled_dt * term.weight * coefficient * sum;
      }
    result.compress(dealii::VectorOperation::add);
  }


  /// The Schur complement of the fluid with a diagonal in the place of its matrix, summed over the
  /// nodes of each term: h w (1 - sum_f h w c_f^2 / A_ff) |c_k| sum_l |c_l|.
  template <int dim>
  typename ImmersedViscousTerm<dim>::Motion
  ImmersedViscousTerm<dim>::damping() const
  {
    Field<dim> diagonal(model.grid().faces(axis), open);
    Vector     values(first);
    for (const auto row : mine)
      values(row) = solver.matrix.diag_element(row);
    values.compress(dealii::VectorOperation::insert);
    set_values(diagonal, values);
    Motion result(nodes.size(), 0.);
    for (const auto &term : given_terms)
      {
        double left = 1, all = 0;
        for (const auto &[place, coefficient] : term.faces)
          if (!is_prescribed(place))
            left -=
              assembled_dt * term.weight * coefficient * coefficient / value_at(diagonal, place);
        for (const auto &[node, coefficient] : term.nodes)
          all += std::abs(coefficient);
        for (const auto &[node, coefficient] : term.nodes)
          result[node] += term.weight * std::max(0., left) * std::abs(coefficient) * all;
      }
    dealii::Utilities::MPI::sum(result, model.grid().communicator(), result);
    return result;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::measure_forces(const Field<dim> &field)
  {
    const auto communicator = model.grid().communicator();
    last_forces.on_nodes.assign(no_slip_surfaces->n_nodes, 0.);
    last_forces.on_boundaries.assign(model.boundaries().all().size(), 0.);
    for (const auto &term : given_terms)
      {
        double sum = given_part(term, field);
        for (const auto &[place, coefficient] : term.faces)
          if (!is_prescribed(place))
            sum += coefficient * value_at(field, place);
        const double force = -term.weight * sum;
        for (const auto &[node, coefficient] : term.nodes)
          last_forces.on_nodes[node] += force * coefficient;
        for (const auto &[place, coefficient] : term.faces)
          if (is_prescribed(place))
            {
              const Side side{axis, place.face[axis] == 0 ? 0u : 1u};
              last_forces.on_boundaries[model.boundaries().number(side, place.face)] +=
                force * coefficient;
            }
        if (term.wall.boundary)
          last_forces.on_boundaries[term.wall.boundary - model.boundaries().all().data()] -= force;
      }
    for (auto *forces : {&last_forces.on_nodes, &last_forces.on_boundaries})
      dealii::Utilities::MPI::sum(*forces, communicator, *forces);
  }


  template <int dim>
  unsigned int
  ImmersedViscousTerm<dim>::solve(Vector &solution) const
  {
    return solver.solve(solution, right_side);
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::finish(Field<dim>   &field,
                                   const Vector &solution,
                                   const Motion &change_of_nodes)
  {
    for (std::size_t node = 0; node < change_of_nodes.size(); ++node)
      nodes[node] += change_of_nodes[node];
    set_values(field, solution);
    measure_forces(field);
  }


  template <int dim>
  std::size_t
  ImmersedViscousTerm<dim>::memory_consumption() const
  {
    return solver.memory_consumption() + friction.memory_consumption() +
           numbers.memory_consumption() + convective_entries.memory_consumption() +
           given_terms.capacity() * sizeof(ViscousTerm<dim>);
  }


  template class ImmersedViscousTerm<2>;
  template class ImmersedViscousTerm<3>;
} // namespace undine
