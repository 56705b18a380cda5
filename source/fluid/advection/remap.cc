// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/remap.h>
#include <undine/fluid/grid/fluid_topology.h>

#include <limits>

namespace undine
{
  namespace
  {
    /// V_f before the last motion of bodies of the sub-face that was nearest to `part` [m^dim].
    template <int dim>
    double
    volume_before(const Field<dim>                     &field,
                  const MacGrid<dim>                   &grid,
                  const typename SubLattice<dim>::Part &part)
    {
      using Kind               = typename SubLattice<dim>::Kind;
      const unsigned int axis  = field.lattice().normal_axis();
      const auto        *faces = field.divided();
      if (!faces || faces->kind(part.index) == Kind::whole)
        return grid.dual_volume(axis, part.index);
      double result = 0, nearest = std::numeric_limits<double>::infinity();
      for_each_part(*faces, part.index, [&](const int k) {
        if (const double distance = faces->all()[k].place.distance(part.place); distance < nearest)
          {
            nearest = distance;
            result  = field.topology()->pieces[axis][k].volume;
          }
      });
      return result;
    }


    /// (F12) on all faces that bodies divide or did divide.
    template <int dim>
    void
    add_uncovered_fluid(Field<dim>                      &velocity,
                        const Field<dim>                &before,
                        const NearBodies<dim>           &near,
                        const CharacteristicTracer<dim> &tracer)
    {
      const auto        &grid = tracer.model().grid();
      const unsigned int axis = velocity.lattice().normal_axis();
      const auto         mix =
        [&](double &value, const double volume, const typename SubLattice<dim>::Part &part) {
          const double then = volume_before(before, grid, part);
          if (!(volume > then))
            return;
          const double added = (volume - then) / volume;
          if (const auto around = near.mean_around(part))
            value += added * (*around - value);
        };
      using Kind       = typename SubLattice<dim>::Kind;
      const auto *now  = velocity.divided();
      const auto *then = before.divided();
      for_each(velocity.owned(), [&](const GridIndex<dim> &index) {
        if (then && then->kind(index) != Kind::whole && (!now || now->kind(index) == Kind::whole))
          mix(velocity(index), grid.dual_volume(axis, index), near.whole(index));
      });
      for_each_owned_part(now, [&](const unsigned int k, const auto &part) {
        mix(velocity.parts()[k], velocity.topology()->pieces[axis][k].volume, part);
      });
    }
  } // namespace


  template <int dim>
  Field<dim>
  remapped(const CharacteristicTracer<dim> &tracer,
           const Field<dim>                &field,
           const BoundaryCondition<dim>    &condition)
  {
    if (!field.topology() && !tracer.bodies().topology)
      return field;
    const auto            source = completed(tracer, field, tracer.time(), condition);
    const NearBodies<dim> near(tracer, source);
    Field<dim>            kept(source.shared_lattice(), tracer.bodies().topology);
    const auto           *divided   = kept.divided();
    const auto            value_now = [&](const typename SubLattice<dim>::Part &part) {
      if (const auto before = near.value_before(part))
        return *before;
      return near.value_at(part, tracer.vicinity().place(part.place));
    };
    for_each(kept.owned(), [&](const GridIndex<dim> &index) {
      if (divided && divided->kind(index) != SubLattice<dim>::Kind::whole)
        return;
      const auto part = near.whole(index);
      kept(index)     = tracer.vicinity().is_next_to_body(tracer.vicinity().place(part.place))
                          ? value_now(part)
                          : source(index);
    });
    for_each_owned_part(
      divided, [&](const unsigned int k, const auto &part) { kept.parts()[k] = value_now(part); });
    if (kept.lattice().normal_axis() < dim && tracer.bodies().obstruction)
      add_uncovered_fluid(kept, source, near, tracer);
    near.finish(kept, condition);
    return kept;
  }


  template Field<2>
  remapped(const CharacteristicTracer<2> &, const Field<2> &, const BoundaryCondition<2> &);
  template Field<3>
  remapped(const CharacteristicTracer<3> &, const Field<3> &, const BoundaryCondition<3> &);
} // namespace undine
