// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>

#include <fmt/format.h>

namespace undine
{
  /// Rayleigh damping of bodies (E5), alpha M u + eta V(d) u: the viscous stress V belongs to the
  /// rate of strain of the material, so that rigid rotation is not damped.
  template <int dim>
  class Damping : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Mass coefficient",
                  mass_coefficient,
                  "1/s",
                  Allowed::not_negative(),
                  "alpha: damps slow motion most, free flight included.");
      options.add("Stiffness coefficient",
                  stiffness_coefficient,
                  "s",
                  Allowed::not_negative(),
                  "eta: damps fast vibration most.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.solid && !around.has_body_particles)
        throw options.error("",
                            "damping acts on bodies, but the scene has none",
                            "Remove the section or add a body.");
      if (mass_coefficient == 0 && stiffness_coefficient == 0)
        throw options.error(
          "Mass coefficient",
          "and 'Stiffness coefficient' are both zero, so that damping does nothing",
          "Set one of them to a number > 0, or remove the section.");
    }

    std::string
    summary() const override
    {
      return fmt::format("C = {:.4g} M + {:.4g} V", mass_coefficient, stiffness_coefficient);
    }

    void
    affect(SolidEnvironment<dim> &environment) const override
    {
      environment.mass_damping += mass_coefficient;
      environment.stiffness_damping += stiffness_coefficient;
    }

    bool
    affect_particles(particles::Setup<dim> &setup) const override
    {
      setup.body_damping.mass += mass_coefficient;
      setup.body_damping.stiffness += stiffness_coefficient;
      return true;
    }

  private:
    double mass_coefficient      = 0;
    double stiffness_coefficient = 0;
  };


  namespace
  {
    const RegisterForDimensions<Effect, Damping> registered_damping("damping",
                                                                    "Rayleigh damping of bodies.");
  }
} // namespace undine
