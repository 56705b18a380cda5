// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/effects/transport_form.h>
#include <undine/effects/transported_scalar.h>
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/advection/fill_unknown.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/scalars/scalar_step.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace undine
{
  /// Fields that the flow advects, such as smoke or temperature:
  ///
  ///     ds/dt + v.grad s = D Laplace(s) + q                                               (E4)
  ///
  /// either by fluxes from cell to cell, which conserve the integral of s (ScalarStep), or along
  /// the flow by the stages of the step (T10) with ds/dt = D Laplace(s) + q as the rate, of second
  /// order in time; in steps of one stage with the source in the middle and implicit diffusion, of
  /// first order. Along paths the integral of s drifts with the error of the interpolation.
  template <int dim>
  class ScalarTransport : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      form.add_options(
        options,
        "transport",
        "'flux': what there is of a field flows through the faces of cells, with no limit on the "
        "step, of second order as far as bounds allow: its integral is conserved, no value leaves "
        "the range of those around it, and diffusion works around bodies, too. 'along paths': "
        "values are brought along the paths of the fluid, by 'Method', which costs less. "
        "'automatic': 'flux' with the effect viscosity, if no 'Method' is given and there is no "
        "vorticity confinement, as for convection, else 'along paths'.");
      method = options.template choose<Advection<dim>>(
        "Method", "cubic", "How the fields are advected along paths.");
      for (const auto &name : options.named_sections("field"))
        {
          fields.push_back(std::make_unique<TransportedScalar<dim>>(name));
          fields.back()->add_options(options.section(name));
        }
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
                            "scalar transport needs a fluid, but the scene has none",
                            "Remove the section or add a section 'Fluid'.");
      if (fields.empty())
        throw options.error("",
                            "names no field to advect",
                            "Add a subsection with the field's name, such as 'subsection smoke'.");
      if (!around.fluid)
        return check_for_particles(options);
      for (const auto &field : fields)
        if (around.has_immersed_surfaces && field->diffusivity > 0 && !form.is_flux())
          throw options.section(field->name)
            .error("Diffusivity",
                   "diffusion around bodies and obstacles needs transport in flux form",
                   "Remove the key, or set 'Form = flux' in 'scalar transport'.");
      for (const auto &field : fields)
        check_field(options, *field, around.fluid->boundaries().all());
    }

    std::string
    summary() const override
    {
      std::string names;
      for (const auto &field : fields)
        names += (names.empty() ? "" : ", ") + field->name;
      return names;
    }

    std::vector<std::string>
    scalars() const override
    {
      std::vector<std::string> names;
      for (const auto &field : fields)
        names.push_back(field->name);
      return names;
    }

    std::vector<typename Effect<dim>::CarriedScalar>
    carried_scalars() const override
    {
      std::vector<typename Effect<dim>::CarriedScalar> result;
      for (const auto &field : fields)
        {
          const TransportedScalar<dim> *scalar = field.get();
          result.push_back({scalar->name, {}, {}, {}});
          auto &carried   = result.back();
          carried.initial = [scalar](const dealii::Point<dim> &place) {
            return scalar->initial.value(place, 0);
          };
          carried.entering = [scalar](const dealii::Point<dim> &place, const double time) {
            return scalar->entering_value(place, time);
          };
          if (!scalar->source.is_zero())
            carried.source = [scalar](const dealii::Point<dim> &place, const double time) {
              return scalar->source.value(place, time);
            };
        }
      return result;
    }

    /// They carry it with them, which asks nothing of their setup.
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

    void
    initialize(const FluidModel<dim> &model, FluidState<dim> &state) const override
    {
      for (const auto &field : fields)
        {
          Field<dim> values(model.grid().cells(), state.velocity[0].topology());
          for_each_value(values, [&](double &value, const auto &place, const auto &) {
            value = field->initial.value(place, 0);
          });
          set_means(values, model.grid());
          state.scalars[field->name] = values;
          if (field->changes() && !form.is_flux())
            state.scalar_rates[field->name] =
              Field<dim>(model.grid().cells(), state.velocity[0].topology());
        }
    }

    /// All terms of a stage, so that forces use the fields at its end.
    void
    transport(FluidStage<dim> &step) const override
    {
      const auto timed = step.timing.section(this->name);
      if (form.is_flux())
        transport_by_fluxes(step);
      else
        transport_along_paths(step);
    }

    typename Effect<dim>::Work
    work() const override
    {
      unsigned int implicit = 0;
      for (const auto &field : fields)
        implicit += form.is_flux() ? 3 : field->diffusivity > 0 ? 1 : 0;
      return {form.is_flux() ? 0 : static_cast<unsigned int>(fields.size()), implicit};
    }

    std::size_t
    memory_consumption(const FluidState<dim> &state) const override
    {
      std::size_t sum = 0;
      for (const auto &field : fields)
        {
          const auto values = state.scalars.find(field->name);
          if (values != state.scalars.end())
            sum += values->second.memory_consumption();
          const auto rates = state.scalar_rates.find(field->name);
          if (rates != state.scalar_rates.end())
            sum += rates->second.memory_consumption();
          if (field->equation)
            sum += field->equation->memory_consumption();
          sum += field->memory_of_sources();
        }
      return sum;
    }

    Columns
    columns(const FluidModel<dim> &model, const FluidState<dim> &state, double) const override
    {
      Columns columns;
      for (const auto &field : fields)
        columns.push_back({"Integral of " + field->name,
                           "m^" + std::to_string(dim),
                           integral(model, state.scalars.at(field->name))});
      return columns;
    }

  private:
    /// From the begin of the stage to its end, whatever the integrator.
    void
    transport_by_fluxes(FluidStage<dim> &step) const
    {
      if (!projection)
        projection = std::make_unique<Projection<dim>>(step.model);
      const ScalarFlow<dim> flow(step.tracer, *projection);
      ScalarStep<dim>       fluxes(flow);
      for (const auto &field : fields)
        {
          auto &values = step.state.scalars.at(field->name);
          values       = flow.at_start(values);
          if (flow.has_moved())
            fill_unknown(values, step.model, *field, step.time);
          typename ScalarStep<dim>::Source source;
          if (!field->source.is_zero())
            source = [&](const double time) {
              Field<dim> rate(values.shared_lattice(), values.topology());
              field->add_source(rate, time, 1.);
              return rate;
            };
          values = fluxes.advance(values, *field, field->diffusivity, source);
          set_means(values, step.model.grid());
        }
      step.linear_iterations += flow.iterations() + fluxes.iterations();
      step.timing.memory.hold_briefly(this->name,
                                      flow.memory_consumption() + fluxes.memory_consumption());
    }

    void
    transport_along_paths(FluidStage<dim> &step) const
    {
      for (const auto &field : fields)
        {
          auto                   &values = step.state.scalars.at(field->name);
          std::vector<Field<dim>> fields_to_advect;
          if (field->changes() && step.keeps_mean())
            fields_to_advect = {values, values};
          else
            fields_to_advect.push_back(std::move(values));
          if (field->changes() && step.stage.going_on() != 0)
            add(fields_to_advect.front(),
                step.stage.going_on(),
                step.state.scalar_rates.at(field->name));
          step.timing.memory.hold_briefly(
            this->name, fields_to_advect.size() * fields_to_advect.front().memory_consumption());
          const bool goes_on = field->changes() && step.stage.going_on() != 0;
          const auto going_on =
            goes_on
              ? step.going_on(fields_to_advect.size(), &step.state.scalar_rates.at(field->name))
              : GoingOn<dim>{std::vector<double>(fields_to_advect.size(), step.time)};
          auto advected =
            method->advect(step.tracer, std::move(fields_to_advect), going_on, *field);
          if (!field->changes())
            {
              values = std::move(advected.front());
              continue;
            }
          values = advected.front();
          change(*field, advected, step);
        }
    }

    /// Sources and diffusion, and the rate that is kept. `advected`: s^0 where the stage keeps
    /// rates, and then s^b if that rate is a mean.
    void
    change(const TransportedScalar<dim>  &field,
           const std::vector<Field<dim>> &advected,
           FluidStage<dim>               &step) const
    {
      auto        &values = step.state.scalars.at(field.name);
      const auto  &stage  = step.stage;
      const double at     = stage.keeps_rates() ? step.end : step.time + stage.duration() / 2;
      if (!field.source.is_zero())
        {
          field.add_source(values, at, stage.length);
          set_means(values, step.model.grid());
        }
      if (field.diffusivity > 0)
        {
          if (!field.equation)
            field.equation = std::make_unique<ImplicitDiffusion<dim>>(
              step.model, step.model.grid().cells(), field, field.diffusivity);
          step.linear_iterations += field.equation->step(values, step.end, stage.length);
        }
      auto &rate = step.state.scalar_rates.at(field.name);
      rate       = values;
      add(rate, -1., advected.back());
      add(rate, 1 / (step.keeps_mean() ? stage.duration() : stage.length) - 1, Field<dim>(rate));
    }

    static void
    check_name(const Options                  &options,
               const TransportedScalar<dim>   &field,
               const std::vector<std::string> &taken)
    {
      if (std::find(taken.begin(), taken.end(), field.name) != taken.end())
        throw options.error(field.name,
                            "is the name of another field of the fluid",
                            "Choose another name, such as 'smoke'.");
    }

    /// Particles do not exchange what they carry, with each other or with walls.
    void
    check_for_particles(const Options &options) const
    {
      const std::string hint = "Remove the key, or compute the scene on a grid: 'Scheme = "
                               "simultaneous'.";
      for (const auto &field : fields)
        {
          check_name(
            options, *field, {"velocity", "displacement", "pressure", "kind", "body", "identity"});
          const auto section = options.section(field->name);
          if (field->diffusivity > 0)
            throw section.error("Diffusivity",
                                "is not zero, but particles carry a scalar unmixed",
                                "Allowed: 0. " + hint);
          if (!field->dirichlet_boundaries.empty())
            throw section.error("Dirichlet boundaries",
                                "needs diffusion, but particles carry a scalar unmixed: nothing "
                                "goes over to them from a wall",
                                hint);
        }
    }

    static void
    check_field(const Options                    &options,
                const TransportedScalar<dim>     &field,
                const std::vector<Boundary<dim>> &boundaries)
    {
      check_name(options,
                 field,
                 {"velocity",
                  "pressure",
                  "vorticity_magnitude",
                  "component",
                  "fluid_fraction",
                  "nodes",
                  "cells"});
      std::string known;
      for (const auto &boundary : boundaries)
        known += (known.empty() ? "'" : ", '") + boundary.name + "'";
      for (const auto &name : field.dirichlet_boundaries)
        if (std::none_of(boundaries.begin(), boundaries.end(), [&](const auto &boundary) {
              return boundary.name == name;
            }))
          throw options.section(field.name)
            .error("Dirichlet boundaries",
                   "the fluid has no boundary named '" + name + "'",
                   "Allowed: " + known);
      const auto comes_in = [&](const Boundary<dim> &boundary) {
        return field.is_listed(boundary) &&
               (boundary.kind == BoundaryKind::inflow || boundary.is_open());
      };
      if (!field.dirichlet_boundaries.empty() && field.diffusivity == 0 &&
          std::none_of(boundaries.begin(), boundaries.end(), comes_in))
        throw options.section(field.name)
          .error("Dirichlet boundaries",
                 "has no effect: without diffusion nothing goes over to the fluid from a wall",
                 "Try: a 'Diffusivity' above zero, or remove the key.");
    }

    TransportForm                                        form;
    std::unique_ptr<Advection<dim>>                      method;
    mutable std::unique_ptr<Projection<dim>>             projection; ///< of the flow: a cache
    std::vector<std::unique_ptr<TransportedScalar<dim>>> fields;
  };


  namespace
  {
    const RegisterForDimensions<Effect, ScalarTransport>
      registered_scalar_transport("scalar transport",
                                  "Fields such as smoke and temperature move with the flow.");
  }
} // namespace undine
