// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/effects/transport_form.h>
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/convection/short_waves.h>
#include <undine/fluid/implicit_momentum.h>
#include <undine/fluid/pressure/projection.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// The fluid advects its own momentum: dv/dt + (v.grad) v = a for one step, where in steps of one
  /// stage a share of the acceleration a by forces is advected (see FluidStage). Without
  /// convection the flow is a Stokes flow.
  template <int dim>
  class Convection : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      form.add_options(
        options,
        "convection",
        "'flux': momentum flows through the faces between volumes of the grid, centrally and "
        "implicitly: it conserves momentum, but for a share of what moving bodies cover and clear "
        "in a step, and forces on what stands in the fluid are far more accurate and hardly depend "
        "on the step. It smooths nothing: without "
        "viscosity, layers thinner than a cell oscillate. 'along paths': values are brought along "
        "the paths of the fluid, by 'Method', which smooths such layers. 'automatic': 'flux' with "
        "the effect viscosity, if no 'Method' is given and there is no vorticity confinement, else "
        "'along paths'.");
      options.add(
        "Short waves",
        short_waves,
        "",
        Allowed::one_of({"damped", "kept"}),
        "In flux form, central fluxes carry waves shorter than four cells upstream, where they "
        "stay and disturb what sheds them. 'damped': waves lose as much as by upwind fluxes of "
        "fifth "
        "order, in the time in which the flow crosses a cell two thirds of those of two cells, 13 "
        "% "
        "of four, 0.3 % of eight. 'kept': the flux form takes no energy of any.");
      method = options.template choose<Advection<dim>>(
        "Method", "cubic", "How the velocity is advected along paths.");
    }

    void
    adapt_to(const std::vector<std::string> &effects) override
    {
      form.adapt_to(effects);
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.fluid && !around.has_fluid_particles)
        throw options.error("",
                            "convection acts on a fluid, but the scene has none",
                            "Remove the section or add a section 'Fluid'.");
      if (!form.is_flux() && options.given("Short waves"))
        throw options.error("Short waves",
                            "is for the flux form, but values are brought along paths",
                            "Remove the key, or set 'Form = flux'.");
      if (form.is_flux() && is_among(around.effects, "vorticity confinement"))
        throw options.error("Form",
                            "'flux' smooths nothing that vorticity confinement could make good",
                            "Set 'Form = along paths', or remove 'vorticity confinement'.");
    }

    std::string
    summary() const override
    {
      return form.is_flux() ? "flux form, central, implicit" : method->summary();
    }

    std::string
    summary_of_particles() const override
    {
      return "particles carry their momentum";
    }

    typename Effect<dim>::Work
    work() const override
    {
      return {dim, 0};
    }

    /// They move with their momentum anyway.
    bool
    affect_particles(particles::Setup<dim> &) const override
    {
      return true;
    }

    bool
    is_in_passes() const override
    {
      return false;
    }

    /// Surfaces may move: what then is kept from stage to stage.
    void
    initialize(const FluidModel<dim> &model, FluidState<dim> &state) const override
    {
      const auto &topology = state.velocity[0].topology();
      if (form.is_flux() && topology)
        for (auto &half : state.volume_rates.halves)
          for (unsigned int axis = 0; axis < dim; ++axis)
            half[axis] = Field<dim>(model.grid().faces(axis), topology);
    }

    void
    transport(FluidStage<dim> &step) const override
    {
      if (form.is_flux())
        {
          step.conserve_momentum();
          return;
        }
      const auto timed = step.timing.section(this->name);
      if (step.stage.keeps_rates())
        advect(step.advected_velocities(), step);
      else
        advect_with_acceleration(step);
    }

    void
    accelerate(FluidStage<dim> &step) const override
    {
      if (!form.is_flux())
        return;
      const auto timed = step.timing.section(this->name);
      auto       flow  = step.flow_at_end();
      if (!step.motion())
        {
          step.carrying.emplace(step.model, flow, step.end);
          return;
        }
      if (!projection)
        projection = std::make_unique<Projection<dim>>(step.model);
      const auto unfitted = flow;
      step.linear_iterations += projection->fit_to_growth(flow, step.motion()->growth, step.end);
      step.carrying.emplace(step.model, flow, step.end, *step.motion(), unfitted);
    }

    /// In flux form: together with friction, by the effect `viscosity`, if there is any.
    void
    diffuse(FluidStage<dim> &step) const override
    {
      if (!form.is_flux())
        return;
      const auto timed = step.timing.section(this->name);
      if (short_waves == "damped")
        {
          damp_short_waves(
            step.model, step.carrying->unfitted_flow(), step.dt, step.state.velocity);
          step.timing.memory.hold_briefly(this->name,
                                          2 * step.state.velocity[0].memory_consumption());
        }
      if (step.viscosity == 0)
        momentum.solve(step, this->name);
    }

    std::size_t
    memory_consumption(const FluidState<dim> &state) const override
    {
      std::size_t sum = momentum.memory_consumption();
      if (is_in_use(state.volume_rates))
        for (const auto &half : state.volume_rates.halves)
          sum += undine::memory_consumption(half);
      return sum;
    }

  private:
    static bool
    is_among(const std::vector<std::string> &effects, const std::string &name)
    {
      return std::count(effects.begin(), effects.end(), name) > 0;
    }

    void
    advect(const std::vector<Velocity<dim> *> &velocities, FluidStage<dim> &step) const
    {
      // An advected share of the acceleration is taken away again: what enters has it.
      const bool has_rate = step.stage.going_on() != 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          std::vector<Field<dim>> components;
          std::size_t             memory = 0;
          for (const auto *velocity : velocities)
            {
              components.push_back((*velocity)[axis]);
              memory += components.back().memory_consumption();
            }
          step.timing.memory.hold_briefly(this->name, memory);
          components =
            method->advect(step.tracer,
                           std::move(components),
                           step.stage.keeps_rates()
                             ? step.going_on(velocities.size(),
                                             has_rate ? &step.state.acceleration[axis] : nullptr)
                             : GoingOn<dim>(),
                           VelocityCondition<dim>(axis));
          for (std::size_t k = 0; k < components.size(); ++k)
            (*velocities[k])[axis] = std::move(components[k]);
        }
    }

    void
    advect_with_acceleration(FluidStage<dim> &step) const
    {
      auto        &velocity = step.state.velocity;
      const auto  &now      = step.state.acceleration;
      const double share    = FluidStage<dim>::advected_share * step.dt;
      for (unsigned int axis = 0; axis < dim; ++axis)
        add_to_whole_faces(velocity[axis], share, now[axis]);
      advect({&velocity}, step);
      for (unsigned int axis = 0; axis < dim; ++axis)
        add_to_whole_faces(velocity[axis], -share, now[axis]);
      step.advected = velocity;
      step.timing.memory.hold_briefly(this->name, 2 * undine::memory_consumption(velocity));
    }

    /// A body may have come or gone between the two: faces that it divides have no acceleration.
    static void
    add_to_whole_faces(Field<dim> &component, const double factor, const Field<dim> &acceleration)
    {
      const auto *divided = component.divided();
      for_each(component.owned(), [&](const GridIndex<dim> &face) {
        if (!divided || divided->kind(face) == SubLattice<dim>::Kind::whole)
          component(face) += factor * acceleration(face);
      });
    }

    TransportForm                            form;
    std::string                              short_waves = "damped";
    std::unique_ptr<Advection<dim>>          method;
    mutable ImplicitMomentum<dim>            momentum;   ///< a cache
    mutable std::unique_ptr<Projection<dim>> projection; ///< the same, for surfaces that move
  };


  namespace
  {
    const RegisterForDimensions<Effect, Convection>
      registered_convection("convection", "The flow advects its own momentum.");
  }
} // namespace undine
