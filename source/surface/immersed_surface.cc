// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/surface/immersed_surface.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Bodies, then obstacles.
    template <class Value>
    std::vector<Value>
    joined(std::vector<Value> of_bodies, const std::vector<Value> &of_obstacles)
    {
      of_bodies.insert(of_bodies.end(), of_obstacles.begin(), of_obstacles.end());
      return of_bodies;
    }


    /// Two surfaces side by side.
    template <int dim>
    Surface<dim>
    joined(const Surface<dim> &first, const Surface<dim> &second)
    {
      auto                      facets = first.facets();
      std::vector<unsigned int> bodies;
      for (unsigned int facet = 0; facet < first.facets().size(); ++facet)
        bodies.push_back(first.body(facet));
      for (unsigned int facet = 0; facet < second.facets().size(); ++facet)
        {
          facets.push_back(second.facets()[facet]);
          for (auto &node : facets.back())
            node += first.n_nodes();
          bodies.push_back(first.body_names().size() + second.body(facet));
        }
      return Surface<dim>(first.n_nodes() + second.n_nodes(),
                          facets,
                          bodies,
                          joined(first.body_names(), second.body_names()));
    }


    template <int dim>
    std::string
    periodic_complaint(const Surface<dim>                    &surface,
                       const std::vector<dealii::Point<dim>> &positions,
                       const MacGrid<dim>                    &grid)
    {
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int facet = 0; grid.periodic(d) && facet < surface.facets().size(); ++facet)
          for (const unsigned int node : surface.facets()[facet])
            if (const auto &x = positions[node];
                !(x[d] > grid.lower()[d] && x[d] < grid.upper()[d]))
              return fmt::format("Body '{}' reaches a periodic side of the domain at ({:.6g}). "
                                 "Try: move it, or the domain, so that it lies between the sides.",
                                 surface.body_names()[surface.body(facet)],
                                 fmt::join(x.begin_raw(), x.begin_raw() + dim, ", "));
      return "";
    }
  } // namespace


  template <int dim>
  ImmersedSurface<dim>::ImmersedSurface(const Options         &scene,
                                        const SolidModel<dim> *solid,
                                        const MacGrid<dim>    &grid)
    : grid(grid)
    , file_name(scene.file().name())
    , all_obstacles(std::make_shared<const Obstacles<dim>>(scene))
  {
    auto rest = all_obstacles->positions(0);
    if (solid == nullptr)
      all_facets = std::make_shared<const Surface<dim>>(all_obstacles->surface());
    else
      {
        body_surface.emplace(*solid);
        const auto &names = body_surface->surface().body_names();
        for (const auto &name : all_obstacles->surface().body_names())
          if (std::find(names.begin(), names.end(), name) != names.end())
            throw scene.section("Obstacles")
              .section(name)
              .error("", "a body has the same name", "Try: another name for one of them.");
        all_facets = std::make_shared<const Surface<dim>>(
          joined(body_surface->surface(), all_obstacles->surface()));
        rest = joined(body_surface->positions(solid->vector()), rest);
      }
    try
      {
        check_closed(*all_facets, rest);
        const auto complaint = periodic_complaint(*all_facets, rest, grid);
        if (!complaint.empty())
          throw InputError(complaint);
      }
    catch (const InputError &error)
      {
        throw InputError(fmt::format("{}: {}", file_name, error.what()));
      }
    if (solid != nullptr)
      held_in_each_other = held_pairs(*all_facets,
                                      fixed_nodes(*solid, *body_surface),
                                      rest,
                                      -rounding_of_places(*all_facets, rest));
  }


  template <int dim>
  ImmersedSurface<dim>::ImmersedSurface(const ImmersedSurface &all, const BodySurface<dim> &bodies)
    : grid(all.grid)
    , file_name(all.file_name)
    , body_surface(bodies)
    , all_obstacles(all.all_obstacles)
    , all_facets(all.all_facets)
    , held_in_each_other(all.held_in_each_other)
  {
  }


  template <int dim>
  std::vector<std::string>
  ImmersedSurface<dim>::section_names() const
  {
    std::vector<std::string> result;
    const auto n_bodies = body_surface ? body_surface->surface().body_names().size() : 0;
    for (const auto &name : all_facets->body_names())
      result.push_back((result.size() < n_bodies ? "Bodies/" : "Obstacles/") + name);
    return result;
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  ImmersedSurface<dim>::positions(const SolidState &state,
                                  const double      time,
                                  const double      ahead) const
  {
    auto result = all_obstacles->positions(time);
    check_motion(result, time);
    if (body_surface)
      {
        auto displacement = state.displacement;
        if (ahead != 0)
          displacement.add(ahead, state.velocity);
        result = joined(body_surface->positions(displacement), result);
      }
    check(result);
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ImmersedSurface<dim>::velocities(const SolidState &state,
                                   const double      time,
                                   const double      dt) const
  {
    positions(state, time + dt); // obstacles must arrive somewhere
    return with_bodies_of(state, all_obstacles->velocities(time, dt));
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ImmersedSurface<dim>::velocities_at(const SolidState &state,
                                      const double      time,
                                      const double      dt) const
  {
    const double around = 0.01 * dt;
    positions(state, time + around); // obstacles must arrive there
    return with_bodies_of(state, all_obstacles->velocities_at(time, around));
  }


  /// Velocities of all nodes, from those of the obstacles'.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ImmersedSurface<dim>::with_bodies_of(const SolidState                          &state,
                                       const std::vector<dealii::Tensor<1, dim>> &obstacles) const
  {
    return body_surface ? joined(body_surface->gather(state.velocity), obstacles) : obstacles;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ImmersedSurface<dim>::with_bodies(const typename SolidModel<dim>::Vector &vector,
                                    std::vector<dealii::Tensor<1, dim>>     values) const
  {
    AssertDimension(values.size(), all_facets->n_nodes());
    if (body_surface)
      {
        const auto of_bodies = body_surface->gather(vector);
        std::copy(of_bodies.begin(), of_bodies.end(), values.begin());
      }
    return values;
  }


  template <int dim>
  void
  ImmersedSurface<dim>::check(const std::vector<dealii::Point<dim>> &positions) const
  {
    check_positions(*all_facets, positions);
    const auto complaint = periodic_complaint(*all_facets, positions, grid);
    if (!complaint.empty())
      throw SolveError(complaint);
  }


  template <int dim>
  void
  ImmersedSurface<dim>::check_motion(const std::vector<dealii::Point<dim>> &positions,
                                     const double                           time) const
  {
    const auto &surface   = all_obstacles->surface();
    auto        complaint = positions_complaint(surface, positions);
    if (complaint.empty())
      complaint = periodic_complaint(surface, positions, grid);
    if (!complaint.empty())
      throw InputError(
        fmt::format("{}: section 'Obstacles': {} Its 'Displacement' takes it there by {:.6g} s, "
                    "whatever the step. Try also: another motion, or an earlier 'Time/End'.",
                    file_name,
                    complaint,
                    time));
  }


  template <int dim>
  void
  ImmersedSurface<dim>::add_to_bodies(typename SolidModel<dim>::Vector          &vector,
                                      const std::vector<dealii::Tensor<1, dim>> &values) const
  {
    AssertDimension(values.size(), all_facets->n_nodes());
    if (body_surface)
      body_surface->add(vector, {values.begin(), values.begin() + n_body_nodes()});
  }


  template class ImmersedSurface<2>;
  template class ImmersedSurface<3>;
} // namespace undine
