// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>
#include <undine/driver/effects_report.h>
#include <undine/driver/json_text.h>
#include <undine/driver/size_check.h>
#include <undine/particles/execution/phases.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  EffectsReport<dim>::EffectsReport(const Scene<dim> &scene, const TimingTree &timing)
    : timing(timing)
    , communicator(scene.models.communicator())
  {
    add_effects(scene);
    add_implied_effects(scene);
    std::stable_sort(
      rows.begin(), rows.end(), [](const Row &a, const Row &b) { return a.is_on > b.is_on; });
    for (auto &row : rows)
      row.start_bytes =
        dealii::Utilities::MPI::sum(double(timing.memory.of(row.name).now), communicator);
  }


  template <int dim>
  void
  EffectsReport<dim>::add_effects(const Scene<dim> &scene)
  {
    const auto &registry = Registry<Effect<dim>>::instance();
    const auto &effects  = scene.models.effects;
    // Particles have no phase of each force: all are computed in one pass.
    const std::string of_particles = name_of(particles::Phase::forces);
    for (const auto &name : registry.names())
      {
        const auto found = std::find_if(
          effects.begin(), effects.end(), [&](const auto &effect) { return effect->name == name; });
        if (found == effects.end())
          rows.push_back(
            {name, false, "no subsection 'Effects / " + name + "'", registry.help(name), {name}});
        else
          rows.push_back(
            {name,
             true,
             "Effects / " + name + ": " +
               (scene.models.particles ? (*found)->summary_of_particles() : (*found)->summary()),
             registry.help(name),
             {scene.models.particles && (*found)->is_in_passes() ? of_particles : name}});
      }
  }


  template <int dim>
  void
  EffectsReport<dim>::add_implied_effects(const Scene<dim> &scene)
  {
    const auto &registry = Registry<ImpliedEffect<dim>>::instance();
    for (const auto &name : registry.names())
      {
        const auto effect = registry.make(name);
        const auto call   = effect->call(scene.models);
        rows.push_back({name, call.is_on, call.why, registry.help(name), effect->phases()});
      }
  }


  template <int dim>
  typename EffectsReport<dim>::Cost
  EffectsReport<dim>::cost(const Row &row) const
  {
    Cost result;
    if (!row.is_on)
      return result;
    for (const auto &phase : row.phases)
      {
        const auto work = timing.work_of(phase);
        result.seconds += work.seconds;
        result.calls += work.calls;
      }
    result.seconds = dealii::Utilities::MPI::max(result.seconds, communicator);
    result.peak_bytes =
      dealii::Utilities::MPI::sum(double(timing.memory.of(row.name).peak), communicator);
    return result;
  }


  template <int dim>
  void
  EffectsReport<dim>::print_start(Log &log) const
  {
    log.print("\n{:<22} {:<3} {:>9}  why", "effect", "", "memory");
    for (const auto &row : rows)
      log.print("{:<22} {:<3} {:>9}  {}",
                row.name,
                row.is_on ? "on" : "off",
                row.is_on ? readable_bytes(row.start_bytes) : "",
                row.why);
  }


  template <int dim>
  void
  EffectsReport<dim>::print_end(Log &log, const Advice &advice) const
  {
    log.print("\n{:<22} {:>9} {:>11} {:>12}", "effect", "calls", "seconds", "peak memory");
    for (const auto &row : rows)
      if (row.is_on)
        {
          const auto spent = cost(row);
          log.print("{:<22} {:>9} {:>11.4f} {:>12}",
                    row.name,
                    spent.calls,
                    spent.seconds,
                    readable_bytes(spent.peak_bytes));
        }
    for (const auto &remark : advice.remarks)
      log.print("advice: '{}' is {} and {}: {} = {:.3g}; {}",
                remark.effect,
                remark.is_on ? "on" : "off",
                remark.is_on ? "does not matter" : "would matter",
                remark.number,
                remark.value,
                remark.rule);
    for (const auto &name : advice.missing)
      log.print("advice: no step had a column '{}'; what follows from it was not judged", name);
  }


  template <int dim>
  std::string
  EffectsReport<dim>::json(const Advice &advice) const
  {
    double whole = 0;
    for (const auto &phase : timing.root().children)
      whole += phase->seconds;
    const auto effects = json_list(rows, [&](const Row &row) {
      const auto  spent = cost(row);
      std::string phases;
      for (const auto &phase : row.phases)
        phases += (phases.empty() ? "" : ", ") + quoted(phase);
      return fmt::format("{{\"name\": {}, \"on\": {}, \"why\": {}, \"rule\": {}, "
                         "\"phases\": [{}], \"calls\": {}, \"seconds\": {:.6f}, "
                         "\"bytes at start\": {:.0f}, \"peak bytes\": {:.0f}}}",
                         quoted(row.name),
                         row.is_on,
                         quoted(row.why),
                         quoted(row.rule),
                         phases,
                         spent.calls,
                         spent.seconds,
                         row.start_bytes,
                         spent.peak_bytes);
    });
    const auto numbers = json_list(advice.numbers, [](const Advice::Number &number) {
      return fmt::format("{{\"name\": {}, \"value\": {}, \"meaning\": {}}}",
                         quoted(number.name),
                         json_number(number.value),
                         quoted(number.meaning));
    });
    const auto remarks = json_list(advice.remarks, [](const Advice::Remark &remark) {
      return fmt::format("{{\"effect\": {}, \"on\": {}, \"matters\": {}, \"number\": {}, "
                         "\"value\": {}, \"rule\": {}}}",
                         quoted(remark.effect),
                         remark.is_on,
                         !remark.is_on,
                         quoted(remark.number),
                         json_number(remark.value),
                         quoted(remark.rule));
    });
    const auto missing = json_list(advice.missing, quoted);
    return fmt::format("{{\n  \"ranks\": {},\n  \"seconds\": {:.6f},\n  \"effects\": {},\n"
                       "  \"numbers\": {},\n  \"advice\": {},\n  \"columns not found\": {}\n}}\n",
                       dealii::Utilities::MPI::n_mpi_processes(communicator),
                       whole,
                       effects,
                       numbers,
                       remarks,
                       missing);
  }


  template class EffectsReport<2>;
  template class EffectsReport<3>;
} // namespace undine
