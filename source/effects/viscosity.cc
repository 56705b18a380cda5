// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/implicit_momentum.h>
#include <undine/fluid/pressure/divergence.h>

#include <fmt/format.h>

#include <algorithm>

namespace undine
{
  /// Friction in a fluid of constant viscosity, implicit in time (implicit Euler):
  ///
  ///     (1 - h nu Laplace) w = v'' - h grad q^n / rho,   v* = w + h grad q^n / rho        (E3)
  ///
  /// for each component, with no-slip walls, inflow, and no friction on openings (see FluidStage
  /// for the old pressure gradient).
  template <int dim>
  class Viscosity : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require(
        "Dynamic viscosity", dynamic_viscosity, "Pa s", Allowed::positive(), "Of the fluid.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.fluid && !around.has_fluid_particles)
        throw options.error("",
                            "viscosity acts on a fluid, but the scene has none",
                            "Remove the section or add a section 'Fluid'.");
    }

    std::string
    summary() const override
    {
      return fmt::format("{:.4g} Pa s, implicit on a grid", dynamic_viscosity);
    }

    bool
    affect_particles(particles::Setup<dim> &setup) const override
    {
      setup.fluid_viscosity = dynamic_viscosity / setup.fluid_density;
      return true;
    }

    void
    accelerate(FluidStage<dim> &step) const override
    {
      step.viscosity = dynamic_viscosity;
    }

    void
    diffuse(FluidStage<dim> &step) const override
    {
      const auto timed = step.timing.section(this->name);
      momentum.solve(step, this->name, [&](Velocity<dim> &velocity) {
        step.pressure_correction = pressure_correction(step, velocity);
      });
    }

    typename Effect<dim>::Work
    work() const override
    {
      return {0, dim};
    }

    std::size_t
    memory_consumption(const FluidState<dim> &) const override
    {
      return momentum.memory_consumption();
    }

    bool
    needs_no_slip_surfaces() const override
    {
      return true;
    }

    Columns
    columns(const FluidModel<dim> &model,
            const FluidState<dim> &state,
            const double           time) const override
    {
      return force_columns("Viscous force",
                           model.boundaries(),
                           viscous_forces(model.boundaries(), state, dynamic_viscosity, time));
    }

    double
    power_of_sides(const FluidModel<dim> &model,
                   const FluidState<dim> &state,
                   const double           time) const override
    {
      return viscous_power(model.boundaries(), state, dynamic_viscosity, time);
    }

    void
    measure(typename Effect<dim>::Scales &scales, const FluidState<dim> &) const override
    {
      scales.viscosity = dynamic_viscosity;
    }

  private:
    /// -mu div w in every cell; in components of divided ones half of that, since there only less
    /// than 2/dim is sure to converge (Guermond, Minev & Shen 2006) [Pa]. Exchanges ghosts of w.
    Field<dim>
    pressure_correction(const FluidStage<dim> &step, Velocity<dim> &velocity) const
    {
      const auto      &model = step.model;
      const auto      &walls = step.tracer.bodies().walls;
      constexpr double share = 0.5, least_fraction = 0.01;
      exchange(velocity);
      auto        correction = divergence(model, velocity);
      const auto *divided    = correction.divided();
      for_each(correction.owned(), [&](const GridIndex<dim> &cell) {
        const bool is_whole = !divided || divided->kind(cell) == SubLattice<dim>::Kind::whole;
        correction(cell) *= is_whole ? -dynamic_viscosity / model.grid().cell_volume(cell) : 0.;
      });
      if (walls)
        for (const auto &patch : walls->patches)
          correction.parts()[patch.component] += patch.area * step.wall_velocities[patch.node];
      for (std::size_t c = 0; c < correction.parts().size(); ++c)
        {
          const auto  &component = divided->all()[c];
          const double volume =
            std::max(component.measure, least_fraction * model.grid().cell_volume(component.index));
          correction.parts()[c] *= -share * dynamic_viscosity / volume;
        }
      return correction;
    }


    double                        dynamic_viscosity = 0;
    mutable ImplicitMomentum<dim> momentum; ///< a cache
  };


  namespace
  {
    const RegisterForDimensions<Effect, Viscosity>
      registered_viscosity("viscosity", "Friction in the fluid and on its walls.");
  }
} // namespace undine
