// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>

#include <fmt/format.h>

namespace undine
{
  /// Friction of a fluid of particles on walls and obstacles by the law of the wall, smooth or
  /// rough (particles::WallFriction): the boundary layer of water is much thinner than particles
  /// are. For particles only: on a grid 'viscosity' acts on walls.
  template <int dim>
  class WallFriction : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Dynamic viscosity",
                      dynamic_viscosity,
                      "Pa s",
                      Allowed::positive(),
                      "Of the fluid in the layer at the wall: 1e-3 for water.");
      options.add("Roughness",
                  roughness,
                  "m",
                  Allowed::not_negative(),
                  "Height of the sand grains of walls that are as rough. 0: smooth.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.has_fluid_particles)
        throw options.error("",
                            "acts on fluids of particles only",
                            "Try: 'Scheme = particle' with a fluid, or remove the effect.");
    }

    std::string
    summary() const override
    {
      return fmt::format("{:.4g} Pa s, {}",
                         dynamic_viscosity,
                         roughness > 0 ? fmt::format("grains of {:.4g} m", roughness) : "smooth");
    }

    bool
    affect_particles(particles::Setup<dim> &setup) const override
    {
      setup.wall_viscosity = dynamic_viscosity / setup.fluid_density;
      setup.wall_roughness = roughness;
      return true;
    }

  private:
    double dynamic_viscosity = 0;
    double roughness         = 0;
  };


  namespace
  {
    const RegisterForDimensions<Effect, WallFriction>
      registered_wall_friction("wall friction",
                               "Turbulent friction of particles on walls and obstacles.");
  }
} // namespace undine
