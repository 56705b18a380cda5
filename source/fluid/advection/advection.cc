// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/advection/fill_unknown.h>
#include <undine/fluid/grid/field_algebra.h>

#include <algorithm>
#include <cmath>
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
            const double                     time,
            const BoundaryCondition<dim>    &condition)
  {
    field.exchange(tracer.width());
    fill_boundary_points(field, tracer.model().boundaries(), condition, tracer.velocity(), time);
    return field;
  }


  template <int dim>
  std::vector<Field<dim>>
  completed(const CharacteristicTracer<dim> &tracer,
            std::vector<Field<dim>>          fields,
            const GoingOn<dim>              &going_on,
            const BoundaryCondition<dim>    &condition,
            const Extension                  extension)
  {
    std::optional<Field<dim>> rate;
    if (going_on.rate && tracer.model().boundaries().lets_fluid_pass())
      {
        rate = *going_on.rate;
        rate->exchange(tracer.width());
      }
    for (std::size_t k = 0; k < fields.size(); ++k)
      {
        const double time = going_on.times.empty() ? tracer.time() : going_on.times[k];
        fields[k].exchange(tracer.width());
        fill_boundary_points(fields[k],
                             tracer.model().boundaries(),
                             condition,
                             tracer.velocity(),
                             time,
                             {tracer.time(), rate ? &*rate : nullptr, time - tracer.time()},
                             extension);
      }
    return fields;
  }


  template <int dim>
  std::optional<double>
  entering_value(const CharacteristicTracer<dim>                 &tracer,
                 const typename CharacteristicTracer<dim>::Trace &trace,
                 const Field<dim>                                &field,
                 const BoundaryCondition<dim>                    &condition,
                 const double                                     time)
  {
    const auto &place    = trace.foot.point;
    const auto &boundary = tracer.model().boundaries().at(trace.side, place);
    if (condition.is_dirichlet(boundary))
      return condition.dirichlet_value(boundary, trace.side.axis, place, time);
    // How fast fluid comes in through an opening is for the pressure to say.
    if (boundary.is_open() && field.lattice().normal_axis() != trace.side.axis)
      return condition.entering_value(place, time);
    return {};
  }


  template <int dim>
  std::vector<double>
  values_since_entry(const CharacteristicTracer<dim>                 &tracer,
                     const typename CharacteristicTracer<dim>::Trace &trace,
                     const std::vector<Field<dim>>                   &sources,
                     const GoingOn<dim>                              &going_on,
                     const BoundaryCondition<dim>                    &condition,
                     const GridIndex<dim>                            &index)
  {
    if (!trace.left_domain || going_on.times.empty())
      return {};
    const double end = tracer.time() + tracer.dt();
    const auto   entered =
      entering_value(tracer, trace, sources.front(), condition, end - trace.inside);
    if (!entered)
      return {};
    std::vector<double> result(sources.size(), *entered);
    if (going_on.rate)
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] += (trace.inside - (end - going_on.times[k])) * (*going_on.rate)(index);
    return result;
  }


  template <int dim>
  NearBodies<dim>::NearBodies(const CharacteristicTracer<dim> &tracer_, const Field<dim> &source_)
    : tracer(tracer_)
    , source(source_)
    , lattice(source.lattice())
    , axis(source.lattice().normal_axis())
  {
    if (tracer.bodies().obstruction != nullptr)
      samples = std::make_unique<const VisibleSamples<dim>>(
        source, tracer.stencils(source), tracer.vicinity());
  }


  template <int dim>
  double
  NearBodies<dim>::measure_of_point(const GridIndex<dim> &index) const
  {
    const auto &grid = tracer.model().grid();
    return axis < dim ? grid.face_area(axis, index) : grid.cell_volume(index);
  }


  template <int dim>
  typename SubLattice<dim>::Part
  NearBodies<dim>::whole(const GridIndex<dim> &index) const
  {
    return {index, lattice.point(index), measure_of_point(index)};
  }


  template <int dim>
  double
  NearBodies<dim>::value_at(const typename SubLattice<dim>::Part &part, const Place &foot) const
  {
    if (const auto seen = samples->along(part.index, part.place, foot))
      return *seen;
    if (axis >= dim)
      return unknown;
    const auto nearest = tracer.bodies().obstruction->nearest_point_to(foot.point);
    if (!nearest.is_free)
      return nearest.velocity[axis];
    const double largest = largest_around(part.index);
    return std::clamp(nearest.velocity[axis], -largest, largest);
  }


  /// Of the values at a point and next to it, on whichever side of a body. Fluid next to a body
  /// that moves on moves with it. Where a body shakes and the fluid does not follow, fluid that
  /// took its velocity would gain energy from nowhere.
  template <int dim>
  double
  NearBodies<dim>::largest_around(const GridIndex<dim> &index) const
  {
    using Kind           = typename SubLattice<dim>::Kind;
    const auto *divided  = source.divided();
    double      result   = 0;
    const auto  consider = [&](const GridIndex<dim> &point) {
      if (!source.stored().contains(point))
        return;
      if (!divided || divided->kind(point) == Kind::whole)
        result = std::max(result, std::abs(source(point)));
      else
        for_each_part(*divided, point, [&](const int k) {
          result = std::max(result, std::abs(source.parts()[k]));
        });
    };
    consider(index);
    for (unsigned int d = 0; d < dim; ++d)
      for (const int step : {-1, 1})
        consider(moved<dim>(index, d, step));
    return result;
  }


  template <int dim>
  std::optional<double>
  NearBodies<dim>::value_before(const typename SubLattice<dim>::Part &part) const
  {
    constexpr double rounding = 1e-9;
    const auto       only_one = [&](const SubLattice<dim> &divided) {
      return divided.last(part.index) - divided.first(part.index) == 1;
    };
    const auto  &now      = tracer.bodies().topology;
    const auto  *before   = source.divided();
    const double size     = measure_of_point(part.index);
    const bool   is_whole = part.measure > size * (1 - rounding);
    if (!is_whole && !only_one(now->of(lattice)))
      return {};
    using Kind = typename SubLattice<dim>::Kind;
    if (!before || before->kind(part.index) == Kind::whole)
      return is_whole || tracer.vicinity().parts(lattice.point(part.index), part.place)
               ? std::nullopt
               : std::optional<double>(source(part.index));
    if (before->kind(part.index) == Kind::closed || !only_one(*before))
      return {};
    const int    number = before->first(part.index);
    const double then   = before->all()[number].measure;
    if (then + part.measure <= size * (1 + rounding) ||
        (is_whole && then > size * (1 - rounding)) ||
        tracer.vicinity().parts(before->all()[number].place, part.place))
      return {};
    return source.parts()[number];
  }


  template <int dim>
  std::optional<double>
  NearBodies<dim>::mean_around(const typename SubLattice<dim>::Part &part) const
  {
    return samples->mean_around(
      part.index, tracer.vicinity().place(part.place), measure_of_point(part.index));
  }


  template <int dim>
  void
  NearBodies<dim>::finish(Field<dim> &advected, const BoundaryCondition<dim> &condition) const
  {
    if (!advected.topology())
      return;
    if (axis >= dim)
      fill_unknown(advected, tracer.model(), condition, tracer.time() + tracer.dt());
    set_means(advected, tracer.model().grid());
  }


#define INSTANTIATE(dim)                                                                          \
  template class NearBodies<dim>;                                                                 \
  template Field<dim> completed(                                                                  \
    const CharacteristicTracer<dim> &, Field<dim>, const double, const BoundaryCondition<dim> &); \
  template std::vector<Field<dim>> completed(const CharacteristicTracer<dim> &,                   \
                                             std::vector<Field<dim>>,                             \
                                             const GoingOn<dim> &,                                \
                                             const BoundaryCondition<dim> &,                      \
                                             const Extension);                                    \
  template std::optional<double>   entering_value(const CharacteristicTracer<dim> &,              \
                                                  const CharacteristicTracer<dim>::Trace &,       \
                                                  const Field<dim> &,                             \
                                                  const BoundaryCondition<dim> &,                 \
                                                  const double);                                  \
  template std::vector<double>     values_since_entry(const CharacteristicTracer<dim> &,          \
                                                      const CharacteristicTracer<dim>::Trace &,   \
                                                      const std::vector<Field<dim>> &,            \
                                                      const GoingOn<dim> &,                       \
                                                      const BoundaryCondition<dim> &,             \
                                                      const GridIndex<dim> &);
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
