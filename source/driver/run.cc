// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/interruption.h>
#include <undine/base/core/version.h>
#include <undine/driver/adviser.h>
#include <undine/driver/answers.h>
#include <undine/driver/effects_report.h>
#include <undine/driver/failures.h>
#include <undine/driver/log.h>
#include <undine/driver/report_page.h>
#include <undine/driver/run.h>
#include <undine/driver/run_directory.h>
#include <undine/driver/run_summary.h>
#include <undine/driver/size_check.h>
#include <undine/driver/time_loop.h>
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/columns_of_step.h>
#include <undine/output/files/schedule.h>
#include <undine/scene/scene.h>

#include <optional>

namespace undine
{
  namespace
  {
    /// What a run finds out about itself. The references must outlive it.
    template <int dim>
    struct Findings
    {
      const EffectsReport<dim> &effects;
      const Adviser<dim>       &adviser;
      const RunSummary<dim>    &summary;
      const TimingTree         &timing;
    };


    /// Leave what the run knows of itself so far, at its end or on the way, if that can be written:
    /// if not, there is more important news for the user, or the page about the run says less.
    template <int dim>
    void
    try_to_write(const Findings<dim>                 &findings,
                 ResultFolder                        &folder,
                 const Clock                         &clock,
                 const typename RunSummary<dim>::End &end,
                 const MPI_Comm                       communicator)
    {
      try
        {
          write_whole_file(folder, "summary.json", findings.summary.json(clock, end), communicator);
          write_whole_file(folder, "timing", timing_table(findings.timing), communicator);
          if (findings.summary.has_steps())
            write_whole_file(folder,
                             "effects.json",
                             findings.effects.json(findings.adviser.advice()),
                             communicator);
        }
      catch (const FileError &)
        {
          // See above.
        }
    }


    /// The last that there is to say about a run that has failed or was stopped.
    template <int dim>
    void
    conclude_failure(const Findings<dim> &findings,
                     ResultFolder        &folder,
                     const Clock         &clock,
                     const Error         &failure,
                     Log                 &log,
                     const MPI_Comm       communicator)
    {
      const bool is_stopped = dynamic_cast<const Interruption *>(&failure) != nullptr;
      const typename RunSummary<dim>::End end{failure.what(), !is_stopped};
      findings.summary.print_failure(log, clock.time, end);
      if (is_stopped && !findings.summary.has_steps())
        return; // what an earlier run knows of itself stays
      try_to_write(findings, folder, clock, end, communicator);
    }


    /// The same about one that has come to its end. One that went no step further keeps the files
    /// that it has.
    template <int dim>
    void
    conclude(const Findings<dim> &findings,
             ResultFolder        &folder,
             const Clock         &clock,
             Log                 &log,
             const MPI_Comm       communicator)
    {
      if (!findings.summary.has_steps())
        return;
      const auto advice = findings.adviser.advice();
      findings.effects.print_end(log, advice);
      findings.summary.print(log, clock.time);
      write_whole_file(folder, "effects.json", findings.effects.json(advice), communicator);
      write_whole_file(folder, "summary.json", findings.summary.json(clock, {}), communicator);
    }


    /// Write the page about a run that goes on, if it is time for that, and what it is made of.
    template <int dim>
    void
    refresh_page(ReportPage          &page,
                 const Findings<dim> &findings,
                 ResultFolder        &folder,
                 const Clock         &clock,
                 TimingTree          &timing,
                 const MPI_Comm       communicator)
    {
      if (!is_output_time(clock) || clock.ended() || !page.due())
        return;
      const auto timed = timing.section("report");
      try_to_write(findings, folder, clock, {}, communicator);
      page.write();
    }


    /// Replace an initialised state by that of the last checkpoint in `directory`.
    template <int dim>
    ResumedFrom
    take_up_again(State<dim>                  &state,
                  const Scene<dim>            &scene,
                  const std::filesystem::path &directory,
                  Log                         &log)
    {
      const auto from = read_checkpoint(directory, scene.models, state);
      for (const auto &reason : from.skipped)
        log.print("skipped a checkpoint: {}", reason);
      log.print("resumed at step {}, time {:.6g} s", state.clock.step, state.clock.time);
      if (state.clock.ended())
        log.print("note: the run has reached its end; a later one is set by --set Time/End=...");
      return from;
    }


    void
    print_remarks(const Options &options, const std::vector<std::string> &notes, Log &log)
    {
      for (const auto &remarks : {options.file().remarks(), notes})
        for (const auto &remark : remarks)
          log.print("note: {}", remark);
    }


    template <int dim>
    void
    start_outputs(const State<dim>         &state,
                  const Report             &first,
                  Scene<dim>               &scene,
                  const OutputContext<dim> &context)
    {
      for (auto &output : scene.outputs)
        {
          output->start(context, state);
          if (state.clock.step == 0 && output->due(state.clock))
            output->write(state, first);
        }
    }


    /// Where the results of a request go.
    std::filesystem::path
    results_folder(const Request &request, const std::filesystem::path &of_scene)
    {
      const bool resumed = request.action == Request::Action::resume;
      if (request.output.empty())
        return resumed ? std::filesystem::path(request.directory) : of_scene;
      const bool same = resumed && std::filesystem::weakly_canonical(request.output) ==
                                     std::filesystem::weakly_canonical(request.directory);
      return same ? request.directory : request.output;
    }


    /// What a probe cannot tell at the start is a mistake in the scene.
    template <int dim>
    void
    ask_probes_at_start(Report           &report,
                        const State<dim> &state,
                        const Scene<dim> &scene,
                        const Options    &options,
                        TimingTree       &timing)
    {
      try
        {
          ask_probes(report, state, scene, timing);
        }
      catch (const SolveError &error)
        {
          throw InputError(options.file().name() + ": " + error.what());
        }
      assert_different_names(state.clock, report, options.file().name());
    }


    /// The state at the start of a run. Throws InputError if an expression had no value where one
    /// was needed, be it only to find out where something is; SolveError if the state cannot be
    /// found and there is no such reason.
    template <int dim>
    Report
    start(State<dim> &state, Scene<dim> &scene, const Options &options, TimingTree &timing)
    {
      state.clock = scene.clock;
      try
        {
          auto report = scene.scheme->initialize(state, scene.models, timing);
          ask_probes_at_start(report, state, scene, options, timing);
          const auto complaint =
            undefined_values(options, state.clock.time, scene.models.communicator());
          if (!complaint.empty())
            throw InputError(complaint);
          return report;
        }
      catch (const SolveError &error)
        {
          const std::string complaint =
            undefined_values(options, state.clock.time, error, scene.models.communicator());
          if (complaint.empty())
            throw;
          throw InputError(complaint);
        }
    }


    /// What there is to say before the first step.
    void
    print_first(const Report &first, Log &log)
    {
      log.print_notes(first);
      if (first.splitting)
        log.print("{}", first.splitting->text());
    }


    /// Make state, folder and outputs ready for the first step, and report on the start. The folder
    /// is touched last: a run that cannot start, or be taken up again, leaves what is in it as it
    /// was.
    template <int dim>
    Report
    set_up(State<dim>    &state,
           Scene<dim>    &scene,
           const Options &options,
           const Request &request,
           ResultFolder  &folder,
           Log           &log,
           TimingTree    &timing,
           const MPI_Comm communicator)
    {
      const auto timed = timing.section("initialise");
      const auto first = start(state, scene, options, timing);

      const OutputContext<dim>   context{communicator, folder, scene.models, scene.probes, timing};
      std::optional<ResumedFrom> from;
      if (request.action == Request::Action::resume)
        {
          from = take_up_again(state, scene, request.directory, log);
          for (const auto &output : scene.outputs)
            output->assert_continues(context, state, first, *from);
        }
      prepare_directory(folder, options, from, communicator);
      log.open(folder.path(),
               from && from->directory == folder.path() ? std::ios::app : std::ios::trunc);
      print_first(first, log);
      start_outputs(state, first, scene, context);
      return first;
    }


    /// All that a run does before its first step, but nothing is built that the machine may have
    /// too little memory for.
    template <int dim>
    void
    validate(const Options &options, const Request &request, MPI_Comm communicator)
    {
      Log log(communicator);
      print_remarks(options, check_sections<dim>(options), log); // mistakes first
      const auto  size   = SizeCheck::of<dim>(options, communicator);
      std::string checks = "no mistakes found";
      if (size.may_be_too_large())
        checks += " in its sections; nothing was built, so whether meshes, places, boundaries and "
                  "probes fit each other was not checked";
      else
        {
          auto       scene = read_scene<dim>(options, communicator);
          State<dim> state;
          TimingTree timing;
          print_first(start(state, scene, options, timing), log);
        }
      size.print(log, request.output.empty() ? "." : request.output);
      log.print("{}: {}", options.file().name(), checks);
    }


    template <int dim>
    void
    simulate(Options options, const Request &request, MPI_Comm communicator)
    {
      TimingTree timing;
      Log        log(communicator);
      const auto notes = check_sections<dim>(options); // mistakes first
      const auto size  = SizeCheck::of<dim>(options, communicator);
      size.refuse_what_is_too_large();
      auto scene = read_scene<dim>(options, communicator);

      scene.directory = results_folder(request, scene.directory);
      ResultFolder folder(communicator, scene.directory);
      if (request.action != Request::Action::resume || scene.directory != request.directory)
        assert_replaceable(folder, request, communicator);
      print_header(log, scene, options, communicator);
      print_remarks(options, notes, log);
      size.print(log, scene.directory);
      State<dim>   state;
      const Report first =
        set_up(state, scene, options, request, folder, log, timing, communicator);
      print_unknowns(log, scene);
      const EffectsReport<dim> effects(scene, timing);
      Adviser<dim>             adviser(scene.models, state);
      effects.print_start(log);
      const bool goes_on_here =
        request.action == Request::Action::resume && scene.directory == request.directory;
      if (!goes_on_here)
        write_whole_file(folder, "effects.json", effects.json({}), communicator);
      RunSummary<dim>     summary(scene, options, state.clock, first);
      ReportPage          page(folder, scene.has_report, log, communicator);
      const Findings<dim> findings{effects, adviser, summary, timing};
      try
        {
          run_keeping_last_state(state,
                                 scene,
                                 options,
                                 {[&](const State<dim> &now, const Report &report) {
                                    adviser.observe(now, report);
                                    summary.observe(now.clock.time, report);
                                  },
                                  [&](const State<dim> &now) {
                                    refresh_page(
                                      page, findings, folder, now.clock, timing, communicator);
                                  }},
                                 folder,
                                 log,
                                 timing);
        }
      catch (const Error &failure)
        {
          conclude_failure(findings, folder, state.clock, failure, log, communicator);
          page.finish();
          throw;
        }
      write_checkpoint(folder.path(), scene.models, state, folder.statistics_digest);
      if (summary.has_steps())
        write_timing(folder, timing, log, communicator);
      conclude(findings, folder, state.clock, log, communicator);
      folder.finish();
      page.finish();
    }


    bool
    needs_scene(const Request &request)
    {
      return request.action == Request::Action::run || request.action == Request::Action::resume ||
             request.action == Request::Action::validate;
    }


    ParameterFile
    parameter_file(const Request &request)
    {
      const bool    resumed = request.action == Request::Action::resume;
      ParameterFile file(resumed ? request.directory + "/parameters.prm" : request.scene_file);
      for (const auto &assignment : request.assignments)
        if (resumed && assignment.rfind("Output/Directory", 0) == 0)
          throw InputError(
            "command line: a run that is resumed does not move by 'Output/Directory'. "
            "Try: '--output NEW', which goes on in another folder.");
        else
          file.set(assignment);
      // The copy of the scene in the folder of the run must find the same files.
      file.set("Folder of files=" +
               std::filesystem::absolute("." / file.folder()).lexically_normal().string());
      return file;
    }
  } // namespace


  void
  execute(const Request &request, const MPI_Comm communicator)
  {
    if (!needs_scene(request))
      {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          answer(request);
        return;
      }
    const auto options   = Options::collecting(parameter_file(request));
    const bool validates = request.action == Request::Action::validate;
    if (read_dimension(options) == 2)
      validates ? validate<2>(options, request, communicator)
                : simulate<2>(options, request, communicator);
    else
      validates ? validate<3>(options, request, communicator)
                : simulate<3>(options, request, communicator);
  }
} // namespace undine
