// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection.h>
#include <undine/fluid/fill_unknown.h>
#include <undine/fluid/pressure_gradient.h>

#include <limits>

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
    fill_boundary_points(field, flow.model(), condition, flow.velocity(), flow.time());
    return field;
  }


  template <int dim>
  NearBodies<dim>::NearBodies(const Flow<dim> &flow_, const Field<dim> &source)
    : flow(flow_)
    , axis(source.lattice().normal_axis())
  {
    if (const auto *obstruction = flow.bodies().obstruction)
      samples = std::make_unique<const VisibleSamples<dim>>(
        source, flow.width(), *obstruction, flow.vicinity());
  }


  template <int dim>
  double
  NearBodies<dim>::value_at(const dealii::Point<dim> &foot) const
  {
    if (const auto seen = samples->at(foot))
      return *seen;
    return axis < dim ? flow.bodies().obstruction->nearest_velocity(foot)[axis] : unknown;
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


  template class NearBodies<2>;
  template class NearBodies<3>;
  template Field<2>
  completed(const Flow<2> &, Field<2>, const BoundaryCondition<2> &);
  template Field<3>
  completed(const Flow<3> &, Field<3>, const BoundaryCondition<3> &);
} // namespace undine
