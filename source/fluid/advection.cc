// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection.h>
#include <undine/fluid/pressure_gradient.h>
#include <undine/fluid/pressure_numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();


    /// Components from which nothing could be seen take the mean of their known neighbours, the
    /// nearer ones first; then zero. Collective.
    template <int dim>
    void
    fill_unknown(Field<dim> &scalar)
    {
      const auto &open = *scalar.open_parts();
      for (unsigned int round = 0; round < 4; ++round)
        {
          scalar.exchange(1);
          std::vector<double> sums(scalar.parts().size(), 0.), areas(sums);
          for (unsigned int axis = 0; axis < dim; ++axis)
            for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
              for (const unsigned int end : {0, 1})
                {
                  const int component = open.pieces[axis][k].components[end];
                  if (component < 0 || open.pieces[axis][k].components[1 - end] == open.outside)
                    continue;
                  const double other =
                    undine::value_at(scalar, end_of_piece(open, axis, k, 1 - end));
                  if (std::isnan(other))
                    continue;
                  const double area = std::abs(open.faces[axis].all()[k].measure);
                  sums[component] += area * other;
                  areas[component] += area;
                }
          for (std::size_t c = 0; c < sums.size(); ++c)
            if (std::isnan(scalar.parts()[c]) && areas[c] > 0)
              scalar.parts()[c] = sums[c] / areas[c];
        }
      for (double &value : scalar.parts())
        if (std::isnan(value))
          value = 0;
    }
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
  NearBodies<dim>::finish(Field<dim> &carried) const
  {
    if (!carried.open_parts())
      return;
    if (axis >= dim)
      fill_unknown(carried);
    set_means(carried, flow.model().grid());
  }


  template class NearBodies<2>;
  template class NearBodies<3>;
  template Field<2>
  completed(const Flow<2> &, Field<2>, const BoundaryCondition<2> &);
  template Field<3>
  completed(const Flow<3> &, Field<3>, const BoundaryCondition<3> &);
} // namespace undine
