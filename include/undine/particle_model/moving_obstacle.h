// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_moving_obstacle_h
#define undine_particle_model_moving_obstacle_h

#include <undine/base/options/expression.h>
#include <undine/particle_model/particle_domain.h>
#include <undine/particles/boundaries/moving_walls.h>

#include <string>
#include <vector>

namespace undine
{
  /// An obstacle of wall particles that moves as prescribed, and may turn and deform.
  template <int dim>
  class MovingObstacle
  {
  public:
    /// `particles` are where they rest. Throws InputError if the displacement there is no number at
    /// the start.
    MovingObstacle(const Options                        &options,
                   const std::string                    &name,
                   const Expression<dim, dim>           &displacement,
                   const std::vector<WallParticle<dim>> &particles);

    /// The particles at the start.
    std::vector<WallParticle<dim>>
    at_start() const;

    /// Append how its particles move in a frame of `length` [s] that begins at `time` [s]. Throws
    /// SolveError if the displacement is no number.
    void
    add_paths(particles::WallPaths<dim> &paths, double time, double length) const;

  private:
    /// At one time, of each particle or, if it is the same everywhere, of all of them.
    struct Instant
    {
      std::vector<dealii::Tensor<1, dim>> displacements; ///< [m]
      std::vector<dealii::Tensor<1, dim>> velocities;    ///< [m/s]
    };

    /// `accuracy` [s] is short against what the motion takes.
    Instant
    instant(double time, double accuracy) const;

    std::string                    name;
    Expression<dim, dim>           displacement; ///< [m]
    std::vector<WallParticle<dim>> at_rest;
  };
} // namespace undine

#endif
