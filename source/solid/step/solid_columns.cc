// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/cell_forces.h>
#include <undine/solid/assembly/contact.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/step/solid_columns.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>

namespace undine
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  namespace
  {
    const char *const axis_names[3] = {"x", "y", "z"};


    /// A nodal field at a quadrature point.
    template <int dim>
    dealii::Tensor<1, dim>
    at_point(const RestGeometry<dim>   &geometry,
             const unsigned int         point,
             const std::vector<double> &nodal)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int dof = 0; dof < nodal.size(); ++dof)
        result[dof % dim] += geometry.shape(dof / dim, point) * nodal[dof];
      return result;
    }


    /// action(mass of the point [kg], place now [m], velocity [m/s]) at all quadrature points.
    template <int dim, class Action>
    void
    at_all_points(const SolidModel<dim> &model,
                  const Vector          &displacement,
                  const Vector          &velocity,
                  const Action          &action)
    {
      const auto         &geometry  = model.geometry();
      const Vector        d_ghosted = model.ghosted(displacement);
      const Vector        u_ghosted = model.ghosted(velocity);
      std::vector<double> d(geometry.n_nodes() * dim), u(d.size());
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          d_ghosted.extract_subvector_to(geometry.dofs(cell), d);
          u_ghosted.extract_subvector_to(geometry.dofs(cell), u);
          const double density = model.bodies()[geometry.body(cell)].density;
          for (unsigned int q = 0; q < geometry.n_points(); ++q)
            action(density * geometry.JxW(cell, q),
                   geometry.position(cell, q) + at_point(geometry, q, d),
                   at_point(geometry, q, u));
        }
    }


    /// Sum of the support forces on each boundary of each body, [body][boundary].
    template <int dim>
    std::vector<std::vector<dealii::Tensor<1, dim>>>
    support_forces(const SolidModel<dim> &model, const Vector &reactions)
    {
      std::vector<std::vector<dealii::Tensor<1, dim>>> result;
      for (const auto &body : model.bodies())
        result.emplace_back(body.boundaries.size());
      if (reactions.size() == 0)
        return result;
      for (const auto &fixed : model.fixed())
        result[fixed.body][fixed.boundary][fixed.axis] += reactions(fixed.dof);
      for (auto &of_body : result)
        for (auto &force : of_body)
          force = dealii::Utilities::MPI::sum(force, model.communicator());
      return result;
    }


    template <int dim>
    void
    add_vector(Columns                      &columns,
               const std::string            &name,
               const std::string            &unit,
               const dealii::Tensor<1, dim> &value)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        columns.push_back({name + " " + axis_names[axis], unit, value[axis]});
    }


    template <int dim>
    void
    add_asleep(SolidMeasures<dim>       &measures,
               const SolidMeasures<dim> &asleep,
               const SolidModel<dim>    &awake)
    {
      measures.kinetic_energy += asleep.kinetic_energy;
      measures.elastic_energy += asleep.elastic_energy;
      measures.load_potential += asleep.load_potential;
      measures.momentum += asleep.momentum;
      for (unsigned int b = 0; b < measures.bodies.size(); ++b)
        if (!awake.has(b))
          measures.bodies[b] = asleep.bodies[b];
    }
  } // namespace


  template <int dim>
  double
  kinetic_energy(const SolidModel<dim> &model, const Matrix &mass, const Vector &velocity)
  {
    Vector momentum = model.vector();
    mass.vmult(momentum, velocity);
    return momentum * velocity / 2;
  }


  template <int dim>
  double
  load_potential(const SolidModel<dim>       &model,
                 const SolidEnvironment<dim> &environment,
                 const Vector                &displacement,
                 const double                 time)
  {
    return -(dead_loads(model, environment, time) * displacement);
  }


  template <int dim>
  dealii::Tensor<1, dim>
  linear_momentum(const SolidModel<dim> &model, const Vector &velocity)
  {
    dealii::Tensor<1, dim> sum;
    at_all_points(model, velocity, velocity, [&](const double mass, const auto &, const auto &u) {
      sum += mass * u;
    });
    return dealii::Utilities::MPI::sum(sum, model.communicator());
  }


  template <int dim>
  dealii::Tensor<1, 3>
  angular_momentum(const SolidModel<dim> &model, const Vector &displacement, const Vector &velocity)
  {
    dealii::Tensor<1, 3> sum;
    at_all_points(
      model, displacement, velocity, [&](const double mass, const auto &place, const auto &u) {
        dealii::Tensor<1, 3> x, v;
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            x[axis] = place[axis];
            v[axis] = u[axis];
          }
        sum += mass * dealii::cross_product_3d(x, v);
      });
    return dealii::Utilities::MPI::sum(sum, model.communicator());
  }


  template <int dim>
  std::vector<BodyMeasure<dim>>
  measure_bodies(const SolidModel<dim> &model, const Vector &displacement)
  {
    const auto                   &geometry = model.geometry();
    const Vector                  ghosted  = model.ghosted(displacement);
    std::vector<double>           d(geometry.n_nodes() * dim);
    std::vector<BodyMeasure<dim>> result(model.bodies().size());
    CellForces<dim>               cell_forces(model);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        auto        &body    = result[geometry.body(cell)];
        const double density = model.bodies()[geometry.body(cell)].density;
        ghosted.extract_subvector_to(geometry.dofs(cell), d);
        cell_forces.reinit(cell, ghosted);
        for (unsigned int q = 0; q < geometry.n_points(); ++q)
          {
            const double volume = geometry.JxW(cell, q);
            body.mass += density * volume;
            body.volume += volume * cell_forces.stretched_volume(q);
            body.centre_of_mass +=
              density * volume * (geometry.position(cell, q) + at_point(geometry, q, d));
          }
      }
    for (auto &body : result)
      {
        body.mass   = dealii::Utilities::MPI::sum(body.mass, model.communicator());
        body.volume = dealii::Utilities::MPI::sum(body.volume, model.communicator());
        if (body.mass == 0) // not in this model
          continue;
        body.centre_of_mass =
          dealii::Point<dim>(dealii::Utilities::MPI::sum(
                               dealii::Tensor<1, dim>(body.centre_of_mass), model.communicator()) /
                             body.mass);
      }
    return result;
  }


  template <int dim>
  std::vector<double>
  maximum_speeds(const SolidModel<dim> &model, const Vector &velocity)
  {
    const auto         &geometry = model.geometry();
    const Vector        ghosted  = model.ghosted(velocity);
    std::vector<double> u(geometry.n_nodes() * dim);
    std::vector<double> result(model.bodies().size(), 0.);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        ghosted.extract_subvector_to(geometry.dofs(cell), u);
        double &largest = result[geometry.body(cell)];
        for (unsigned int node = 0; node < geometry.n_nodes(); ++node)
          {
            dealii::Tensor<1, dim> at_node;
            for (unsigned int axis = 0; axis < dim; ++axis)
              at_node[axis] = u[node * dim + axis];
            largest = std::max(largest, at_node.norm());
          }
      }
    for (auto &largest : result)
      largest = dealii::Utilities::MPI::max(largest, model.communicator());
    return result;
  }


  template <int dim>
  SolidMeasures<dim>
  measure_solid(const SolidModel<dim>       &model,
                const SolidStepper<dim>     &step,
                const SolidEnvironment<dim> &environment,
                const SolidState            &state,
                const double                 time,
                const SolidReport<dim>      &report)
  {
    SolidMeasures<dim> result;
    if (model.numerics().integrator->has_inertia())
      result.kinetic_energy = kinetic_energy(model, step.mass(), state.velocity);
    result.elastic_energy = elastic_energy(model, state.displacement);
    result.load_potential = load_potential(model, environment, state.displacement, time);
    result.momentum       = linear_momentum(model, state.velocity);
    const auto measures   = measure_bodies(model, state.displacement);
    const auto speeds     = maximum_speeds(model, state.velocity);
    const auto supports   = support_forces(model, report.reactions);
    for (unsigned int b = 0; b < model.bodies().size(); ++b)
      result.bodies.push_back(
        {measures[b],
         model.has(b) ? measures[b].volume / step.initial_volumes()[b] - 1 : 0,
         speeds[b],
         report.momentum_residuals.empty() ? 0 : report.momentum_residuals[b],
         supports[b]});
    return result;
  }


  template <int dim>
  Columns
  columns_of(const SolidMeasures<dim> &measures, const std::vector<Body<dim>> &bodies)
  {
    Columns    columns;
    const auto add = [&](const std::string &name, const std::string &unit, const double value) {
      columns.push_back({name, unit, value});
    };
    add("solid kinetic energy", "J", measures.kinetic_energy);
    add("solid elastic energy", "J", measures.elastic_energy);
    add("solid load potential", "J", measures.load_potential);
    add_vector(columns, "solid momentum", "kg m/s", measures.momentum);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const auto &body    = bodies[b];
        const auto &of_body = measures.bodies[b];
        add("volume " + body.name, fmt::format("m^{}", dim), of_body.measure.volume);
        add("volume drift " + body.name, "1", of_body.drift);
        add_vector<dim>(columns,
                        "centre of mass " + body.name,
                        "m",
                        dealii::Tensor<1, dim>(of_body.measure.centre_of_mass));
        add("max speed " + body.name, "m/s", of_body.speed);
        add("momentum residual " + body.name, "1", of_body.residual);
        for (unsigned int boundary = 0; boundary < body.boundaries.size(); ++boundary)
          if (body.boundaries[boundary].fixes_displacement())
            add_vector(columns,
                       "reaction " + body.name + "/" + body.boundaries[boundary].name,
                       "N",
                       of_body.supports[boundary]);
      }
    return columns;
  }


  template <int dim>
  Columns
  solid_columns(const SolidModel<dim>       &model,
                const SolidStepper<dim>     &step,
                const SolidEnvironment<dim> &environment,
                const SolidState            &state,
                const double                 time,
                const SolidReport<dim>      &report)
  {
    auto measures = measure_solid(model, step, environment, state, time, report);
    if (environment.asleep)
      add_asleep(measures, *environment.asleep, model);
    auto columns = columns_of(measures, model.bodies());
    if (environment.contact)
      for (const auto &column : environment.contact->columns(state.displacement, time))
        columns.push_back(column);
    return columns;
  }


#define UNDINE_INSTANTIATE(dim)                                                                   \
  template double kinetic_energy(const SolidModel<dim> &, const Matrix &, const Vector &);        \
  template double load_potential(                                                                 \
    const SolidModel<dim> &, const SolidEnvironment<dim> &, const Vector &, double);              \
  template dealii::Tensor<1, dim> linear_momentum(const SolidModel<dim> &, const Vector &);       \
  template dealii::Tensor<1, 3>   angular_momentum(                                               \
      const SolidModel<dim> &, const Vector &, const Vector &);                                   \
  template std::vector<BodyMeasure<dim>> measure_bodies(const SolidModel<dim> &, const Vector &); \
  template std::vector<double>           maximum_speeds(const SolidModel<dim> &, const Vector &); \
  template SolidMeasures<dim>            measure_solid(const SolidModel<dim> &,                   \
                                                       const SolidStepper<dim> &,                 \
                                                       const SolidEnvironment<dim> &,             \
                                                       const SolidState &,                        \
                                                       double,                                    \
                                                       const SolidReport<dim> &);                 \
  template Columns columns_of(const SolidMeasures<dim> &, const std::vector<Body<dim>> &);        \
  template Columns solid_columns(const SolidModel<dim> &,                                         \
                                 const SolidStepper<dim> &,                                       \
                                 const SolidEnvironment<dim> &,                                   \
                                 const SolidState &,                                              \
                                 double,                                                          \
                                 const SolidReport<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
