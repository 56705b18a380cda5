// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/viscosity/immersed_viscous_term.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <cmath>
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


  /// action(row, column place, column number, coefficient [kg/s]) of what convection adds to the
  /// equation of every place whose velocity is not prescribed: rho phi (v_to - v_from) / 2 in both,
  /// phi being what flows from one to the other.
  template <int dim>
  template <class Action>
  void
  ImmersedViscousTerm<dim>::for_each_convective_row(const DualFluxes<dim> &fluxes,
                                                    const Action          &action) const
  {
    const double half = model.density() / 2;
    fluxes.for_each_between(
      axis, [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double flux) {
        for (const auto *row : {&from, &to})
          if (!is_prescribed(*row))
            {
              action(*row, from, -half * flux);
              action(*row, to, half * flux);
            }
      });
  }


  /// What enters through sides, and what prescribed velocities contribute.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_given_convection(Vector                &load,
                                                 const DualFluxes<dim> &fluxes,
                                                 const Field<dim>      &field) const
  {
    for_each_convective_row(
      fluxes, [&](const FacePlace<dim> &row, const FacePlace<dim> &column, const double factor) {
        if (is_prescribed(column))
          load(number(row)) -= assembled_dt * factor * value_at(field, column);
      });
    if (const auto *start = fluxes.start())
      for_each_owned([&](const FacePlace<dim> &place) {
        load(number(place)) += shrinkage(number(place)) * value_at((*start)[axis], place);
      });
    fluxes.for_each_entering(
      axis, [&](const FacePlace<dim> &place, const double flux, const double velocity) {
        if (!is_prescribed(place))
          load(number(place)) += assembled_dt * model.density() * flux * velocity;
      });
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


  /// Faces and pieces of rank 0 first; the nodes of bodies belong to the last rank.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::number_unknowns()
  {
    namespace mpi           = dealii::Utilities::MPI;
    const auto communicator = model.grid().communicator();
    const bool is_last =
      mpi::this_mpi_process(communicator) + 1 == mpi::n_mpi_processes(communicator);
    numbers      = Field<dim>(model.grid().faces(axis), open);
    Number count = 0;
    for_each_value(numbers, [&](double &, const auto &, const auto &) { ++count; });
    first_node           = mpi::sum(count, communicator);
    const Number n_nodes = is_last ? no_slip_surfaces->masses.size() : 0;
    mine                 = mpi::create_ascending_partitioning(communicator,
                                              count + n_nodes)[mpi::this_mpi_process(communicator)];
    Number next          = count > 0 ? mine.nth_index_in_set(0) : 0;
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


  template <int dim>
  bool
  ImmersedViscousTerm<dim>::is_free(const unsigned int node) const
  {
    return node < no_slip_surfaces->masses.size() &&
           std::isfinite(no_slip_surfaces->masses[node][axis]);
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
    for (const auto &[node, coefficient] : term.nodes)
      if (is_free(node))
        free.emplace_back(first_node + node, coefficient);
  }


  template <int dim>
  dealii::TrilinosWrappers::SparsityPattern
  ImmersedViscousTerm<dim>::pattern(const DualFluxes<dim> *fluxes) const
  {
    std::vector<std::pair<Number, double>> free;
    std::vector<Number>                    columns;
    // A rank without fluid must not announce rows: their numbers would be taken for a huge range.
    dealii::TrilinosWrappers::SparsityPattern result(
      mine, model.grid().communicator(), mine.is_empty() ? 0 : 2 * dim + 1);
    for (const auto row : mine)
      result.add(row, row);
    for_each_viscous_term([&](const ViscousTerm<dim> &term) {
      collect(free, term);
      columns.clear();
      for (const auto &unknown : free)
        columns.push_back(unknown.first);
      for (const auto row : columns)
        result.add_entries(row, columns.begin(), columns.end());
    });
    if (fluxes)
      for_each_convective_row(
        *fluxes, [&](const FacePlace<dim> &row, const FacePlace<dim> &column, const double) {
          if (!is_prescribed(column))
            result.add(number(row), number(column));
        });
    result.compress();
    return result;
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
    for (unsigned int node = 0; node < no_slip_surfaces->masses.size(); ++node)
      if (mine.is_element(first_node + node))
        friction.add(first_node + node,
                     first_node + node,
                     is_free(node) ? no_slip_surfaces->masses[node][axis] : 1.);
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


  template <int dim>
  void
  ImmersedViscousTerm<dim>::add_convection(const DualFluxes<dim> &fluxes)
  {
    auto &matrix = solver.matrix;
    for_each_convective_row(
      fluxes, [&](const FacePlace<dim> &row, const FacePlace<dim> &column, const double factor) {
        if (!is_prescribed(column))
          matrix.add(number(row), number(column), assembled_dt * factor);
      });
    fluxes.for_each_entering(
      axis, [&](const FacePlace<dim> &place, const double flux, const double) {
        if (!is_prescribed(place))
          matrix.add(number(place), number(place), assembled_dt * model.density() * flux);
      });
    matrix.compress(dealii::VectorOperation::add);
    if (!fluxes.start())
      return;
    find_shrinkage(fluxes);
    for_each_owned([&](const FacePlace<dim> &place) {
      matrix.add(number(place), number(place), shrinkage(number(place)));
    });
    matrix.compress(dealii::VectorOperation::add);
  }


  /// What leaves the dual volumes in a step [kg]. V^0 is not negative, but for what the flow does
  /// not fit.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::find_shrinkage(const DualFluxes<dim> &fluxes)
  {
    shrinkage.reinit(mine, model.grid().communicator());
    fluxes.for_each_between(
      axis, [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double flux) {
        shrinkage(number(from)) += assembled_dt * model.density() * flux;
        shrinkage(number(to)) -= assembled_dt * model.density() * flux;
      });
    fluxes.for_each_leaving(axis, [&](const FacePlace<dim> &place, const double flux) {
      shrinkage(number(place)) += assembled_dt * model.density() * flux;
    });
    shrinkage.compress(dealii::VectorOperation::add);
    for_each_owned([&](const FacePlace<dim> &place) {
      double &leaving = shrinkage.begin()[mine.index_within_set(number(place))];
      leaving         = is_prescribed(place) ? 0. : std::max(leaving, -mass(place));
    });
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
  ImmersedViscousTerm<dim>::set_up(const double dt, const DualFluxes<dim> *fluxes)
  {
    using Matrices = DiffusionSolver::Matrices;
    if (dt != assembled_dt)
      {
        friction.reinit(pattern(fluxes));
        assemble_friction(dt);
        if (!fluxes)
          {
            solver.matrix.copy_from(friction);
            friction.clear();
            solver.set_up(diffusion_number(), Matrices::symmetric);
          }
      }
    if (!fluxes)
      return;
    solver.matrix.copy_from(friction);
    add_convection(*fluxes);
    solver.set_up(diffusion_number(), Matrices::with_convection);
  }


  /// sum c v over what is not an unknown.
  template <int dim>
  double
  ImmersedViscousTerm<dim>::given_part(const ViscousTerm<dim> &term,
                                       const Field<dim>       &field,
                                       const double            time) const
  {
    double sum = 0;
    for (const auto &[place, coefficient] : term.faces)
      if (is_prescribed(place))
        sum += coefficient * value_at(field, place);
    for (const auto &[node, coefficient] : term.nodes)
      if (!is_free(node))
        sum += coefficient * nodes[node];
    if (const auto &wall = term.wall; wall.boundary)
      sum -= wall.boundary->velocity_along(axis, wall.normal, wall.place, time);
    return sum;
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::fill(Vector           &solution,
                                 Vector           &load,
                                 const Field<dim> &field,
                                 const double      time) const
  {
    for_each_owned([&](const FacePlace<dim> &place) {
      solution(number(place)) = value_at(field, place);
      load(number(place))     = mass(place) * value_at(field, place);
    });
    for (unsigned int node = 0; node < no_slip_surfaces->masses.size(); ++node)
      if (const auto number = first_node + node; mine.is_element(number))
        {
          solution(number) = nodes[node];
          load(number) =
            (is_free(node) ? no_slip_surfaces->masses[node][axis] : 1.) * solution(number);
        }
    solution.compress(dealii::VectorOperation::insert);
    load.compress(dealii::VectorOperation::insert);
    std::vector<std::pair<Number, double>> free;
    for (const auto &term : given_terms)
      if (const double given = given_part(term, field, time); given != 0)
        {
          collect(free, term);
          for (const auto &[row, coefficient] : free)
            load(row) -= assembled_dt * term.weight * coefficient * given;
        }
    load.compress(dealii::VectorOperation::add);
  }


  /// As bodies would move by friction alone.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::take_over_free_nodes(const Vector &solution)
  {
    std::vector<double> values(no_slip_surfaces->masses.size(), 0.);
    for (unsigned int node = 0; node < values.size(); ++node)
      if (mine.is_element(first_node + node))
        values[node] = solution(first_node + node);
    dealii::Utilities::MPI::sum(values, model.grid().communicator(), values);
    std::copy(values.begin(), values.end(), nodes.begin());
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::measure_forces(const Field<dim> &field, const double time)
  {
    const auto communicator = model.grid().communicator();
    last_forces.on_nodes.assign(no_slip_surfaces->n_nodes, 0.);
    last_forces.on_boundaries.assign(model.boundaries().all().size(), 0.);
    for (const auto &term : given_terms)
      {
        double sum = given_part(term, field, time);
        for (const auto &[place, coefficient] : term.faces)
          if (!is_prescribed(place))
            sum += coefficient * value_at(field, place);
        for (const auto &[node, coefficient] : term.nodes)
          if (is_free(node))
            sum += coefficient * nodes[node];
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
  ImmersedViscousTerm<dim>::step(Field<dim>                                &field,
                                 const std::vector<dealii::Tensor<1, dim>> &node_velocities,
                                 const double                               time,
                                 const double                               dt,
                                 const DualFluxes<dim>                     *fluxes)
  {
    nodes.clear();
    for (const auto &velocity : node_velocities)
      nodes.push_back(velocity[axis]);
    set_up(dt, fluxes);
    field.exchange(1);
    Vector solution(mine, model.grid().communicator()), load(solution);
    fill(solution, load, field, time);
    if (fluxes)
      {
        add_given_convection(load, *fluxes, field);
        load.compress(dealii::VectorOperation::add);
      }
    const unsigned int n_iterations = solver.solve(solution, load);
    for_each_owned([&](const FacePlace<dim> &place) {
      const double value = solution(number(place));
      if (place.part < 0)
        field(place.face) = value;
      else
        field.parts()[place.part] = value;
    });
    set_means(field, model.grid());
    field.exchange(1);
    take_over_free_nodes(solution);
    measure_forces(field, time);
    return n_iterations;
  }


  template <int dim>
  std::size_t
  ImmersedViscousTerm<dim>::memory_consumption() const
  {
    return solver.memory_consumption() + friction.memory_consumption() +
           numbers.memory_consumption() + given_terms.capacity() * sizeof(ViscousTerm<dim>);
  }


  template class ImmersedViscousTerm<2>;
  template class ImmersedViscousTerm<3>;
} // namespace undine
