// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/pressure/pressure_balance.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace undine
{
  template <int dim>
  PressureBalance<dim>
  pressure_balance(const FluidModel<dim>            &model,
                   const Velocity<dim>              &velocity,
                   const Field<dim>                 &pressure,
                   const std::vector<OpenFace<dim>> &openings)
  {
    const auto          &grid = model.grid();
    const auto          *open = pressure.topology().get();
    PressureBalance<dim> result;
    for_each_side_face(model.grid(), open, [&](const SideFace<dim> &face, const auto &) {
      if (model.boundaries().at(face.side, face.face).is_open())
        return;
      const double area  = signed_area(grid, open, face);
      const double force = value_at(pressure, place_inside(open, face)) * area;
      const double speed = value_on(velocity, face);
      result.sides[face.side.axis] += force;
      result.power_of_sides -= force * speed;
      result.inflow_of_sides -= area * speed;
    });
    double area = 0, force_on_area = 0;
    for (const auto &opening : openings)
      {
        const double signed_by_side = signed_area(grid, open, opening);
        const double force          = opening.pressure * signed_by_side;
        area += std::abs(signed_by_side);
        force_on_area += opening.pressure * std::abs(signed_by_side);
        result.openings[opening.side.axis] += force;
        result.power_of_openings -= force * value_on(velocity, opening);
        result.inflow_of_openings -= signed_by_side * value_on(velocity, opening);
      }
    const auto communicator = grid.communicator();
    result.sides            = dealii::Utilities::MPI::sum(result.sides, communicator);
    result.openings         = dealii::Utilities::MPI::sum(result.openings, communicator);
    for (double *sum : {&result.power_of_sides,
                        &result.power_of_openings,
                        &result.inflow_of_sides,
                        &result.inflow_of_openings,
                        &area})
      *sum = dealii::Utilities::MPI::sum(*sum, communicator);
    if (area > 0)
      result.mean_at_openings = dealii::Utilities::MPI::sum(force_on_area, communicator) / area;
    return result;
  }


#define INSTANTIATE(dim)                                                  \
  template PressureBalance<dim> pressure_balance(const FluidModel<dim> &, \
                                                 const Velocity<dim> &,   \
                                                 const Field<dim> &,      \
                                                 const std::vector<OpenFace<dim>> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
