// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_fluid_parts_h
#define undine_particle_model_fluid_parts_h

#include <undine/particle_model/particle_fluid.h>

#include <functional>
#include <optional>

namespace undine
{
  /// The parts of a domain that walls and obstacles separate, by its cubes; bodies do not separate
  /// them, for pressure goes through bodies. One is full if fluid or bodies are in all of its cubes
  /// and it has no open side: there is no free surface. Without openings pressures are known up to
  /// a constant there.
  template <int dim>
  struct FluidParts
  {
    /// What is in a cube besides fluid.
    enum class Cube : char
    {
      free,
      body,
      wall
    };

    unsigned int n      = 0; ///< that have fluid
    unsigned int n_full = 0;

    std::optional<dealii::Point<dim>> in_full; ///< a place of fluid in one that is full [m]

    /// `content` says what is in the cube around a place, once `fluid` has been filled in.
    FluidParts(const ParticleDomain<dim>                             &domain,
               const ParticleFluid<dim>                              &fluid,
               const std::function<Cube(const dealii::Point<dim> &)> &content);
  };
} // namespace undine

#endif
