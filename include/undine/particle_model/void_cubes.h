// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_void_cubes_h
#define undine_particle_model_void_cubes_h

#include <undine/particle_model/particle_domain.h>

#include <functional>
#include <string>
#include <vector>

namespace undine
{
  /// The cubes of a domain that the scene leaves empty (`Fluid / Void regions`): around each seed
  /// the room that bodies, obstacles and walls close. Where particles are not, there is nothing and
  /// no pressure: during the run nothing is left of these regions.
  template <int dim>
  class VoidCubes
  {
  public:
    /// Read the section. Throws InputError.
    explicit VoidCubes(const Options &fluid);

    /// Find the rooms; `taken` says what of a cube's middle belongs to walls, obstacles or bodies.
    /// Throws InputError if a seed lies there or outside, or if nothing is left for the fluid.
    void
    fill(const ParticleDomain<dim>                             &domain,
         const std::function<bool(const dealii::Point<dim> &)> &taken);

    /// Is the cube around its middle `place` in one of them?
    bool
    contain(const dealii::Point<dim> &place) const;

  private:
    struct Region
    {
      std::string        name;
      dealii::Point<dim> seed; ///< [m]
    };

    /// Of the cube around a place of the domain.
    std::size_t
    number(const dealii::Point<dim> &place) const;

    void
    for_each_neighbour(std::size_t cube, const std::function<void(std::size_t)> &action) const;

    /// Mark what a seed's cube is connected to.
    void
    flood(const Region &region);

    enum class Cube : char
    {
      open,
      taken,
      empty ///< in a region
    };

    Options                    options;
    std::vector<Region>        regions;
    const ParticleDomain<dim> *domain = nullptr;
    std::vector<Cube> cubes; ///< the first direction running fastest; empty without regions
  };
} // namespace undine

#endif
