// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/advection/fill_unknown.h>
#include <undine/fluid/grid/field_algebra.h>

#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  } // namespace


  template <int dim>
  Field<dim>
  completed(const CharacteristicTracer<dim> &tracer,
            Field<dim>                       field,
            const BoundaryCondition<dim>    &condition)
  {
    field.exchange(tracer.width());
    fill_boundary_points(
      field, tracer.model().boundaries(), condition, tracer.velocity(), tracer.time());
    return field;
  }


  template <int dim>
  std::vector<Field<dim>>
  completed(const CharacteristicTracer<dim> &tracer,
            std::vector<Field<dim>>          fields,
            const BoundaryCondition<dim>    &condition)
  {
    for (auto &field : fields)
      field = completed(tracer, std::move(field), condition);
    return fields;
  }


  template <int dim>
  NearBodies<dim>::NearBodies(const CharacteristicTracer<dim> &tracer_, const Field<dim> &source)
    : tracer(tracer_)
    , lattice(source.lattice())
    , axis(source.lattice().normal_axis())
  {
    if (tracer.bodies().obstruction != nullptr)
      samples = std::make_unique<const VisibleSamples<dim>>(
        source, tracer.stencils(source), tracer.vicinity());
  }


  template <int dim>
  double
  NearBodies<dim>::value_at(const GridIndex<dim>     &index,
                            const dealii::Point<dim> &place,
                            const Place              &foot) const
  {
    if (const auto seen = samples->along(index, place, foot))
      return *seen;
    return axis < dim ? tracer.bodies().obstruction->nearest_velocity(foot.point)[axis] : unknown;
  }


  template <int dim>
  void
  NearBodies<dim>::finish(Field<dim> &carried, const BoundaryCondition<dim> &condition) const
  {
    if (!carried.topology())
      return;
    if (axis >= dim)
      fill_unknown(carried, tracer.model(), condition, tracer.time() + tracer.dt());
    set_means(carried, tracer.model().grid());
  }


  template <int dim>
  Field<dim>
  remapped(const CharacteristicTracer<dim> &tracer,
           const Field<dim>                &field,
           const BoundaryCondition<dim>    &condition)
  {
    const auto            source = completed(tracer, field, condition);
    const NearBodies<dim> near(tracer, source);
    Field<dim>            kept(source.shared_lattice(), tracer.bodies().topology);
    const auto           *divided = kept.divided();
    for_each_value(kept, [&](double &value, const auto &place, const GridIndex<dim> &index) {
      const bool is_part =
        divided != nullptr && divided->kind(index) != SubLattice<dim>::Kind::whole;
      const auto here = tracer.vicinity().place(place);
      value = is_part || tracer.vicinity().is_next_to_body(here) ? near.value_at(index, place, here)
                                                                 : source(index);
    });
    near.finish(kept, condition);
    return kept;
  }


  template class NearBodies<2>;
  template class NearBodies<3>;
  template Field<2>
  remapped(const CharacteristicTracer<2> &, const Field<2> &, const BoundaryCondition<2> &);
  template Field<3>
  remapped(const CharacteristicTracer<3> &, const Field<3> &, const BoundaryCondition<3> &);
  template Field<2>
  completed(const CharacteristicTracer<2> &, Field<2>, const BoundaryCondition<2> &);
  template std::vector<Field<2>>
  completed(const CharacteristicTracer<2> &, std::vector<Field<2>>, const BoundaryCondition<2> &);
  template Field<3>
  completed(const CharacteristicTracer<3> &, Field<3>, const BoundaryCondition<3> &);
  template std::vector<Field<3>>
  completed(const CharacteristicTracer<3> &, std::vector<Field<3>>, const BoundaryCondition<3> &);
} // namespace undine
