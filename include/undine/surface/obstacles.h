// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_obstacles_h
#define undine_surface_obstacles_h

#include <undine/base/options/options.h>
#include <undine/surface/surface.h>

#include <memory>
#include <vector>

namespace undine
{
  /// Obstacles in the fluid, which does not move them: fixed, or moving as prescribed. Each is a
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

    /// Does any obstacle move?
    bool
    move() const;

    /// Positions of the nodes [m] at `time` [s].
    std::vector<dealii::Point<dim>>
    positions(const double time) const;

    /// Velocities of the nodes [m/s] in a step of `dt` [s] from `time` on,
    ///
    ///     (x(time + dt) - x(time)) / dt,
    ///
    /// so that they arrive at x(time + dt), with a small correction along the normals, so that the
    /// flux through the surface at `time` is the growth of the enclosed volume in the step. This
    /// holds for each closed surface, the outer one and that of each hole; the growth is zero if
    /// the obstacle is rigid, even if it rotates.
    std::vector<dealii::Tensor<1, dim>>
    velocities(const double time, const double dt) const;

    /// Those at `time` itself, by differences over `around` [s] on either side, with that
    /// correction for the flux through the surface at `time`.
    std::vector<dealii::Tensor<1, dim>>
    velocities_at(const double time, const double around) const;

  private:
    std::vector<dealii::Tensor<1, dim>>
    mean_velocities(const double time, const double begin, const double end) const;

    std::vector<dealii::Point<dim>>     rest_positions;
    std::vector<unsigned int>           obstacle_of_node;
    std::vector<Expression<dim, dim>>   displacements; ///< of each obstacle [m]
    std::unique_ptr<const Surface<dim>> all_facets;
  };
} // namespace undine

#endif
