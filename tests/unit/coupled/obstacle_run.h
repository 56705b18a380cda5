// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_obstacle_run_h
#define undine_tests_obstacle_run_h

#include <undine/coupled/step/fluid_alone.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>

namespace undine_tests
{
  template <int dim>
  Models<dim>
  make_models(const Options &options)
  {
    Models<dim> models;
    models.fluid   = std::make_unique<const FluidModel<dim>>(options, MPI_COMM_WORLD);
    models.effects = make_effects<dim>(options);
    models.surface =
      std::make_unique<const ImmersedSurface<dim>>(options, nullptr, models.fluid->grid());
    options.assert_all_used();
    return models;
  }


  /// A fluid among obstacles, step by step.
  template <int dim>
  struct ObstacleRun
  {
    ObstacleRun(const std::string &fluid,
                const std::string &obstacles,
                const std::string &effects,
                const double       dt)
      : options(
          read_scene_text(fluid + section("Obstacles", obstacles) + section("Effects", effects)))
      , models(make_models<dim>(options))
      , budget(models, KeepBudget::no)
      , scheme(models, budget, timing)
      , dt(dt)
    {
      scheme.initialize(state, dt, report);
    }

    void
    step()
    {
      report    = Report();
      report.dt = dt;
      scheme.solve_stage(state, single_stage(report.dt), report);
      ++state.clock.step;
      state.clock.time = state.clock.step * dt;
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

    /// Along all axes.
    dealii::Tensor<1, dim>
    column_vector(const std::string &name) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] = column(name + " " + "xyz"[axis]);
      return result;
    }

    const Surface<dim> &
    surface() const
    {
      return models.surface->surface();
    }

    std::vector<dealii::Point<dim>>
    positions() const
    {
      return models.surface->positions(state.solid, state.clock.time);
    }

    const Options   options;
    Models<dim>     models;
    TimingTree      timing;
    Budget<dim>     budget;
    FluidAlone<dim> scheme;
    State<dim>      state;
    Report          report;
    const double    dt;
  };


  /// Over all values on open faces and pieces of this rank: `measure(value, place, axis)`.
  template <int dim, class Measure>
  double
  largest_on_faces(const Velocity<dim> &velocity, const Measure &measure)
  {
    double result = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each_value(velocity[axis], [&](const double value, const auto &place, const auto &) {
        result = std::max(result, measure(value, place, axis));
      });
    return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
  }


  /// Over all values in cells and components of this rank: `measure(value, place)`.
  template <int dim, class Measure>
  double
  largest_in_cells(const Field<dim> &field, const Measure &measure)
  {
    double result = 0;
    for_each_value(field, [&](const double value, const auto &place, const auto &) {
      result = std::max(result, measure(value, place));
    });
    return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
  }


  inline std::string
  obstacle(const std::string &name, const std::string &shape, const std::string &keys)
  {
    return section(name, "set Shape = " + shape + "\n" + keys + "\n");
  }


  /// One text for two dimensions, one for three.
  template <int dim>
  std::string
  plane_or_space(const std::string &plane, const std::string &space)
  {
    return dim == 2 ? plane : space;
  }


  /// A stream along x through the unit box, from the left side to the right one.
  template <int dim>
  std::string
  stream_to_the_right(const std::string &cells, const double density, const double speed)
  {
    const std::string right = fmt::format(plane_or_space<dim>("{}; 0", "{}; 0; 0"), speed);
    return section("Domain", "set Cells = " + cells) +
           section("Fluid",
                   fmt::format("set Density = {}\nset Initial velocity = {}\n", density, right) +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow")));
  }
} // namespace undine_tests

#endif
