// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/pressure_gradient.h>

#include <cmath>

namespace undine
{
  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim> &model, const Velocity<dim> &velocity, const double time)
  {
    std::vector<OpenFace<dim>> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int end = 0; end < 2 && !model.grid().periodic(axis); ++end)
        {
          const Side side{axis, end};
          const int  plane  = end == 0 ? 0 : model.grid().cells_along()[axis];
          auto       layer  = velocity[axis].owned();
          layer.lower[axis] = std::max(layer.lower[axis], plane);
          layer.upper[axis] = std::min(layer.upper[axis], plane + 1);
          for_each(layer, [&](const GridIndex<dim> &face) {
            const auto &boundary = model.boundaries().at(side, face);
            if (!boundary.is_open())
              return;
            const double outward  = side.sign() * velocity[axis](face);
            const double entering = std::min(outward, 0.);
            const double pressure =
              boundary.kind == BoundaryKind::outflow
                ? -model.density() / 2 * entering * entering
                : boundary.pressure.value(velocity[axis].lattice().point(face), time);
            const auto cell = end == 0 ? face : moved<dim>(face, axis, -1);
            result.push_back({side, face, cell, pressure});
          });
        }
    return result;
  }


  template <int dim>
  std::vector<double>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto         &grid = model.grid();
    std::vector<double> result;
    result.reserve(grid.cells()->owned().size());
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      double outflow = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        outflow += grid.face_area(axis, cell) *
                   (velocity[axis](moved<dim>(cell, axis, 1)) - velocity[axis](cell));
      result.push_back(outflow);
    });
    return result;
  }


  template <int dim>
  Velocity<dim>
  pressure_acceleration(const FluidModel<dim>            &model,
                        const Field<dim>                 &pressure,
                        const std::vector<OpenFace<dim>> &openings)
  {
    const auto   &grid = model.grid();
    Velocity<dim> acceleration;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        acceleration[axis] = Field<dim>(grid.faces(axis));
        for_each(acceleration[axis].owned(), [&](const GridIndex<dim> &face) {
          // (rho V)^-1 a, where V = a times the distance of the pressures.
          if (!grid.at_boundary(axis, face))
            acceleration[axis](face) = (pressure(moved<dim>(face, axis, -1)) - pressure(face)) /
                                       (model.density() * grid.dual_width(axis, face[axis]));
        });
      }
    for (const auto &open : openings)
      {
        const unsigned int axis       = open.side.axis;
        acceleration[axis](open.face) = open.side.sign() * (pressure(open.cell) - open.pressure) /
                                        (model.density() * grid.dual_width(axis, open.face[axis]));
      }
    return acceleration;
  }


  template <int dim>
  double
  pressure_coupling(const FluidModel<dim> &model,
                    const unsigned int     axis,
                    const GridIndex<dim>  &face)
  {
    const double area = model.grid().face_area(axis, face);
    return area * area / (model.density() * model.grid().dual_volume(axis, face));
  }


  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(velocity[axis].owned(), [&](const GridIndex<dim> &face) {
        velocity[axis](face) += factor * acceleration[axis](face);
      });
  }


  template <int dim>
  void
  exchange(Velocity<dim> &velocity)
  {
    for (auto &component : velocity.components)
      component.exchange(1);
  }


#define INSTANTIATE(dim)                                                                    \
  template std::vector<OpenFace<dim>> open_faces(                                           \
    const FluidModel<dim> &, const Velocity<dim> &, const double);                          \
  template std::vector<double> divergence(const FluidModel<dim> &, const Velocity<dim> &);  \
  template Velocity<dim>       pressure_acceleration(                                       \
          const FluidModel<dim> &, const Field<dim> &, const std::vector<OpenFace<dim>> &); \
  template double pressure_coupling(                                                        \
    const FluidModel<dim> &, const unsigned int, const GridIndex<dim> &);                   \
  template void add(Velocity<dim> &, const double, const Velocity<dim> &);                  \
  template void exchange(Velocity<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
