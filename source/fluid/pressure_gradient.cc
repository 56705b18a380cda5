// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/pressure_gradient.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    template <int dim>
    using Kind = typename LatticeParts<dim>::Kind;
  } // namespace


  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim> &model,
             const Velocity<dim>   &velocity,
             const OpenParts<dim>  *open_parts,
             const double           time)
  {
    std::vector<OpenFace<dim>> result;
    for_each_side_face(model, open_parts, [&](const SideFace<dim> &at, const auto &place) {
      const auto &boundary = model.boundaries().at(at.side, at.face);
      if (!boundary.is_open())
        return;
      const double entering = std::max(0., -at.side.sign() * velocity[at.side.axis](at.face));
      const double pressure = boundary.kind == BoundaryKind::outflow
                                ? -model.density() / 2 * entering * entering
                                : boundary.pressure.value(place, time);
      result.push_back({at, pressure, boundary.kind, entering});
    });
    return result;
  }


  template <int dim>
  double
  signed_area(const MacGrid<dim> &grid, const OpenParts<dim> *open_parts, const SideFace<dim> &face)
  {
    const unsigned int axis = face.side.axis;
    return face.side.sign() * (face.piece < 0 ? grid.face_area(axis, face.face)
                                              : open_parts->faces[axis].all()[face.piece].measure);
  }


  template <int dim>
  double
  value_on(const Velocity<dim> &velocity, const SideFace<dim> &face)
  {
    const auto &component = velocity[face.side.axis];
    return face.piece < 0 ? component(face.face) : component.parts()[face.piece];
  }


  template <int dim>
  double
  outward_flux(const MacGrid<dim> &grid, const Velocity<dim> &velocity, const SideFace<dim> &face)
  {
    return signed_area(grid, velocity.open_parts(), face) * value_on(velocity, face);
  }


  template <int dim>
  PressurePlace<dim>
  place_inside(const OpenParts<dim> *open_parts, const SideFace<dim> &face)
  {
    if (face.piece < 0)
      return {face.cell, -1};
    return end_of_piece(*open_parts, face.side.axis, face.piece, 1 - face.side.end);
  }


  template <int dim>
  Field<dim>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto &grid = model.grid();
    Field<dim>  result(grid.cells(), velocity[0].open_parts());
    for_each(result.owned(), [&](const GridIndex<dim> &cell) {
      for (unsigned int axis = 0; axis < dim; ++axis)
        result(cell) += grid.face_area(axis, cell) *
                        (velocity[axis](moved<dim>(cell, axis, 1)) - velocity[axis](cell));
    });
    if (const auto *open = velocity.open_parts())
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (std::size_t k = 0; k < open->pieces[axis].size(); ++k)
          for (const unsigned int end : {0, 1})
            if (const int component = open->pieces[axis][k].components[end]; component >= 0)
              result.parts()[component] += (end == 0 ? 1 : -1) *
                                           open->faces[axis].all()[k].measure *
                                           velocity[axis].parts()[k];
    return result;
  }


  template <int dim>
  Velocity<dim>
  pressure_acceleration(const FluidModel<dim>            &model,
                        const Field<dim>                 &pressure,
                        const std::vector<OpenFace<dim>> &openings)
  {
    const auto   &grid = model.grid();
    const auto   &open = pressure.open_parts();
    Velocity<dim> acceleration;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &component     = acceleration[axis];
        component           = Field<dim>(grid.faces(axis), open);
        const auto *divided = component.divided();
        for_each(component.owned(), [&](const GridIndex<dim> &face) {
          // (rho V)^-1 a, where V = a times the distance of the pressures.
          if (!grid.at_boundary(axis, face) &&
              (!divided || divided->kind(face) == Kind<dim>::whole))
            component(face) = (pressure(moved<dim>(face, axis, -1)) - pressure(face)) /
                              (model.density() * grid.dual_width(axis, face[axis]));
        });
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


  template <int dim>
  void
  set_means(Field<dim> &field, const MacGrid<dim> &grid)
  {
    const auto *divided = field.divided();
    if (divided == nullptr)
      return;
    const unsigned int axis = field.lattice().normal_axis();
    for_each(field.owned(), [&](const GridIndex<dim> &index) {
      if (divided->kind(index) == Kind<dim>::whole)
        return;
      double moment = 0, measure = 0;
      for_each_part(*divided, index, [&](const int part) {
        moment += divided->all()[part].measure * field.parts()[part];
        measure += divided->all()[part].measure;
      });
      if (axis < dim)
        measure = grid.face_area(axis, index);
      field(index) = measure > 0 ? moment / measure : 0.;
    });
  }


  template <int dim>
  void
  set_means(Velocity<dim> &velocity, const MacGrid<dim> &grid)
  {
    for (auto &component : velocity.components)
      set_means(component, grid);
  }


  template <int dim>
  void
  set_volumes(Field<dim> &volumes, const MacGrid<dim> &grid)
  {
    const auto *divided = volumes.divided();
    for_each(volumes.owned(), [&](const GridIndex<dim> &cell) {
      if (!divided || divided->kind(cell) == Kind<dim>::whole)
        volumes(cell) = grid.cell_volume(cell);
    });
    for (std::size_t c = 0; c < volumes.parts().size(); ++c)
      volumes.parts()[c] = divided->all()[c].measure;
  }


  template <int dim>
  void
  add(Field<dim> &field, const double factor, const Field<dim> &change)
  {
    for_each(field.owned(),
             [&](const GridIndex<dim> &index) { field(index) += factor * change(index); });
    for (std::size_t k = 0; k < field.parts().size(); ++k)
      field.parts()[k] += factor * change.parts()[k];
  }


  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      add(velocity[axis], factor, acceleration[axis]);
  }


  template <int dim>
  void
  exchange(Velocity<dim> &velocity)
  {
    for (auto &component : velocity.components)
      component.exchange(1);
  }


#define INSTANTIATE(dim)                                                                   \
  template std::vector<OpenFace<dim>> open_faces(                                          \
    const FluidModel<dim> &, const Velocity<dim> &, const OpenParts<dim> *, const double); \
  template double signed_area(                                                             \
    const MacGrid<dim> &, const OpenParts<dim> *, const SideFace<dim> &);                  \
  template double value_on(const Velocity<dim> &, const SideFace<dim> &);                  \
  template double outward_flux(                                                            \
    const MacGrid<dim> &, const Velocity<dim> &, const SideFace<dim> &);                   \
  template PressurePlace<dim> place_inside(const OpenParts<dim> *, const SideFace<dim> &); \
  template Field<dim>         divergence(const FluidModel<dim> &, const Velocity<dim> &);  \
  template Velocity<dim>      pressure_acceleration(                                       \
         const FluidModel<dim> &, const Field<dim> &, const std::vector<OpenFace<dim>> &); \
  template double pressure_coupling(                                                       \
    const FluidModel<dim> &, const unsigned int, const GridIndex<dim> &);                  \
  template void set_means(Velocity<dim> &, const MacGrid<dim> &);                          \
  template void set_means(Field<dim> &, const MacGrid<dim> &);                             \
  template void set_volumes(Field<dim> &, const MacGrid<dim> &);                           \
  template void add(Field<dim> &, const double, const Field<dim> &);                       \
  template void add(Velocity<dim> &, const double, const Velocity<dim> &);                 \
  template void exchange(Velocity<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
