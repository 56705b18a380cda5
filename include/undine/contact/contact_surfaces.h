// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_contact_surfaces_h
#define undine_contact_contact_surfaces_h

#include <undine/solid/assembly/contact_settings.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/obstacles.h>
#include <undine/surface/sharp_edges.h>

#include <vector>

namespace undine
{
  /// All that bodies may touch: the surfaces of bodies, then those of obstacles, and plane walls.
  /// Replicated on all ranks, constant during a run.
  template <int dim>
  class ContactSurfaces
  {
  public:
    using Positions = std::vector<dealii::Point<dim>>;
    using Vector    = typename SolidModel<dim>::Vector;

    /// `obstacles`: nullptr if there are none. Collective. Throws InputError.
    ContactSurfaces(const std::vector<ContactWall<dim>> &walls,
                    const SolidModel<dim>               &solid,
                    const Obstacles<dim>                *obstacles);

    /// The same in which only some bodies move, or none: `bodies` has been made from
    /// `all.bodies()`. The obstacles must outlive it.
    ContactSurfaces(const ContactSurfaces &all, const BodySurface<dim> &bodies);

    /// Positions of all nodes [m] at `time` [s]. Collective.
    Positions
    positions(const Vector &displacement, double time) const;

    /// The surfaces of bodies.
    const BodySurface<dim> &
    bodies() const
    {
      return body_surface;
    }

    /// Does a force on the node move a body?
    bool
    moves(const unsigned int node) const
    {
      return node < body_surface.n_nodes() && body_surface.moves(node);
    }

    unsigned int
    n_bodies() const
    {
      return body_surface.surface().body_names().size();
    }

    /// Is it the surface of a body? The others are those of obstacles.
    bool
    is_body(const unsigned int surface) const
    {
      return surface < n_bodies();
    }

    /// The surfaces of bodies, then of obstacles. All numbers of surfaces and nodes below are those
    /// of this surface.
    const Surface<dim> &
    surface() const
    {
      return all_facets;
    }

    /// The plane walls, as given.
    const std::vector<ContactWall<dim>> &
    walls() const
    {
      return all_walls;
    }

    /// The surface that a node belongs to.
    unsigned int
    surface_of_node(const unsigned int node) const
    {
      return surfaces_of_nodes[node];
    }

    /// Its share of the facets at rest [m^(dim-1)]; a node of an obstacle has no more than the most
    /// that one of a body has.
    double
    area(const unsigned int node) const
    {
      return areas[node];
    }

    /// The sharp edges of all surfaces at rest; none in 2D.
    const std::vector<SharpEdge> &
    sharp_edges() const
    {
      return all_edges;
    }

    /// Positions of all nodes at rest [m], of obstacles those at time 0.
    const Positions &
    rest() const
    {
      return rest_positions;
    }

    /// Does a support fix the body where it rests on the wall or reaches through it?
    bool
    is_fixed_at(const unsigned int body, const unsigned int wall) const
    {
      return fixed[body][wall];
    }

    /// Is a part of the body behind the wall at rest?
    bool
    reaches_through(const unsigned int body, const unsigned int wall) const
    {
      return reaching[body][wall];
    }

    /// Is there contact between a body's node and the wall? Not where the body is fixed and the
    /// node lies on the wall or behind it at rest, nor for any node if the body then may slide
    /// through the wall, since not all of it that is behind is clamped there.
    bool
    meets_wall(const unsigned int node, const unsigned int wall) const
    {
      const unsigned int body = surfaces_of_nodes[node];
      return !fixed[body][wall] || (!sliding[body][wall] && rest_gap(node, wall) > rounding());
    }

    /// The distance of the node from the wall at rest [m], negative behind it.
    double
    rest_gap(const unsigned int node, const unsigned int wall) const
    {
      return (rest_positions[node] - all_walls[wall].point) * all_walls[wall].normal;
    }

    /// Is there contact between these different surfaces? Not if both are obstacles, or if a
    /// support of one begins in the other or on it.
    bool
    meet(const unsigned int a, const unsigned int b) const
    {
      return a != b && (is_body(a) || is_body(b)) && !grown_together[a][b];
    }

    /// Mean extent of the bodies' facets, of the body where it is least [m].
    double
    facet_size() const
    {
      return least_size;
    }

    /// Distances at rest below this are nothing but rounding of places [m].
    double
    rounding() const
    {
      return 1e-9 * least_size;
    }

  private:
    void
    measure();
    void
    find_fixed(const SolidModel<dim> &solid);

    const BodySurface<dim>         body_surface;
    const Obstacles<dim> *const    obstacles;
    const Surface<dim>             all_facets;
    std::vector<ContactWall<dim>>  all_walls;
    std::vector<unsigned int>      surfaces_of_nodes;
    Positions                      rest_positions;
    std::vector<double>            areas;
    std::vector<SharpEdge>         all_edges;
    std::vector<std::vector<bool>> fixed;          ///< [body][wall]
    std::vector<std::vector<bool>> reaching;       ///< through the wall at rest: [body][wall]
    std::vector<std::vector<bool>> sliding;        ///< not all of that is clamped: [body][wall]
    std::vector<std::vector<bool>> grown_together; ///< [surface][surface]
    double                         least_size = 0;
  };
} // namespace undine

#endif
