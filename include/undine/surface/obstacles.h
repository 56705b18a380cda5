// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_obstacles_h
#define undine_surface_obstacles_h

#include <undine/base/options/options.h>
#include <undine/surface/surface.h>

#include <memory>
#include <vector>

namespace undine
{
  /// Things in the fluid that it does not move: fixed, or moving as prescribed. Each is a
  /// subsection of `Obstacles` that bears its name, with a shape as bodies have it. The same on all
  /// ranks.
  template <int dim>
  class Obstacles
  {
  public:
    /// Declare the keys without building anything.
    static void
    declare(const Options &scene);

    /// Read the section `Obstacles` and build the surfaces. Throws InputError, FileError.
    explicit Obstacles(const Options &scene);

    /// All of them; bodies are obstacles in order of appearance.
    const Surface<dim> &
    surface() const
    {
      return *all_facets;
    }

    /// Whether any one moves.
    bool
    move() const;

    /// Of the nodes at `time` [m].
    std::vector<dealii::Point<dim>>
    positions(const double time) const;

    /// Of the nodes in a step from `time` on [m/s]: (x(time + dt) - x(time)) / dt, so that they
    /// arrive where they shall be, and a little along the normals, so that the flux through the
    /// surface at `time` is the growth of the volume in it in the step, for each closed surface,
    /// the outer one and that of each hole: none if the obstacle is rigid, also if it turns.
    std::vector<dealii::Tensor<1, dim>>
    velocities(const double time, const double dt) const;

  private:
    std::vector<dealii::Point<dim>>     rest_positions;
    std::vector<unsigned int>           obstacle_of_node;
    std::vector<Expression<dim, dim>>   displacements; ///< of each obstacle [m]
    std::unique_ptr<const Surface<dim>> all_facets;
  };
} // namespace undine

#endif
