// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_coupled_run_h
#define undine_tests_coupled_run_h

#include <undine/coupled/scheme/scheme.h>
#include <undine/solid/step/solid_columns.h>

#include <coupled/obstacle_run.h>

namespace undine_tests
{
  /// Energy and momentum of every step are balanced.
  inline const std::string budget = section("Output", "set Budget = true");


  /// Bodies, a fluid or both, step by step, by the scheme that the text names.
  template <int dim>
  struct CoupledRun
  {
    explicit CoupledRun(const std::string &text)
      : options(read_scene_text(text))
      , scheme(options.choose<Scheme<dim>>("Scheme", "simultaneous", ""))
    {
      if (options.section("Bodies").given())
        models.solid = std::make_unique<const SolidModel<dim>>(options, MPI_COMM_WORLD);
      if (options.section("Fluid").given())
        models.fluid = std::make_unique<const FluidModel<dim>>(options, MPI_COMM_WORLD);
      models.effects   = make_effects<dim>(options);
      models.direction = read_direction(options);
      if (models.fluid && (models.solid || options.section("Obstacles").given()))
        add_surface();
      options.assert_all_used();
      state.clock.end_time = 1e9;
      report               = scheme->initialize(state, models, timing);
    }

    void
    step()
    {
      report = scheme->step(state, scheme->choose_dt(state));
      state.clock.time += report.dt;
      ++state.clock.step;
    }

    double
    column(const std::string &name) const
    {
      for (const auto &column : report.columns)
        if (column.name == name)
          return column.value;
      FAIL("no column " << name);
      return 0;
    }

    void
    add_surface()
    {
      const auto &grid = models.fluid->grid();
      models.surface =
        std::make_unique<const ImmersedSurface<dim>>(options, models.solid.get(), grid);
      auto voids =
        std::make_unique<const VoidRegions<dim>>(options, grid, models.fluid->boundaries());
      if (!voids->empty())
        models.void_regions = std::move(voids);
    }

    const Options                options;
    std::unique_ptr<Scheme<dim>> scheme;
    Models<dim>                  models;
    TimingTree                   timing;
    State<dim>                   state;
    Report                       report;
  };


  inline std::string
  steps_of(const double dt)
  {
    return section("Time", fmt::format("set Step = {:.17g}", dt));
  }


  inline std::string
  body(const std::string &name, const std::string &keys, const std::string &boundaries = "")
  {
    return section(name, keys + "\n" + section("Boundaries", boundaries));
  }


  inline std::string
  clamp(const std::string &name, const std::string &where, const std::string &more = "")
  {
    return section(name, "set Kind = clamp\nset Where = " + where + "\n" + more);
  }
} // namespace undine_tests

#endif
