// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_fluid_h
#define undine_particle_model_particle_fluid_h

#include <undine/particle_model/particle_openings.h>
#include <undine/surface/shape_boundary.h>

#include <functional>
#include <vector>

namespace undine
{
  /// The fluid of particles as a scene describes it, in the section `Fluid`.
  template <int dim>
  struct ParticleFluid
  {
    /// Read the section. Throws InputError.
    explicit ParticleFluid(const Options &scene);

    /// Place its particles in the cubes of the domain whose centre is in the region and in one of
    /// the shapes (if there are any), and not `taken`. Throws InputError, also if there are none
    /// and none flow in.
    void
    fill(const ParticleDomain<dim>                             &domain,
         const std::function<bool(const dealii::Point<dim> &)> &taken);

    /// Does the scene leave places without fluid? Else it fills the domain.
    bool
    may_have_surface() const;

    /// What is known of the fluid at the start before its particles are made.
    struct Sample
    {
      double share   = 0; ///< of the domain's cubes, obstacles and bodies aside [1]
      double depth   = 0; ///< along gravity [m]
      double fastest = 0; ///< [m/s]
    };

    /// Evaluate one cube of so many that about 1e5 are evaluated. Throws InputError.
    Sample
    sample(const ParticleDomain<dim> &domain, const dealii::Tensor<1, dim> &gravity) const;

    Options                             options;
    double                              density      = 1000; ///< [kg/m^3]
    double                              bulk_modulus = 0;    ///< [Pa]; 0: incompressible
    std::vector<dealii::Point<dim>>     places;              ///< at t = 0 [m]
    std::vector<dealii::Tensor<1, dim>> velocities;          ///< at t = 0 [m/s]
    std::vector<ParticleOpening<dim>>   openings;

    /// How deep it is along `gravity` [m]; zero without gravity.
    double
    depth(const dealii::Tensor<1, dim> &gravity, const double spacing) const;

  private:
    Expression<dim>                    region;
    std::vector<ShapeDescription<dim>> shapes;
    Expression<dim, dim>               velocity;
  };
} // namespace undine

#endif
