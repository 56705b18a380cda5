// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/version.h>
#include <undine/coupled/budget/inertia.h>
#include <undine/driver/json_text.h>
#include <undine/driver/machine.h>
#include <undine/driver/run_summary.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    template <int dim>
    Certificate::Scope
    scope_of(const Models<dim> &models)
    {
      const auto &particles = models.particles;
      double      extent    = 0;
      bool is_closed = particles && !particles->has_openings() && particles->setup().n_moving == 0;
      for (unsigned int axis = 0; axis < dim && is_closed; ++axis) // else it falls again and again
        is_closed = !particles->setup().periodic[axis] || particles->setup().gravity[axis] == 0;
      if (models.fluid)
        for (unsigned int axis = 0; axis < dim; ++axis)
          extent = std::max(
            extent, models.fluid->grid().upper()[axis] - models.fluid->grid().lower()[axis]);
      return {inertia(models), is_closed, particles != nullptr, extent};
    }
  } // namespace


  template <int dim>
  RunSummary<dim>::RunSummary(const Scene<dim> &scene,
                              const Options    &options,
                              const Clock      &start,
                              const Report     &first)
    : scene(scene)
    , options(options)
    , start(start)
    , core_seconds_of_start(core_seconds())
    , splitting(first.splitting)
    , certificate(scope_of(scene.models))
  {
  }


  /// A value that is no number is larger than any.
  template <int dim>
  void
  RunSummary<dim>::raise(const std::string &kind, const std::string &meaning, const double value)
  {
    for (auto &[name, error] : errors)
      if (name == kind)
        {
          if (!(value <= error.value))
            error.value = value;
          return;
        }
    errors.emplace_back(kind, Largest{meaning, value});
  }


  /// The largest value of a column that the scene may not have.
  template <int dim>
  void
  RunSummary<dim>::observe_column(const Columns     &columns,
                                  const std::string &name,
                                  const std::string &kind,
                                  const std::string &meaning)
  {
    for (const auto &column : columns)
      if (column.name == name)
        raise(kind, meaning, std::abs(column.value));
  }


  template <int dim>
  void
  RunSummary<dim>::observe(const double time, const Report &report)
  {
    ++n_steps;
    certificate.observe(time, report);
    newton_iterations += report.newton_iterations;
    linear_iterations += report.linear_iterations;
    cuts += report.cuts;
    time_is_estimated = report.error_in_time.has_value();
    if (report.error_in_time)
      raise("time",
            "estimate, of all steps together, relative to how far the bodies have moved",
            *report.error_in_time);
    if (report.steady)
      raise("steady",
            "what fluid and bodies have changed by in the last 'Steady for', of what they are",
            *report.steady);
    if (scene.models.solid)
      raise("Newton",
            "forces that Newton's method leaves unbalanced, of all that it sums",
            report.newton_residual);
    observe_column(report.columns,
                   "Fluid divergence",
                   "mass",
                   "|div v| dx in a cell, of the fluid's largest speed");
    observe_column(
      report.columns,
      "Worst pressure residual",
      "pressure",
      "residual that the solver leaves between particles, of that which it began with");
    if (report.account && report.account->largest > 0)
      raise("energy created",
            "by all steps and not lost again, of the largest energy so far",
            report.account->created / report.account->largest);
    observe_column(
      report.columns, "energy closure", "energy", "what the terms of the energy balance leave");
    observe_column(
      report.columns, "momentum closure", "momentum", "what the terms of the momentum leave");
  }


  template <int dim>
  void
  RunSummary<dim>::print(Log &log, const double time) const
  {
    log.print("\nwhat the run knows of its own error, the largest in any step{}:",
              start.step > 0 ? fmt::format(" since step {}", start.step) : "");
    if (time_is_estimated && !*time_is_estimated)
      log.print("  {:<15} not estimated; {} tell",
                "time",
                scene.models.particles ? "runs with other spacings"
                                       : "shorter steps or 'Time / Tolerance'");
    for (const auto &[kind, error] : errors)
      log.print("  {:<15} {:.1e}  {}", kind, error.value, error.meaning);
    certificate.print(log, time, {});
  }


  template <int dim>
  void
  RunSummary<dim>::print_failure(Log &log, const double time, const End &end) const
  {
    if (has_steps())
      certificate.print(log, time, end.has_failed ? end.reason : "");
  }


  template <int dim>
  std::string
  RunSummary<dim>::costs() const
  {
    const auto   communicator = scene.models.communicator();
    const auto   now          = std::chrono::steady_clock::now();
    const double of_start     = dealii::Utilities::MPI::sum(core_seconds_of_start, communicator);
    const double whole        = dealii::Utilities::MPI::sum(core_seconds(), communicator);
    return fmt::format("{{\"wall seconds\": {:.6g}, \"core seconds\": {:.6g}, \"core seconds of "
                       "the start\": {:.6g}, \"peak memory [bytes]\": {:.0f}}}",
                       std::chrono::duration<double>(now - begin).count(),
                       whole - of_start,
                       of_start,
                       dealii::Utilities::MPI::sum(peak_memory(), communicator));
  }


  template <int dim>
  std::string
  RunSummary<dim>::unknowns() const
  {
    std::string result;
    const auto  add = [&](const std::string &name, const double number) {
      result += fmt::format("{}\"{}\": {:.0f}", result.empty() ? "" : ", ", name, number);
    };
    if (scene.models.solid)
      add("velocities of bodies", scene.models.solid->dof_handler().n_dofs());
    if (scene.models.fluid)
      add("cells of the fluid", scene.models.fluid->grid().n_cells());
    if (scene.models.particles)
      add("particles", scene.models.particles->n_particles());
    return "{" + result + "}";
  }


  /// All keys of the scene that are tolerances, with their values.
  template <int dim>
  std::string
  RunSummary<dim>::tolerances() const
  {
    std::string result;
    for (const auto &entry : options.entries())
      if (entry.key.find("olerance") != std::string::npos)
        result += (result.empty() ? "" : ", ") + quoted(entry.section + entry.key) + ": " +
                  quoted(entry.value);
    return "{" + result + "}";
  }


  /// Empty if the scene does not ask for it.
  template <int dim>
  std::string
  RunSummary<dim>::stability_of_splitting() const
  {
    if (!splitting)
      return "";
    return fmt::format("  \"stability of splitting\": {{\"added mass ratio\": {}, \"growth by "
                       "velocity\": {}, \"growth by displacement\": {}, \"growth of the run\": "
                       "{}}},\n",
                       json_number(splitting->added_mass_ratio),
                       json_number(splitting->growth_by_velocity),
                       json_number(splitting->growth_by_displacement),
                       splitting->growth_of_run ? json_number(*splitting->growth_of_run) : "null");
  }


  template <int dim>
  std::string
  RunSummary<dim>::json(const Clock &clock, const End &end) const
  {
    const auto known = json_list(errors, [](const auto &error) {
      return fmt::format("{{\"kind\": {}, \"largest\": {}, \"meaning\": {}}}",
                         quoted(error.first),
                         json_number(error.second.value),
                         quoted(error.second.meaning));
    });
    return fmt::format(
      "{{\n  \"program\": {},\n  \"title\": {},\n  \"scene\": {},\n  \"dimension\": {},\n"
      "  \"ranks\": {},\n  \"ended\": {},\n  \"failure\": {},\n  \"begin [s]\": {:.10g},\n"
      "  \"time [s]\": {:.10g},\n  \"end [s]\": {:.10g},\n  \"steps\": {},\n  \"step cuts\": {},\n"
      "  \"Newton iterations\": {},\n  \"linear iterations\": {},\n  \"unknowns\": {},\n"
      "  \"cost\": {},\n  \"tolerances\": {},\n  \"time is estimated\": {},\n  \"errors\": "
      "{},\n{}  \"certificate\": {}\n}}\n",
      quoted("undine " UNDINE_VERSION),
      quoted(scene.title),
      quoted(options.file().name()),
      dim,
      dealii::Utilities::MPI::n_mpi_processes(scene.models.communicator()),
      clock.ended(),
      quoted(end.reason),
      start.time,
      clock.time,
      clock.end_time,
      n_steps,
      cuts,
      newton_iterations,
      linear_iterations,
      unknowns(),
      costs(),
      tolerances(),
      time_is_estimated.value_or(false),
      known,
      stability_of_splitting(),
      certificate.json(clock.time, end.has_failed ? end.reason : ""));
  }


  template class RunSummary<2>;
  template class RunSummary<3>;
} // namespace undine
