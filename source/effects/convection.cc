// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/fluid/advection.h>

namespace undine
{
  /// The fluid carries its own momentum: dv/dt + (v.grad) v = 0 for one step. Without it the flow
  /// is a Stokes flow.
  template <int dim>
  class Convection : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      method = options.template choose<Advection<dim>>(
        "Method", "MacCormack", "How the velocity is carried.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.has_fluid)
        throw options.error("",
                            "convection acts on a fluid, but the scene has none",
                            "Remove the section or add a section 'Fluid'.");
    }

    std::string
    summary() const override
    {
      return method->summary();
    }

    void
    transport(FluidStep<dim> &step) const override
    {
      const auto timed = step.timing.section("convection");
      for (unsigned int axis = 0; axis < dim; ++axis)
        step.state.velocity[axis] =
          method->advect(step.flow, step.state.velocity[axis], VelocityCondition<dim>(axis));
    }

  private:
    std::unique_ptr<Advection<dim>> method;
  };


  namespace
  {
    const RegisterForDimensions<Effect, Convection>
      registered("convection", "The flow carries its own momentum.");
  }
} // namespace undine
