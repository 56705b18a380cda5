// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/characteristic_tracer.h>
#include <undine/fluid/grid/interpolation.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr int margin = 3; ///< layers beyond those that paths cross


    /// What comes in under a given pressure brings in kinetic energy, the more the faster it is.
    template <int dim>
    std::string
    advice_on_openings(const BoundaryMap<dim> &boundaries)
    {
      for (const auto &boundary : boundaries.all())
        if (boundary.kind == BoundaryKind::pressure)
          return ", or 'Kind = outflow' for the boundary '" + boundary.name +
                 "', which takes the same 'Pressure': what comes in through it does so from rest "
                 "outside then, and brings in no energy";
      return "";
    }


    /// Ghost layers for paths of a given length, and for the up to four points around their ends.
    template <int dim>
    GridIndex<dim>
    layers_within(const FluidModel<dim>        &model,
                  const dealii::Tensor<1, dim> &distance,
                  const double                  dt)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          // Ghost layers end at the boundary, but a periodic domain is stored again and again.
          const double times = model.grid().periodic(d) ? 10 : 100;
          if (distance[d] > times * (model.grid().upper()[d] - model.grid().lower()[d]))
            throw SolveError(
              fmt::format("The fluid would travel {:.3g} m along {} in one step of {:.3g} s, more "
                          "than {} times through the domain. Try a smaller step{}.",
                          distance[d],
                          "xyz"[d],
                          dt,
                          times,
                          advice_on_openings(model.boundaries())));
        }
      auto width = model.grid().planes_crossed(distance);
      for (int &layers : width.values)
        layers += margin;
      return width;
    }


    /// Fill ghost layers and boundary points of a velocity.
    template <int dim, class Width>
    void
    complete(Velocity<dim>         &velocity,
             const FluidModel<dim> &model,
             const Width           &width,
             const double           time)
    {
      for (auto &component : velocity.components)
        component.exchange(width);
      for (unsigned int axis = 0; axis < dim; ++axis)
        fill_boundary_points(
          velocity[axis], model.boundaries(), VelocityCondition<dim>(axis), velocity, time);
    }


    /// How far fluid can go in one step along each axis [m]: as fast as the fastest face or
    /// boundary point, such as a lid. One ghost layer of the velocity is filled.
    template <int dim>
    dealii::Tensor<1, dim>
    longest_path(const FluidModel<dim> &model,
                 Velocity<dim>         &velocity,
                 const double           time,
                 const double           dt)
    {
      auto result = largest_components(model, velocity); // asserts that they are finite
      complete(velocity, model, 1, time);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const auto &component = velocity[axis];
          for_each_row(component.stored(), [&](const GridIndex<dim> &first, const int n) {
            const double *values = component.data(first);
            for (int i = 0; i < n; ++i)
              result[axis] = std::max(result[axis], std::abs(values[i]));
          });
          result[axis] = dealii::Utilities::MPI::max(result[axis], model.grid().communicator());
        }
      return std::abs(dt) * result;
    }
  } // namespace


  template <int dim>
  CharacteristicTracer<dim>::CharacteristicTracer(const FluidModel<dim> &model,
                                                  const Velocity<dim>   &velocity,
                                                  const double           time,
                                                  const double           dt,
                                                  const Bodies          &bodies,
                                                  const double           time_of_flow)
    : fluid_model(model)
    , among(bodies)
    , frozen_velocity(velocity)
    , start_time(time)
    , step(dt)
    , ghost_width(layers_within(model, longest_path(model, frozen_velocity, time_of_flow, dt), dt))
    , body_vicinity(
        model.grid(), velocity[0].topology(), bodies.topology, bodies.obstruction, ghost_width)
  {
    complete(frozen_velocity, model, ghost_width, time_of_flow);
    if (among.obstruction != nullptr)
      for (unsigned int axis = 0; axis < dim; ++axis)
        samples[axis] = std::make_unique<VisibleSamples<dim>>(
          frozen_velocity[axis], stencils(frozen_velocity[axis]), body_vicinity);
  }


  template <int dim>
  const std::shared_ptr<VisibilityStencils<dim>> &
  CharacteristicTracer<dim>::stencils(const Field<dim> &like) const
  {
    for (const auto &made : stencils_made)
      if (made->points().is_for(like))
        return made;
    const auto enters = [&](const unsigned int    axis,
                            const unsigned int    end,
                            const GridIndex<dim> &index) {
      bool result = true;
      for_each_boundary_around(fluid_model.boundaries(),
                               like.lattice(),
                               Side{axis, end},
                               index,
                               [&](const Boundary<dim> &boundary, double, const GridIndex<dim> &) {
                                 result = result && boundary.kind == BoundaryKind::inflow;
                               });
      return result;
    };
    stencils_made.push_back(std::make_shared<VisibilityStencils<dim>>(
      like, ghost_width, *among.obstruction, body_vicinity, enters));
    return stencils_made.back();
  }


  template <int dim>
  const typename CharacteristicTracer<dim>::Bodies &
  CharacteristicTracer<dim>::bodies() const
  {
    return among;
  }


  template <int dim>
  const BodyVicinity<dim> &
  CharacteristicTracer<dim>::vicinity() const
  {
    return body_vicinity;
  }


  template <int dim>
  const FluidModel<dim> &
  CharacteristicTracer<dim>::model() const
  {
    return fluid_model;
  }


  template <int dim>
  double
  CharacteristicTracer<dim>::time() const
  {
    return start_time;
  }


  template <int dim>
  double
  CharacteristicTracer<dim>::dt() const
  {
    return step;
  }


  template <int dim>
  const Velocity<dim> &
  CharacteristicTracer<dim>::velocity() const
  {
    return frozen_velocity;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  CharacteristicTracer<dim>::velocity_at(const Place &place) const
  {
    if (!body_vicinity.is_next_to_body(place))
      return interpolate(frozen_velocity, place.point);
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (const auto seen = samples[axis]->at(place))
        result[axis] = *seen;
      else
        result[axis] = among.obstruction->nearest_velocity(place.point)[axis];
    return result;
  }


  template <int dim>
  const GridIndex<dim> &
  CharacteristicTracer<dim>::width() const
  {
    return ghost_width;
  }


  template <int dim>
  GridIndex<dim>
  CharacteristicTracer<dim>::reach(const int beyond) const
  {
    // One of the planes that may be crossed is counted for paths that begin anywhere. From point i
    // a path passes the k others up to i + k only if one as long, begun at a plane, meets k + 1 of
    // them: the lower planes of i to i + k or the upper ones, whichever are closer together.
    auto points = ghost_width;
    for (int &layers : points.values)
      layers += beyond - margin - 1;
    return points;
  }


  template <int dim>
  typename CharacteristicTracer<dim>::Trace
  CharacteristicTracer<dim>::trace(const dealii::Point<dim> &point, const double dt) const
  {
    const auto place    = body_vicinity.place(point);
    double     duration = dt / 2;
    auto       path     = walk(place, duration * velocity_at(place));
    if (!path.leaving)
      {
        duration = dt;
        path     = walk(place, duration * velocity_at(path.end));
      }
    const bool is_near = body_vicinity.is_near(place, path.end);
    if (!path.leaving)
      return {path.end, false, is_near, {}, std::abs(dt)};
    return {path.end, true, is_near, path.leaving->side, path.leaving->share * std::abs(duration)};
  }


  template <int dim>
  typename CharacteristicTracer<dim>::Walk
  CharacteristicTracer<dim>::walk(const Place &place, const dealii::Tensor<1, dim> &path) const
  {
    // A little is left between path and surface, so that the surface hides what lies beyond.
    constexpr double share = 0.98;
    const auto       end   = body_vicinity.place(place.point + path);
    if (const double hit = body_vicinity.first_hit(place, end); hit <= 1)
      return {body_vicinity.place(place.point + share * hit * path), {}};
    const auto [kept, leaving] = kept_in_domain(place.point, path);
    return {kept == end.point ? end : body_vicinity.place(kept), leaving};
  }


  template <int dim>
  std::pair<dealii::Point<dim>, std::optional<typename CharacteristicTracer<dim>::Leaving>>
  CharacteristicTracer<dim>::kept_in_domain(const dealii::Point<dim>     &place,
                                            const dealii::Tensor<1, dim> &path) const
  {
    const auto        &grid = fluid_model.grid();
    dealii::Point<dim> end  = place + path;
    // Each turn ends the path at the first boundary it meets, or bends it along that wall.
    for (unsigned int turn = 0; turn < dim; ++turn)
      {
        double when = 2;
        Side   side{0, 0};
        for (unsigned int d = 0; d < dim; ++d)
          if (!grid.periodic(d) && (end[d] < grid.lower()[d] || end[d] > grid.upper()[d]))
            {
              const unsigned int upper = end[d] > grid.upper()[d] ? 1 : 0;
              const double       wall  = upper ? grid.upper()[d] : grid.lower()[d];
              const double       here  = std::max(0., (wall - place[d]) / path[d]);
              if (here < when)
                {
                  when = here;
                  side = {d, upper};
                }
            }
        if (when > 1)
          break;
        auto hit = place + when * path;
        for (unsigned int d = 0; d < dim; ++d)
          if (!grid.periodic(d)) // it may have been bent along a wall before
            hit[d] = std::clamp(hit[d], grid.lower()[d], grid.upper()[d]);
        const auto &boundary = fluid_model.boundaries().at(side, hit);
        if (boundary.lets_fluid_pass())
          return {hit, Leaving{side, when}};
        end[side.axis] = side.end == 0 ? grid.lower()[side.axis] : grid.upper()[side.axis];
      }
    return {end, {}};
  }


  template class CharacteristicTracer<2>;
  template class CharacteristicTracer<3>;
} // namespace undine
