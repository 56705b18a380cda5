// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/core/relative.h>
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/grid/places_of_pressures.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/backflow_stabilisation.h>
#include <undine/fluid/pressure/divergence.h>
#include <undine/fluid/pressure/pressure_gradient.h>
#include <undine/fluid/pressure/pressure_matrix.h>
#include <undine/fluid/pressure/projection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace undine
{
  namespace
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    // Of the divergence while the speeds of backflow are not known yet, which are found to 1e-4.
    constexpr double tolerance_of_rounds = 1e-6;


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
  } // namespace


  template <int dim>
  Projection<dim>::Projection(const FluidModel<dim> &model_)
    : model(model_)
  {
  }


  template <int dim>
  PressureBalance<dim>
  Projection<dim>::Report::balance(const FluidModel<dim> &model, const FluidState<dim> &state) const
  {
    return pressure_balance(model, state.velocity, state.pressure, openings);
  }


  template <int dim>
  void
  Projection<dim>::prepare(const std::shared_ptr<const FluidTopology<dim>> &topology)
  {
    if (numbers && numbers->topology() == topology)
      return;
    numbers.reset(); // until all is there
    auto new_numbers = std::make_unique<const PressureNumbers<dim>>(model.grid(), topology);
    closed_regions   = std::make_unique<const ClosedRegions<dim>>(model, *new_numbers);
    multigrid.reset();
    matrix.reset();
    smallest_area = smallest_flux_area(model.grid());
    if (new_numbers->owned().size() == 0)
      {
        numbers = std::move(new_numbers);
        return; // obstacles fill the domain
      }
    matrix = std::make_unique<dealii::TrilinosWrappers::SparseMatrix>();
    build_pressure_matrix(*matrix, model, *new_numbers, closed_regions->pinned());
    multigrid = Registry<CellPreconditioner>::instance().make(model.pressure_solver().multigrid);
    multigrid->initialize(*matrix, *matrix, places_of_pressures(model.grid(), *new_numbers));
    numbers = std::move(new_numbers);
  }


  template <int dim>
  unsigned int
  Projection<dim>::solve(Vector               &impulse,
                         const Vector         &right_side,
                         const BackflowMatrix &stabilised,
                         const double          tolerance) const
  {
    dealii::SolverControl    control(model.pressure_solver().maximum_iterations, tolerance);
    dealii::SolverCG<Vector> solver(control);
    try
      {
        solver.solve(stabilised, impulse, right_side, *multigrid);
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
    if (!closed_regions->exist())
      balance_openings(impulse, right_side, stabilised);
    return control.last_step();
  }


  /// What flows through all openings together is the sum of the equations, and that of a small
  /// residual of very many need not be small. A shift of all pressures, which only equations beside
  /// openings notice, takes it away: the matrix is symmetric, so that its rows' sums tell by how
  /// much.
  template <int dim>
  void
  Projection<dim>::balance_openings(Vector               &impulse,
                                    const Vector         &right_side,
                                    const BackflowMatrix &stabilised) const
  {
    Vector row_sums(right_side), ones(right_side);
    ones = 1;
    stabilised.vmult(row_sums, ones);
    const double missing = right_side * ones - row_sums * impulse;
    impulse.add(missing / (row_sums * ones));
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::remove_divergence(Velocity<dim>              &velocity,
                                     Field<dim>                 &impulse,
                                     std::vector<OpenFace<dim>> &openings,
                                     const std::vector<double>  &body_fluxes,
                                     const double                tolerance)
  {
    Field<dim> swept(model.grid().cells(), velocity[0].topology());
    std::copy(body_fluxes.begin(), body_fluxes.end(), swept.parts().begin());
    const double         body_speed  = swept.topology() ? largest_divergence(model, swept) : 0.;
    double               first_speed = largest_components(model, velocity).norm() + body_speed;
    Field<dim>           increment   = impulse;
    Report               report;
    const BackflowMatrix stabilised(*matrix, model, *numbers, openings);

    for (unsigned int round = 0; round < 8; ++round)
      {
        increment.exchange(1);
        const auto change = pressure_acceleration(model, increment, openings);
        if (round == 0) // a pressure that is given may move what is at rest, and be balanced
          first_speed += largest_components(model, change).norm();
        add(velocity, 1., change);
        for (auto &open : openings)
          open.pressure = 0;
        exchange(velocity);

        auto fluxes = divergence(model, velocity);
        if (swept.topology())
          add(fluxes, 1., swept);
        const double divergence = largest_divergence(model, fluxes);
        const double speed      = largest_components(model, velocity).norm() + body_speed;
        // Below 1e-4 of the speeds that cancelled there is nothing but rounding.
        const double size    = std::max(speed, 1e-4 * first_speed);
        report.divergence    = relative(divergence, size);
        const double allowed = tolerance * size;
        if (divergence <= allowed)
          return report;

        Vector right_side(numbers->owned(), model.grid().communicator()), correction(right_side);
        copy_to_vector(right_side, fluxes);
        right_side *= -1;
        closed_regions->balance(right_side);
        // In the mean over cells a quarter of what is allowed, then less: some have more.
        const double in_the_mean = std::sqrt(double(right_side.size())) * smallest_area * allowed;
        report.iterations +=
          solve(correction, right_side, stabilised, in_the_mean * std::pow(0.25, round + 1));
        copy_from_vector(increment, correction);
        add(impulse, 1., increment);
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
  Projection<dim>::remove_divergence_with_openings(Velocity<dim>             &velocity,
                                                   Field<dim>                &impulse,
                                                   std::vector<OpenFace<dim>> openings,
                                                   const double               dt,
                                                   const std::vector<double> &body_fluxes)
  {
    const bool enters = dealii::Utilities::MPI::logical_or(
      std::any_of(
        openings.begin(), openings.end(), [](const auto &opening) { return opening.entering > 0; }),
      model.grid().communicator());
    const double full   = model.pressure_solver().divergence_tolerance;
    const double rough  = enters ? std::max(full, tolerance_of_rounds) : full;
    auto         before = velocity;
    auto         better = openings; // with the speeds that follow from the last solution
    Report       report;
    const auto   solve_with_openings = [&](const double tolerance) {
      velocity = before;
      stabilise_backflow(velocity, openings, model, dt);
      auto impulses = openings;
      for (auto &open : impulses)
        open.pressure *= dt;
      const unsigned int iterations = report.iterations;
      report = remove_divergence(velocity, impulse, impulses, body_fluxes, tolerance);
      report.iterations += iterations;
      better              = openings;
      const double change = update_entering_speeds(better, velocity, model, dt);
      return relative(change, largest_components(model, velocity).norm());
    };
    find_entering_speeds([&](const unsigned int) {
      openings = better;
      return solve_with_openings(rough);
    });
    if (rough > full)
      solve_with_openings(full);
    report.before   = std::move(before);
    report.openings = std::move(better);
    return report;
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::project(FluidState<dim> &state, const double time, const double dt)
  {
    return project(state, state.velocity, time, dt);
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::project(FluidState<dim>       &state,
                           const Velocity<dim>   &advecting,
                           const double           time,
                           const double           dt,
                           const SweptVolumeFlux &swept)
  {
    const auto &topology = state.pressure.topology();
    prepare(topology);
    set_boundary_velocity(state.velocity, model.boundaries(), time);
    const auto body_fluxes = closed_regions->balanced_fluxes(state.velocity, swept, time);
    Field<dim> impulse(model.grid().cells(), topology);
    add(impulse, dt, state.pressure);
    const auto report = remove_divergence_with_openings(
      state.velocity, impulse, open_faces(model, advecting, topology.get(), time), dt, body_fluxes);
    state.pressure = Field<dim>(model.grid().cells(), topology);
    add(state.pressure, 1 / dt, impulse);
    closed_regions->remove_means(state.pressure);
    set_means(state.pressure, model.grid());
    return report;
  }


  template <int dim>
  void
  Projection<dim>::keep_levels(Field<dim> &pressure, const Field<dim> &before) const
  {
    closed_regions->keep_means(pressure, before);
    set_means(pressure, model.grid());
  }


  template <int dim>
  typename Projection<dim>::Report
  Projection<dim>::make_divergence_free(FluidState<dim>       &state,
                                        const double           time,
                                        const SweptVolumeFlux &swept)
  {
    const auto topology = state.velocity[0].topology();
    prepare(topology);
    set_boundary_velocity(state.velocity, model.boundaries(), time);
    const auto body_fluxes = closed_regions->balanced_fluxes(state.velocity, swept, time);
    auto       openings    = open_faces(model, state.velocity, topology.get(), time);
    for (auto &open : openings)
      open.pressure = 0;
    Field<dim> impulse(model.grid().cells(), topology);
    const auto report = remove_divergence(
      state.velocity, impulse, openings, body_fluxes, model.pressure_solver().divergence_tolerance);
    state.pressure = Field<dim>(model.grid().cells(), topology);
    return report;
  }


  template <int dim>
  unsigned int
  Projection<dim>::fit_to_growth(Velocity<dim>    &velocity,
                                 const Field<dim> &growth,
                                 const double      time)
  {
    const auto topology = velocity[0].topology();
    prepare(topology);
    set_boundary_velocity(velocity, model.boundaries(), time);
    exchange(velocity);
    auto fluxes = divergence(model, velocity);
    add(fluxes, 1., growth);
    Vector right_side(numbers->owned(), model.grid().communicator()), solution(right_side);
    copy_to_vector(right_side, fluxes);
    right_side *= -1;
    closed_regions->balance(right_side);
    auto openings = open_faces(model, velocity, topology.get(), time);
    for (auto &open : openings)
      open.pressure = 0;
    const double tolerance =
      std::sqrt(model.pressure_solver().divergence_tolerance) * right_side.l2_norm();
    const unsigned int iterations =
      solve(solution, right_side, BackflowMatrix(*matrix, model, *numbers, openings), tolerance);
    Field<dim> impulse(model.grid().cells(), topology);
    copy_from_vector(impulse, solution);
    impulse.exchange(1);
    add(velocity, 1., pressure_acceleration(model, impulse, openings));
    return iterations;
  }


  template class Projection<2>;
  template class Projection<3>;
} // namespace undine
