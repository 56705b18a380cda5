// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// (rho V)^-1 a times the difference of pressures, where V = a times their distance, on all
    /// faces between two cells; those of divided faces mean nothing.
    template <int dim>
    void
    add_differences(Field<dim>            &acceleration,
                    const Field<dim>      &pressure,
                    const FluidModel<dim> &model)
    {
      const auto        &grid = model.grid();
      const unsigned int axis = acceleration.lattice().normal_axis();
      auto               box  = acceleration.owned();
      if (!grid.periodic(axis))
        {
          box.lower[axis] = std::max(box.lower[axis], 1);
          box.upper[axis] = std::min(box.upper[axis], grid.cells_along()[axis]);
        }
      std::vector<double> masses; // per area
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
        masses.push_back(model.density() * grid.dual_width(0, i));
      for_each_row(box, [&](const GridIndex<dim> &first, const int n) {
        if (axis > 0)
          std::fill(
            masses.begin(), masses.end(), model.density() * grid.dual_width(axis, first[axis]));
        const double *above  = pressure.data(first);
        const double *below  = above - pressure.stride(axis);
        double       *result = acceleration.data(first);
        for (int i = 0; i < n; ++i)
          result[i] = (below[i] - above[i]) / masses[i];
      });
    }
  } // namespace


  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim>    &model,
             const Velocity<dim>      &velocity,
             const FluidTopology<dim> *topology,
             const double              time)
  {
    std::vector<OpenFace<dim>> result;
    for_each_side_face(model.grid(), topology, [&](const SideFace<dim> &at, const auto &place) {
      const auto &boundary = model.boundaries().at(at.side, at.face);
      if (!boundary.is_open())
        return;
      const double entering = std::max(0., -at.side.sign() * velocity[at.side.axis](at.face));
      const double outside  = boundary.pressure.value(place, time);
      const double pressure = boundary.kind == BoundaryKind::outflow
                                ? outside - model.density() / 2 * entering * entering
                                : outside;
      result.push_back({at, outside, pressure, boundary.kind, entering});
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
    const auto   &open = pressure.topology();
    Velocity<dim> acceleration;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &component     = acceleration[axis];
        component           = Field<dim>(grid.faces(axis), open);
        const auto *divided = component.divided();
        add_differences(component, pressure, model);
        for (std::size_t k = 0; k < component.parts().size(); ++k)
          if (const auto &part = divided->all()[k];
              divided->owns(k) && !grid.at_boundary(axis, part.index))
            {
              const auto  &piece = open->pieces[axis][k];
              const double drop  = value_at(pressure, end_of_piece(*open, axis, k, 0)) -
                                  value_at(pressure, end_of_piece(*open, axis, k, 1));
              component.parts()[k] = drop * part.measure / (model.density() * piece.volume);
            }
      }
    for (const auto &opening : openings)
      {
        const unsigned int axis      = opening.side.axis;
        auto              &component = acceleration[axis];
        const double       sign      = opening.side.sign();
        if (opening.piece < 0)
          component(opening.face) = opening.mobility * sign *
                                    (pressure(opening.cell) - opening.pressure) /
                                    (model.density() * grid.dual_width(axis, opening.face[axis]));
        else
          {
            const auto  &piece = open->pieces[axis][opening.piece];
            const double drop =
              value_at(pressure, place_inside(open.get(), opening)) - opening.pressure;
            component.parts()[opening.piece] = opening.mobility * sign * drop *
                                               component.divided()->all()[opening.piece].measure /
                                               (model.density() * piece.volume);
          }
      }
    set_means(acceleration, grid);
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


#define INSTANTIATE(dim)                                                                       \
  template std::vector<OpenFace<dim>> open_faces(                                              \
    const FluidModel<dim> &, const Velocity<dim> &, const FluidTopology<dim> *, const double); \
  template Velocity<dim> pressure_acceleration(                                                \
    const FluidModel<dim> &, const Field<dim> &, const std::vector<OpenFace<dim>> &);          \
  template double pressure_coupling(                                                           \
    const FluidModel<dim> &, const unsigned int, const GridIndex<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
