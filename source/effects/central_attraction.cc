// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>

#include <fmt/format.h>

namespace undine
{
  /// A force towards a point that grows with the distance, -c (x - x_c), as on a drop that holds
  /// itself together. For particles only: on a grid it would have to be part of the pressure's
  /// reference, as gravity is.
  template <int dim>
  class CentralAttraction : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Strength",
                      strength,
                      "1/s^2",
                      Allowed::positive(),
                      "Acceleration over distance to the centre.");
      options.add("Centre", centre, "m", Allowed::anything(), "Towards which it pulls.");
    }

    void
    check(const Options                            &options,
          const typename Effect<dim>::Surroundings &surroundings) const override
    {
      if (surroundings.fluid != nullptr || surroundings.solid != nullptr)
        throw options.error(
          "Strength", "acts on particles only", "Try: 'Scheme = particle', or remove the effect.");
    }

    std::string
    summary() const override
    {
      return fmt::format("{:.6g} 1/s^2 towards ({})", strength, write_value(centre));
    }

    bool
    affect_particles(particles::Setup<dim> &setup) const override
    {
      setup.attraction = strength;
      for (unsigned int axis = 0; axis < dim; ++axis)
        setup.centre[axis] = centre[axis];
      return true;
    }

  private:
    double             strength = 1;
    dealii::Point<dim> centre;
  };


  namespace
  {
    const RegisterForDimensions<Effect, CentralAttraction>
      registered_central_attraction("central attraction",
                                    "A force towards a point that grows with the distance.");
  }
} // namespace undine
