// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/relative.h>
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/grid/places_of_pressures.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/divergence.h>
#include <undine/fluid/pressure/pressure_equations.h>
#include <undine/fluid/pressure/pressure_gradient.h>
#include <undine/fluid/pressure/pressure_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  PressureEquations<dim>::PressureEquations(const FluidModel<dim>      &model,
                                            const PressureNumbers<dim> &numbers,
                                            const std::vector<Number>  &compliant,
                                            const double                dt)
    : model(model)
    , dt(dt)
    , all_numbers(numbers)
    , cells(places_of_pressures(model.grid(), numbers))
    , regions(model, all_numbers, compliant)
    , flux(all_numbers.owned(), model.grid().communicator())
  {
    build_pressure_matrix(L, model, all_numbers, regions.pinned());
    hL.reinit(L);
  }


  template <int dim>
  void
  PressureEquations<dim>::start(Velocity<dim>         &velocity,
                                const Velocity<dim>   &advecting,
                                const double           time,
                                const SweptVolumeFlux &swept)
  {
    set_boundary_velocity(velocity, model.boundaries(), time);
    regions.balanced_fluxes(velocity, swept, time);
    openings = undine::open_faces(model, advecting, all_numbers.topology().get(), time);
    opens    = dealii::Utilities::MPI::logical_or(!openings.empty(), model.grid().communicator());
  }


  template <int dim>
  void
  PressureEquations<dim>::open(Velocity<dim> &velocity)
  {
    stabilise_backflow(velocity, openings, model, dt);
    const BackflowMatrix stabilised(L, model, all_numbers, openings);
    hL.copy_from(L);
    for (const auto &[row, value] : stabilised.subtracted())
      {
        const auto number = all_numbers.owned().nth_index_in_set(row);
        hL.add(number, number, -value);
      }
    hL.compress(dealii::VectorOperation::add);
    hL *= dt;

    Field<dim> no_pressure(model.grid().cells(), all_numbers.topology());
    no_pressure.exchange(1);
    add(velocity, dt, pressure_acceleration(model, no_pressure, openings));
    closed_openings = openings;
    for (auto &opening : closed_openings)
      opening.pressure = 0;
    exchange(velocity);
    copy_to_vector(flux, undine::divergence(model, velocity));
  }


  template <int dim>
  double
  PressureEquations<dim>::update_backflow(const Velocity<dim> &velocity)
  {
    const double change = update_entering_speeds(openings, velocity, model, dt);
    const double speed  = largest_components(model, velocity).norm();
    return relative(change, speed);
  }


  template <int dim>
  typename PressureEquations<dim>::Vector
  PressureEquations<dim>::from_components(const std::vector<double> &values) const
  {
    Field<dim> of_cells(model.grid().cells(), all_numbers.topology());
    std::copy(values.begin(), values.end(), of_cells.parts().begin());
    Vector result(flux);
    copy_to_vector(result, of_cells);
    return result;
  }


  template <int dim>
  Field<dim>
  PressureEquations<dim>::field(const Vector &pressure) const
  {
    Field<dim> result(model.grid().cells(), all_numbers.topology());
    copy_from_vector(result, pressure);
    return result;
  }


  template <int dim>
  void
  PressureEquations<dim>::accelerate(Velocity<dim> &velocity, const Vector &pressure) const
  {
    auto pressures = field(pressure);
    pressures.exchange(1);
    add(velocity, dt, pressure_acceleration(model, pressures, closed_openings));
    exchange(velocity);
  }


  template <int dim>
  double
  PressureEquations<dim>::divergence(const Velocity<dim>       &velocity,
                                     const std::vector<double> &body_fluxes) const
  {
    Field<dim> swept(model.grid().cells(), all_numbers.topology());
    std::copy(body_fluxes.begin(), body_fluxes.end(), swept.parts().begin());
    auto fluxes = undine::divergence(model, velocity);
    add(fluxes, 1., swept);
    const double largest = largest_divergence(model, fluxes);
    const double speed =
      largest_components(model, velocity).norm() + largest_divergence(model, swept);
    return relative(largest, speed);
  }


  template class PressureEquations<2>;
  template class PressureEquations<3>;
} // namespace undine
