// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>

#include <fmt/format.h>

namespace undine
{
  /// Uniform gravity g. The fluid's pressure is the reduced one, p - rho g.x, in which the weight
  /// of a fluid of constant density is contained: nothing is added to its velocity, and fluid at
  /// rest stays at rest exactly. Bodies and particles get their weight as a load.
  template <int dim>
  class Gravity : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require(
        "Acceleration", acceleration, "m/s^2", Allowed::anything(), "Of free fall, as a vector.");
    }

    std::string
    summary() const override
    {
      return "(" + write_value(acceleration) + ") m/s^2; in a fluid on a grid as reduced pressure";
    }

    void
    affect(SolidEnvironment<dim> &environment) const override
    {
      environment.gravity += acceleration;
    }

    bool
    affect_particles(particles::Setup<dim> &setup) const override
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        setup.gravity[axis] += acceleration[axis];
      return true;
    }

  private:
    dealii::Tensor<1, dim> acceleration;
  };


  namespace
  {
    const RegisterForDimensions<Effect, Gravity>
      registered_gravity("gravity",
                         "Weight of bodies; the fluid's is part of its reduced pressure.");
  }
} // namespace undine
