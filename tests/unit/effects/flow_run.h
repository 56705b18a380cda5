// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_flow_run_h
#define undine_tests_flow_run_h

#include <undine/effects/effect.h>
#include <undine/fluid/pressure/projection.h>

#include <fluid/fluid_scene.h>

namespace undine_tests
{
  /// The effects that the section `Effects` of a text calls for.
  template <int dim>
  Effects<dim>
  make_effects(const Options &options)
  {
    return read_effects<dim>(options.section("Effects"));
  }


  inline std::string
  viscosity(const double value)
  {
    return section("viscosity", fmt::format("set Dynamic viscosity = {}", value));
  }


  inline std::string
  convection(const std::string &method = "cubic")
  {
    return section("convection", "set Method = " + method);
  }


  inline std::string
  flux_form()
  {
    return section("convection", "set Form = flux");
  }


  /// "flux", or along paths by this method.
  inline std::string
  convection_by(const std::string &method)
  {
    return method == "flux" ? flux_form() : convection(method);
  }


  /// A fluid with effects, without bodies: the phases of a step in their order.
  template <int dim>
  struct FlowRun
  {
    FlowRun(const std::string &fluid,
            const std::string &effect_text,
            const MPI_Comm     communicator = MPI_COMM_WORLD)
      : options(read_scene_text(fluid + section("Effects", effect_text)))
      , model(options, communicator)
      , effects(make_effects<dim>(options))
      , projection(model)
      , state(model.initial_state())
    {
      options.assert_all_used();
      for (const auto &effect : effects)
        {
          effect->initialize(model, state);
          effect->affect(environment);
        }
      report = projection.make_divergence_free(state, 0);
    }

    void
    step(const double dt)
    {
      FluidStage<dim> fluid(model, state, environment.gravity, time, single_stage(dt), timing);
      for (const auto &effect : effects)
        effect->transport(fluid);
      for (const auto &effect : effects)
        effect->accelerate(fluid);
      for (const auto &effect : effects)
        effect->diffuse(fluid);
      time += dt;
      report = projection.project(state, fluid.tracer.velocity(), time, dt);
      fluid.finish();
    }

    void
    run(const unsigned int n_steps, const double dt)
    {
      for (unsigned int n = 0; n < n_steps; ++n)
        step(dt);
    }

    const Options                    options;
    const FluidModel<dim>            model;
    const Effects<dim>               effects;
    Projection<dim>                  projection;
    FluidState<dim>                  state;
    SolidEnvironment<dim>            environment;
    TimingTree                       timing;
    double                           time = 0;
    typename Projection<dim>::Report report;
  };


  /// Largest difference of a velocity component from a function of place, on this rank's faces.
  template <int dim, class Function>
  double
  largest_error(const Field<dim> &field, const Function &exact)
  {
    return largest_over(field.lattice(), [&](const GridIndex<dim> &index) {
      return std::abs(field(index) - exact(field.lattice().point(index)));
    });
  }
} // namespace undine_tests

#endif
