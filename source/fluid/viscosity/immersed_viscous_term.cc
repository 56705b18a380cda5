// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/viscosity/immersed_viscous_term.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace undine
{
  namespace
  {
    /// Each entry once.
    NodeDampings
    summed(NodeDampings entries)
    {
      const auto place = [](const NodeDamping &entry) {
        return std::make_pair(entry.row, entry.column);
      };
      std::sort(entries.begin(), entries.end(), [&](const auto &a, const auto &b) {
        return place(a) < place(b);
      });
      NodeDampings result;
      for (const auto &entry : entries)
        if (!result.empty() && place(result.back()) == place(entry))
          result.back().value += entry.value;
        else
          result.push_back(entry);
      return result;
    }
  } // namespace


  template <int dim>
  ImmersedViscousTerm<dim>::ImmersedViscousTerm(const FluidModel<dim>                     &model,
                                                const unsigned int                         axis,
                                                std::shared_ptr<const FluidTopology<dim>>  open,
                                                std::shared_ptr<const NoSlipSurfaces<dim>> walls_,
                                                const double viscosity)
    : model(model)
    , axis(axis)
    , unknowns(model, axis, std::move(open))
    , no_slip_surfaces(std::move(walls_))
    , terms(model, axis, *topology(), *no_slip_surfaces, viscosity)
    , viscosity(viscosity)
    , convection(unknowns)
  {
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


  /// The unknowns of a term and their coefficients.
  template <int dim>
  void
  ImmersedViscousTerm<dim>::collect(std::vector<std::pair<Number, double>> &free,
                                    const ViscousTerm<dim>                 &term) const
  {
    free.clear();
    for (const auto &[place, coefficient] : term.faces)
      if (!unknowns.is_prescribed(place))
        free.emplace_back(unknowns.number(place), coefficient);
  }


  template <int dim>
  void
  ImmersedViscousTerm<dim>::make_pattern(const DualFluxes<dim> *fluxes)
  {
    std::vector<std::pair<Number, double>> free;
    std::vector<Number>                    columns;
    const auto                             relevant = unknowns.relevant();
    const auto                            &mine     = unknowns.owned();
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
      convection.start_pattern(pattern, *fluxes);
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
    unknowns.for_each_owned([&](const FacePlace<dim> &place) {
      friction.add(unknowns.number(place), unknowns.number(place), unknowns.mass(place));
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
      if (unknowns.is_prescribed(place))
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
    first = unknowns.vector();
    right_side.reinit(first);
    std::size_t k = 0;
    unknowns.for_each_owned([&](const FacePlace<dim> &place) {
      first.begin()[k]        = value_at(field, place);
      right_side.begin()[k++] = unknowns.mass(place) * value_at(field, place);
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
    convection.add(solver.matrix, right_side, dt, *fluxes, field);
    solver.set_up(diffusion_number(), DiffusionSolver::Matrices::with_convection);
  }


  template <int dim>
  typename ImmersedViscousTerm<dim>::Motion
  ImmersedViscousTerm<dim>::friction_by(const Vector &change, const Motion &of_nodes) const
  {
    Field<dim> field(model.grid().faces(axis), topology());
    unknowns.copy(field, change);
    Motion on_nodes(of_nodes.size(), 0.);
    for (const auto &term : given_terms)
      {
        double sum = by_nodes(term, of_nodes);
        for (const auto &[place, coefficient] : term.faces)
          if (!unknowns.is_prescribed(place))
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


  /// The Schur complement of the fluid with a diagonal in the place of its matrix, term by term: h
  /// w (1 - sum_f h w c_f^2 / A_ff) c_k c_l.
  template <int dim>
  template <class Action>
  void
  ImmersedViscousTerm<dim>::for_each_damping(const Action &action) const
  {
    Field<dim> diagonal(model.grid().faces(axis), topology());
    Vector     values(first);
    for (const auto row : unknowns.owned())
      values(row) = solver.matrix.diag_element(row);
    values.compress(dealii::VectorOperation::insert);
    unknowns.copy(diagonal, values);
    for (const auto &term : given_terms)
      {
        double left = 1;
        for (const auto &[place, coefficient] : term.faces)
          if (!unknowns.is_prescribed(place))
            left -=
              assembled_dt * term.weight * coefficient * coefficient / value_at(diagonal, place);
        if (left > 0 && !term.nodes.empty())
          action(term, term.weight * left);
      }
  }


  template <int dim>
  typename ImmersedViscousTerm<dim>::Motion
  ImmersedViscousTerm<dim>::damping() const
  {
    Motion result(nodes.size(), 0.);
    for_each_damping([&](const ViscousTerm<dim> &term, const double weight) {
      double all = 0;
      for (const auto &[node, coefficient] : term.nodes)
        all += std::abs(coefficient);
      for (const auto &[node, coefficient] : term.nodes)
        result[node] += weight * std::abs(coefficient) * all;
    });
    dealii::Utilities::MPI::sum(result, model.grid().communicator(), result);
    return result;
  }


  template <int dim>
  NodeDampings
  ImmersedViscousTerm<dim>::damping_matrix() const
  {
    NodeDampings mine, result;
    for_each_damping([&](const ViscousTerm<dim> &term, const double weight) {
      for (const auto &[row, coefficient] : term.nodes)
        for (const auto &[column, factor] : term.nodes)
          mine.push_back({row, column, weight * coefficient * factor});
    });
    for (const auto &part : dealii::Utilities::MPI::all_gather(model.grid().communicator(), mine))
      result.insert(result.end(), part.begin(), part.end());
    return summed(std::move(result));
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
          if (!unknowns.is_prescribed(place))
            sum += coefficient * value_at(field, place);
        const double force = -term.weight * sum;
        for (const auto &[node, coefficient] : term.nodes)
          last_forces.on_nodes[node] += force * coefficient;
        for (const auto &[place, coefficient] : term.faces)
          if (unknowns.is_prescribed(place))
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
    unknowns.copy(field, solution);
    measure_forces(field);
  }


  template <int dim>
  std::size_t
  ImmersedViscousTerm<dim>::memory_consumption() const
  {
    return solver.memory_consumption() + friction.memory_consumption() +
           unknowns.memory_consumption() + convection.memory_consumption() +
           given_terms.capacity() * sizeof(ViscousTerm<dim>);
  }


  template class ImmersedViscousTerm<2>;
  template class ImmersedViscousTerm<3>;
} // namespace undine
