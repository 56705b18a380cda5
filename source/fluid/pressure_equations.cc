// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary_condition.h>
#include <undine/fluid/fluid_quantities.h>
#include <undine/fluid/pressure_equations.h>
#include <undine/fluid/pressure_matrix.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  PressureEquations<dim>::PressureEquations(const FluidModel<dim>      &model,
                                            const PressureNumbers<dim> &numbers,
                                            const std::vector<Number>  &yielding,
                                            const double                dt)
    : model(model)
    , dt(dt)
    , all_numbers(numbers)
    , regions(model, all_numbers, yielding)
    , flux(all_numbers.owned(), model.grid().communicator())
  {
    build_pressure_matrix(hL, model, all_numbers, regions.pinned());
    hL *= dt;
  }


  template <int dim>
  void
  PressureEquations<dim>::start(Velocity<dim>             &velocity,
                                const Velocity<dim>       &carrying,
                                const double               time,
                                const std::vector<double> &body_fluxes)
  {
    const auto &open = all_numbers.open_parts();
    set_boundary_velocity(velocity, model, time);
    regions.check_net_flux(velocity, body_fluxes, time);
    openings = open_faces(model, carrying, open.get(), time);
    const Field<dim> no_pressure(model.grid().cells(), open);
    add(velocity, dt, pressure_acceleration(model, no_pressure, openings));
    for (auto &opening : openings)
      opening.pressure = 0;
    exchange(velocity);
    copy_to_vector(flux, undine::divergence(model, velocity));
  }


  template <int dim>
  typename PressureEquations<dim>::Vector
  PressureEquations<dim>::from_components(const std::vector<double> &values) const
  {
    Field<dim> of_cells(model.grid().cells(), all_numbers.open_parts());
    std::copy(values.begin(), values.end(), of_cells.parts().begin());
    Vector result(flux);
    copy_to_vector(result, of_cells);
    return result;
  }


  template <int dim>
  Field<dim>
  PressureEquations<dim>::field(const Vector &pressure) const
  {
    Field<dim> result(model.grid().cells(), all_numbers.open_parts());
    copy_from_vector(result, pressure);
    return result;
  }


  template <int dim>
  void
  PressureEquations<dim>::accelerate(Velocity<dim> &velocity, const Vector &pressure) const
  {
    auto pressures = field(pressure);
    pressures.exchange(1);
    add(velocity, dt, pressure_acceleration(model, pressures, openings));
    exchange(velocity);
  }


  template <int dim>
  double
  PressureEquations<dim>::divergence(const Velocity<dim>       &velocity,
                                     const std::vector<double> &body_fluxes) const
  {
    Field<dim> pushed(model.grid().cells(), all_numbers.open_parts());
    std::copy(body_fluxes.begin(), body_fluxes.end(), pushed.parts().begin());
    auto fluxes = undine::divergence(model, velocity);
    add(fluxes, 1., pushed);
    const double largest = largest_divergence(model, fluxes);
    const double speed =
      largest_components(model, velocity).norm() + largest_divergence(model, pushed);
    return largest == 0 ? 0. : largest / speed;
  }


  template class PressureEquations<2>;
  template class PressureEquations<3>;
} // namespace undine
