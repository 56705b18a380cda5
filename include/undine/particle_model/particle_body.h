// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_body_h
#define undine_particle_model_particle_body_h

#include <undine/particle_model/particle_domain.h>
#include <undine/particles/setup/setup.h>
#include <undine/solid/mesh/body_boundary.h>
#include <undine/surface/shape_boundary.h>
#include <undine/surface/surface_distance.h>

#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// One elastic body of particles as a scene describes it, in a subsection of `Bodies`.
  template <int dim>
  struct ParticleBody
  {
    /// Read the keys of the section `name`. Throws InputError.
    ParticleBody(const std::string &name, const Options &options);

    /// Place its particles: at rest the points inside the shape of a lattice around the middle of
    /// its box, so that a box of a whole number of spacings is filled exactly. Throws InputError.
    void
    fill(const double spacing);

    std::string                                 name;
    Options                                     options;
    ShapeDescription<dim>                       description;
    particles::BodySetup                        setup;
    Expression<dim, dim>                        velocity;     ///< at t = 0 [m/s]
    std::vector<BodyBoundary<dim>>              boundaries;   ///< which hold it
    Expression<dim, dim>                        displacement; ///< at t = 0 [m]
    std::vector<dealii::Point<dim>>             places;       ///< at rest [m]
    std::vector<dealii::Point<dim>>             starts;       ///< at t = 0 [m]
    std::vector<dealii::Tensor<1, dim>>         velocities;   ///< at t = 0 [m/s]
    std::vector<unsigned char>                  clamped;      ///< directions as bits, by particle
    double                                      volume = 0;   ///< of the shape [m^dim]
    std::unique_ptr<const SurfaceDistance<dim>> surface;      ///< at t = 0

    /// Is it clamped in all directions?
    bool
    is_fixed(const std::size_t particle) const
    {
      return clamped[particle] == particles::all_directions<dim>;
    }

  private:
    void
    place_in(const SurfaceDistance<dim> &shape, double spacing);
    void
    hold(const BodyBoundary<dim> &boundary, const ShapeBoundary<dim> &shape, double spacing);
    void
    start(std::vector<dealii::Point<dim>> nodes, const Surface<dim> &boundary);
  };

  /// The bodies of the section `Bodies`, in order of appearance, without particles. Throws
  /// InputError.
  template <int dim>
  std::vector<ParticleBody<dim>>
  read_particle_bodies(const Options &scene);
} // namespace undine

#endif
