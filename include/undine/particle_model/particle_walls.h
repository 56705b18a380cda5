// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_walls_h
#define undine_particle_model_particle_walls_h

#include <undine/particle_model/moving_obstacle.h>
#include <undine/particle_model/particle_domain.h>
#include <undine/surface/surface_distance.h>

#include <memory>
#include <vector>

namespace undine
{
  /// Particles of a wall behind a closed surface of any shape, inside it and inside `region` [m],
  /// layer k at the depth (k + 1/2) spacings. Within a layer they are as far from each
  /// other as disorder allows: lattice points are moved to the depth of their layer, then apart
  /// from each other along it. Where surface and lattice fit each other they stay a lattice. Of
  /// thin walls, layers for which there is no room lie where they fit.
  template <int dim>
  std::vector<WallParticle<dim>>
  fit_wall_particles(const ParticleDomain<dim>      &domain,
                     const dealii::BoundingBox<dim> &region,
                     const SurfaceDistance<dim>     &surface);

  /// The section `Obstacles`: walls of any shape, fixed or moving as prescribed.
  template <int dim>
  struct ParticleObstacles
  {
    std::vector<std::unique_ptr<const SurfaceDistance<dim>>> surfaces;
    std::vector<WallParticle<dim>>                           particles; ///< of fixed ones
    std::vector<MovingObstacle<dim>>                         moving;

    /// Is a place inside any of them at the start?
    bool
    contain(const dealii::Point<dim> &place) const;
  };

  /// Read and fill them. Throws InputError.
  template <int dim>
  ParticleObstacles<dim>
  read_particle_obstacles(const Options &scene, const ParticleDomain<dim> &domain);

  /// Declare the keys without building anything.
  template <int dim>
  void
  declare_particle_obstacles(const Options &scene);
} // namespace undine

#endif
