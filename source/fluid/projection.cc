// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary_condition.h>
#include <undine/fluid/pressure_gradient.h>
#include <undine/fluid/pressure_matrix.h>
#include <undine/fluid/projection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  namespace
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// The smallest flux_area() of all cells.
    template <int dim>
    double
    smallest_flux_area(const MacGrid<dim> &grid)
    {
      double smallest = flux_area<dim>(grid, grid.cells()->owned().lower);
      for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
        smallest = std::min(smallest, flux_area(grid, cell));
      });
      return dealii::Utilities::MPI::min(smallest, grid.communicator());
    }


    template <int dim>
    void
    check_net_flux(const FluidModel<dim> &model, const Velocity<dim> &velocity, const double time)
    {
      const auto complaint = net_flux_complaint(model, velocity);
      if (!complaint.empty())
        throw InputError(fmt::format("At {:.6g} s {}. Make one boundary an 'outflow' or of the "
                                     "kind 'pressure', or balance the inflows.",
                                     time,
                                     complaint));
    }


    /// Subtract the mean of a cell field, which a domain without opening leaves undetermined.
    template <int dim>
    void
    remove_mean(Field<dim> &field, const FluidModel<dim> &model)
    {
      const double mean = integral(model, field) / fluid_volume(model);
      for_each(field.owned(), [&](const GridIndex<dim> &cell) { field(cell) -= mean; });
    }
  } // namespace


  template <int dim>
  Projection<dim>::Projection(const FluidModel<dim> &model_)
    : model(model_)
  {
  }


  template <int dim>
  void
  Projection<dim>::set_up()
  {
    matrix = std::make_unique<dealii::TrilinosWrappers::SparseMatrix>();
    build_pressure_matrix(*matrix, model);
    smallest_area = smallest_flux_area(model.grid());

    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.aggregation_threshold = 0.02;
    data.smoother_type         = "Chebyshev";
    data.smoother_sweeps       = 2;
    multigrid                  = std::make_unique<dealii::TrilinosWrappers::PreconditionAMG>();
    multigrid->initialize(*matrix, data);
  }


  template <int dim>
  unsigned int
  Projection<dim>::solve(Vector &impulse, const Vector &right_side, const double tolerance) const
  {
    dealii::SolverControl    control(model.pressure_solver().maximum_iterations, tolerance);
    dealii::SolverCG<Vector> solver(control);
    try
      {
        solver.solve(*matrix, impulse, right_side, *multigrid);
      }
    catch (const dealii::SolverControl::NoConvergence &failure)
      {
        throw SolveError(
          fmt::format("The fluid's pressure did not converge: after {} iterations the residual is "
                      "{:.3g} m^{}/s, allowed {:.3g}. Try a larger 'Fluid/Pressure solver/Maximum "
                      "iterations' or 'Divergence tolerance', or a grid with less stretched cells.",
                      failure.last_step,
                      failure.last_residual,
                      dim,
                      tolerance));
      }
    return control.last_step();
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::remove_divergence(Velocity<dim>              &velocity,
                                     Field<dim>                 &impulse,
                                     std::vector<OpenFace<dim>> &openings)
  {
    if (!matrix)
      set_up();
    const auto  &grid        = model.grid();
    const auto   numbers     = grid.cells()->owned_numbers();
    const double tolerance   = model.pressure_solver().divergence_tolerance;
    const double first_speed = largest_components(model, velocity).norm();
    Vector       right_side(numbers, grid.communicator()), correction(right_side);
    Field<dim>   increment = impulse;
    Report       report;

    for (unsigned int round = 0; round < 8; ++round)
      {
        increment.exchange(1);
        add(velocity, 1., pressure_acceleration(model, increment, openings));
        for (auto &open : openings)
          open.pressure = 0;
        exchange(velocity);

        const auto   fluxes     = divergence(model, velocity);
        const double divergence = largest_divergence(model, fluxes);
        const double speed      = largest_components(model, velocity).norm();
        report.divergence       = divergence == 0 ? 0. : divergence / speed;
        // Below 1e-4 of the speeds that cancelled there is nothing but rounding.
        const double allowed = tolerance * std::max(speed, 1e-4 * first_speed);
        if (divergence <= allowed)
          return report;

        for (std::size_t k = 0; k < fluxes.size(); ++k)
          right_side.begin()[k] = -fluxes[k];
        if (!model.boundaries().has_opening())
          right_side.add(-right_side.mean_value());
        correction = 0;
        // In the mean over cells a quarter of what is allowed, then less: some have more.
        const double in_the_mean = std::sqrt(double(numbers.size())) * smallest_area * allowed;
        report.iterations += solve(correction, right_side, in_the_mean * std::pow(0.25, round + 1));
        increment.set_owned_values({correction.begin(), correction.end()});
        for_each(impulse.owned(),
                 [&](const GridIndex<dim> &cell) { impulse(cell) += increment(cell); });
      }
    throw SolveError(
      fmt::format("The fluid's divergence stays at {:.3g} of its speed per cell, above "
                  "the tolerance {:.3g}. Try a larger 'Fluid/Pressure "
                  "solver/Divergence tolerance', or a grid with less stretched cells.",
                  report.divergence,
                  tolerance));
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::project(FluidState<dim> &state, const double time, const double dt)
  {
    return project(state, state.velocity, time, dt);
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::project(FluidState<dim>     &state,
                           const Velocity<dim> &carrying,
                           const double         time,
                           const double         dt)
  {
    set_boundary_velocity(state.velocity, model, time);
    const bool closed = !model.boundaries().has_opening();
    check_net_flux(model, state.velocity, time);
    auto openings = open_faces(model, carrying, time);
    for (auto &open : openings)
      open.pressure *= dt;
    for_each(state.pressure.owned(),
             [&](const GridIndex<dim> &cell) { state.pressure(cell) *= dt; });
    const auto report = remove_divergence(state.velocity, state.pressure, openings);
    for_each(state.pressure.owned(),
             [&](const GridIndex<dim> &cell) { state.pressure(cell) /= dt; });
    if (closed)
      remove_mean(state.pressure, model);
    return report;
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::make_divergence_free(FluidState<dim> &state, const double time)
  {
    set_boundary_velocity(state.velocity, model, time);
    check_net_flux(model, state.velocity, time);
    auto openings = open_faces(model, state.velocity, time);
    for (auto &open : openings)
      open.pressure = 0;
    Field<dim> impulse(model.grid().cells());
    const auto report = remove_divergence(state.velocity, impulse, openings);
    state.pressure    = Field<dim>(model.grid().cells());
    return report;
  }


  template class Projection<2>;
  template class Projection<3>;
} // namespace undine
