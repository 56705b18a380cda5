// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_immersed_surface_h
#define undine_surface_immersed_surface_h

#include <undine/fluid/grid/mac_grid.h>
#include <undine/solid/mesh/solid_state.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/held_pairs.h>
#include <undine/surface/obstacles.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace undine
{
  /// The surface of everything in the fluid: first the nodes and facets of deformable bodies, then
  /// those of obstacles. Replicated on all ranks.
  ///
  /// Bodies may reach out of the domain, also over a whole side, but not to a periodic side.
  template <int dim>
  class ImmersedSurface
  {
  public:
    /// `solid`: nullptr if there are no bodies. The grid must outlive this. Throws InputError if a
    /// surface is not closed or reaches a periodic side at rest, or if a body and an obstacle have
    /// the same name. Collective.
    ImmersedSurface(const Options &scene, const SolidModel<dim> *solid, const MacGrid<dim> &grid);

    /// The same in which only some bodies move, or none: `bodies` has been made from
    /// `all.bodies()`. The grid must outlive this.
    ImmersedSurface(const ImmersedSurface &all, const BodySurface<dim> &bodies);

    /// Nodes and facets of bodies, then of obstacles.
    const Surface<dim> &
    surface() const
    {
      return *all_facets;
    }

    /// nullptr if there are none.
    const BodySurface<dim> *
    bodies() const
    {
      return body_surface ? &*body_surface : nullptr;
    }

    const Obstacles<dim> &
    obstacles() const
    {
      return *all_obstacles;
    }

    /// The pairs of surfaces of which one is held in the other by a support: together they are one
    /// body for the fluid.
    const std::vector<PairOfSurfaces> &
    held() const
    {
      return held_in_each_other;
    }

    /// The sections of the scene that describe them, in the order of surface().body_names().
    std::vector<std::string>
    section_names() const;

    /// The name of the scene's file.
    const std::string &
    scene_name() const
    {
      return file_name;
    }

    /// The nodes of bodies are the first ones.
    unsigned int
    n_body_nodes() const
    {
      return body_surface ? body_surface->n_nodes() : 0;
    }

    /// Is it a node of a body that moves? For the fluid all other nodes are those of obstacles.
    bool
    moves(const unsigned int node) const
    {
      return node < n_body_nodes() && body_surface->moves(node);
    }

    /// Positions of all nodes [m], of bodies by their displacement and `ahead` [s] times their
    /// velocity, of obstacles at `time` [s]. Throws SolveError as check() does; InputError if it is
    /// an obstacle, whose prescribed motion no smaller step changes. Collective.
    std::vector<dealii::Point<dim>>
    positions(const SolidState &state, const double time, const double ahead = 0) const;

    /// Velocities of all nodes [m/s], of obstacles those in a step of `dt` [s] from `time` on, see
    /// Obstacles::velocities(). Throws as positions() does, also if obstacles cannot be at its end.
    /// Collective.
    std::vector<dealii::Tensor<1, dim>>
    velocities(const SolidState &state, const double time, const double dt) const;

    /// The same with the velocities of obstacles at `time` itself, by differences over a hundredth
    /// of `dt` on either side. Throws alike. Collective.
    std::vector<dealii::Tensor<1, dim>>
    velocities_at(const SolidState &state, const double time, const double dt) const;

    /// `values` in all nodes, in which those of bodies that move are replaced by a vector over
    /// their owned degrees of freedom. Collective.
    std::vector<dealii::Tensor<1, dim>>
    with_bodies(const typename SolidModel<dim>::Vector &vector,
                std::vector<dealii::Tensor<1, dim>>     values) const;

    /// Throws SolveError, naming the body, if a position is not finite, a body inside out or at a
    /// periodic side.
    void
    check(const std::vector<dealii::Point<dim>> &positions) const;

    /// Add values in the nodes, the same on all ranks, to a vector of the bodies' owned degrees of
    /// freedom; values in nodes of obstacles are ignored. Collective.
    void
    add_to_bodies(typename SolidModel<dim>::Vector          &vector,
                  const std::vector<dealii::Tensor<1, dim>> &values) const;

  private:
    void
    check_motion(const std::vector<dealii::Point<dim>> &positions, const double time) const;
    std::vector<dealii::Tensor<1, dim>>
    with_bodies_of(const SolidState                          &state,
                   const std::vector<dealii::Tensor<1, dim>> &obstacles) const;

    const MacGrid<dim>                         &grid;
    const std::string                           file_name;
    std::optional<const BodySurface<dim>>       body_surface;
    const std::shared_ptr<const Obstacles<dim>> all_obstacles;
    std::shared_ptr<const Surface<dim>>         all_facets;
    std::vector<PairOfSurfaces>                 held_in_each_other;
  };
} // namespace undine

#endif
