// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/field_algebra.h>

namespace undine
{
  template <int dim>
  VelocityCondition<dim>::VelocityCondition(const unsigned int axis_)
    : axis(axis_)
  {
  }


  template <int dim>
  bool
  VelocityCondition<dim>::is_dirichlet(const Boundary<dim> &boundary) const
  {
    return boundary.prescribes_tangential_velocity();
  }


  template <int dim>
  double
  VelocityCondition<dim>::dirichlet_value(const Boundary<dim>      &boundary,
                                          const unsigned int        normal_axis,
                                          const dealii::Point<dim> &place,
                                          const double              time) const
  {
    return boundary.velocity_along(axis, normal_axis, place, time);
  }


  template <int dim>
  double
  VelocityCondition<dim>::entering_value(const dealii::Point<dim> &, const double) const
  {
    return 0;
  }


  template <int dim>
  bool
  VelocityCondition<dim>::obeys_maximum_principle() const
  {
    return false;
  }


  template <int dim>
  bool
  PressureCondition<dim>::is_dirichlet(const Boundary<dim> &boundary) const
  {
    return boundary.is_open();
  }


  template <int dim>
  double
  PressureCondition<dim>::dirichlet_value(const Boundary<dim> &boundary,
                                          const unsigned int,
                                          const dealii::Point<dim> &place,
                                          const double              time) const
  {
    return boundary.is_open() ? boundary.pressure.value(place, time) : 0;
  }


  template <int dim>
  double
  PressureCondition<dim>::entering_value(const dealii::Point<dim> &, const double) const
  {
    return 0;
  }


  template <int dim>
  bool
  PressureCondition<dim>::obeys_maximum_principle() const
  {
    return true;
  }


  namespace
  {
    /// What the two last points before a boundary point lead to there; the value of the last one
    /// where they are parts, or there is no other.
    template <int dim>
    double
    extrapolated(const Field<dim> &field, const Side side, const GridIndex<dim> &near)
    {
      const auto &row  = field.lattice().row(side.axis);
      const auto  next = moved<dim>(near, side.axis, -side.sign());
      if (row.size() < 2 || !is_whole(field.divided(), near) || !is_whole(field.divided(), next))
        return field(near);
      const int    n      = near[side.axis];
      const double beyond = (row.position(n + side.sign()) - row.position(n)) /
                            (row.position(n) - row.position(n - side.sign()));
      return field(near) + beyond * (field(near) - field(next));
    }


    /// The value of one boundary point: shares that are prescribed or that enter, plus the rest of
    /// what is inside.
    template <int dim>
    double
    boundary_value(const Field<dim>             &field,
                   const BoundaryMap<dim>       &boundaries,
                   const BoundaryCondition<dim> &condition,
                   const Velocity<dim>          &velocity,
                   const Side                    side,
                   const GridIndex<dim>         &index,
                   const double                  time,
                   const Entering<dim>          &entering,
                   const Extension               extension)
    {
      const int      n    = field.lattice().row(side.axis).size();
      GridIndex<dim> near = index;
      near[side.axis]     = side.end == 0 ? 0 : n - 1;

      const auto enters = [&](GridIndex<dim> face) {
        if (side.end == 1)
          ++face[side.axis];
        const auto &stored = velocity[side.axis].stored();
        for (unsigned int d = 0; d < dim; ++d)
          face[d] = std::clamp(face[d], stored.lower[d], stored.upper[d] - 1);
        return side.sign() * velocity[side.axis](face) < 0;
      };
      const auto   place   = field.lattice().point(index);
      const double gone_on = entering.rate ? entering.duration * (*entering.rate)(near) : 0.;
      double       value   = 0;
      for_each_boundary_around(
        boundaries,
        field.lattice(),
        side,
        index,
        [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &cell) {
          if (condition.is_dirichlet(boundary) && !boundary.lets_fluid_pass())
            value += fraction * condition.dirichlet_value(boundary, side.axis, place, time);
          else if (condition.is_dirichlet(boundary))
            value +=
              fraction *
              (condition.dirichlet_value(boundary, side.axis, place, entering.time) + gone_on);
          else if (boundary.is_open() && enters(cell))
            value += fraction * (condition.entering_value(place, entering.time) + gone_on);
          else
            value += fraction * (extension == Extension::linear ? extrapolated(field, side, near)
                                                                : field(near));
        });
      return value;
    }
  } // namespace


  template <int dim>
  void
  fill_boundary_points(Field<dim>                   &field,
                       const BoundaryMap<dim>       &boundaries,
                       const BoundaryCondition<dim> &condition,
                       const Velocity<dim>          &velocity,
                       const double                  time,
                       const Entering<dim>          &entering,
                       const Extension               extension)
  {
    // Direction by direction: points beyond two sides take over what was filled before.
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (field.lattice().row(axis).has_boundary_points())
        for (unsigned int end = 0; end < 2; ++end)
          {
            const Side side{axis, end};
            auto       layer  = field.stored();
            const int  index  = end == 0 ? -1 : field.lattice().row(axis).size();
            layer.lower[axis] = std::max(layer.lower[axis], index);
            layer.upper[axis] = std::min(layer.upper[axis], index + 1);
            for_each(layer, [&](const GridIndex<dim> &point) {
              field(point) = boundary_value(
                field, boundaries, condition, velocity, side, point, time, entering, extension);
            });
          }
  }


  template <int dim>
  void
  set_boundary_velocity(Velocity<dim>          &velocity,
                        const BoundaryMap<dim> &boundaries,
                        const double            time)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int end = 0; end < 2 && !boundaries.grid().periodic(axis); ++end)
        {
          auto       &component = velocity[axis];
          const auto *divided   = component.divided();
          const Side  side{axis, end};
          auto        layer = component.owned();
          const int   plane = end == 0 ? 0 : boundaries.grid().cells_along()[axis];
          layer.lower[axis] = std::max(layer.lower[axis], plane);
          layer.upper[axis] = std::min(layer.upper[axis], plane + 1);
          for_each(layer, [&](const GridIndex<dim> &face) {
            const auto &boundary = boundaries.at(side, face);
            if (!boundary.prescribes_normal_velocity())
              return;
            component(face) =
              boundary.velocity_along(axis, axis, component.lattice().point(face), time);
            for (int k = divided ? divided->first(face) : 0; divided && k < divided->last(face);
                 ++k)
              component.parts()[k] =
                boundary.velocity_along(axis, axis, divided->all()[k].place, time);
          });
        }
    set_means(velocity, boundaries.grid());
  }


  template class PressureCondition<2>;
  template class PressureCondition<3>;
  template class VelocityCondition<2>;
  template class VelocityCondition<3>;
  template void
  fill_boundary_points(Field<2> &,
                       const BoundaryMap<2> &,
                       const BoundaryCondition<2> &,
                       const Velocity<2> &,
                       const double,
                       const Entering<2> &,
                       const Extension);
  template void
  fill_boundary_points(Field<3> &,
                       const BoundaryMap<3> &,
                       const BoundaryCondition<3> &,
                       const Velocity<3> &,
                       const double,
                       const Entering<3> &,
                       const Extension);
  template void
  set_boundary_velocity(Velocity<2> &, const BoundaryMap<2> &, const double);
  template void
  set_boundary_velocity(Velocity<3> &, const BoundaryMap<3> &, const double);
} // namespace undine
