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
  completed(const Flow<dim> &flow, Field<dim> field, const BoundaryCondition<dim> &condition)
  {
    field.exchange(flow.width());
    fill_boundary_points(field, flow.model().boundaries(), condition, flow.velocity(), flow.time());
    return field;
  }


  template <int dim>
  std::vector<Field<dim>>
  completed(const Flow<dim>              &flow,
            std::vector<Field<dim>>       fields,
            const BoundaryCondition<dim> &condition)
  {
    for (auto &field : fields)
      field = completed(flow, std::move(field), condition);
    return fields;
  }


  template <int dim>
  NearBodies<dim>::NearBodies(const Flow<dim> &flow_, const Field<dim> &source)
    : flow(flow_)
    , lattice(source.lattice())
    , axis(source.lattice().normal_axis())
  {
    if (flow.bodies().obstruction != nullptr)
      samples =
        std::make_unique<const VisibleSamples<dim>>(source, flow.views(source), flow.vicinity());
  }


  template <int dim>
  double
  NearBodies<dim>::value_at(const GridIndex<dim>     &index,
                            const dealii::Point<dim> &place,
                            const Place              &foot) const
  {
    if (const auto seen = samples->along(index, place, foot))
      return *seen;
    return axis < dim ? flow.bodies().obstruction->nearest_velocity(foot.point)[axis] : unknown;
  }


  template <int dim>
  void
  NearBodies<dim>::finish(Field<dim> &carried, const BoundaryCondition<dim> &condition) const
  {
    if (!carried.open_parts())
      return;
    if (axis >= dim)
      fill_unknown(carried, flow.model(), condition, flow.time() + flow.dt());
    set_means(carried, flow.model().grid());
  }


  template <int dim>
  Field<dim>
  kept_in_place(const Flow<dim>              &flow,
                const Field<dim>             &field,
                const BoundaryCondition<dim> &condition)
  {
    const auto            source = completed(flow, field, condition);
    const NearBodies<dim> near(flow, source);
    Field<dim>            kept(source.shared_lattice(), flow.bodies().open_parts);
    const auto           *divided = kept.divided();
    for_each_value(kept, [&](double &value, const auto &place, const GridIndex<dim> &index) {
      const bool is_part =
        divided != nullptr && divided->kind(index) != LatticeParts<dim>::Kind::whole;
      const auto here = flow.vicinity().place(place);
      value = is_part || flow.vicinity().is_next_to_body(here) ? near.value_at(index, place, here)
                                                               : source(index);
    });
    near.finish(kept, condition);
    return kept;
  }


  template class NearBodies<2>;
  template class NearBodies<3>;
  template Field<2>
  kept_in_place(const Flow<2> &, const Field<2> &, const BoundaryCondition<2> &);
  template Field<3>
  kept_in_place(const Flow<3> &, const Field<3> &, const BoundaryCondition<3> &);
  template Field<2>
  completed(const Flow<2> &, Field<2>, const BoundaryCondition<2> &);
  template std::vector<Field<2>>
  completed(const Flow<2> &, std::vector<Field<2>>, const BoundaryCondition<2> &);
  template Field<3>
  completed(const Flow<3> &, Field<3>, const BoundaryCondition<3> &);
  template std::vector<Field<3>>
  completed(const Flow<3> &, std::vector<Field<3>>, const BoundaryCondition<3> &);
} // namespace undine
