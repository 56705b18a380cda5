// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/interruption.h>
#include <undine/base/core/version.h>
#include <undine/base/options/options_output.h>
#include <undine/base/parallel/interruption.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/coupled/step/physics.h>
#include <undine/driver/adviser.h>
#include <undine/driver/effects_report.h>
#include <undine/driver/log.h>
#include <undine/driver/measured_costs.h>
#include <undine/driver/progress.h>
#include <undine/driver/report_page.h>
#include <undine/driver/run.h>
#include <undine/driver/run_directory.h>
#include <undine/driver/run_summary.h>
#include <undine/driver/size_check.h>
#include <undine/driver/study_file.h>
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/files/schedule.h>
#include <undine/scene/scene.h>

#include <functional>
#include <iostream>
#include <optional>
#include <sstream>

namespace undine
{
  namespace
  {
    /// What watches a run.
    template <int dim>
    struct Watch
    {
      std::function<void(const State<dim> &, const Report &)> step;    ///< has led to the state
      std::function<void(const State<dim> &)>                 outputs; ///< have been written
    };


    template <int dim>
    void
    write_outputs(const State<dim> &state,
                  const Report     &report,
                  Scene<dim>       &scene,
                  TimingTree       &timing)
    {
      const auto timed = timing.section("output");
      for (auto &output : scene.outputs)
        if (output->due(state.clock))
          output->write(state, report);
    }


    /// What the probes measure of the new state joins what the models did.
    template <int dim>
    void
    ask_probes(Report &report, const State<dim> &state, const Scene<dim> &scene, TimingTree &timing)
    {
      const auto timed = timing.section("measure");
      for (const auto &probe : scene.probes)
        append(report.columns, probe->columns(scene.models, state));
    }


    /// The whole of a simulation. `state` is at its first time, initial or resumed.
    template <int dim>
    void
    run_time_loop(
      State<dim> &state, Scene<dim> &scene, const Watch<dim> &watch, Log &log, TimingTree &timing)
    {
      Progress      progress(log, state.clock);
      MeasuredCosts costs(log, state.clock, scene.models.communicator());
      scene.scheme->follow([&](const std::string &how_far) {
        progress.within_step(how_far);
        return !interruption_requested();
      });
      listen_for_interruption();
      while (!state.clock.ended())
        {
          throw_if_interrupted(scene.models.communicator());
          const double dt     = scene.scheme->choose_dt(state);
          Report       report = scene.scheme->step(state, dt);
          state.clock.advance(report.dt); // what was accepted; retries happen inside step
          ask_probes(report, state, scene, timing);
          if (report.steady)
            state.clock.end_time = state.clock.time;
          watch.step(state, report);
          write_outputs(state, report, scene, timing);
          watch.outputs(state);
          progress.report(state.clock, report);
          costs.observe(state.clock);
          if (report.steady)
            log.print("steady: of late fluid and bodies have changed by {:.2g} of what they are",
                      *report.steady);
        }
    }


    /// Write the state as a checkpoint; returns what to tell the user about it. `settings`: those
    /// to resume with.
    template <int dim>
    std::string
    keep_last_state(const State<dim>   &state,
                    const Scene<dim>   &scene,
                    const ResultFolder &folder,
                    const std::string  &settings)
    {
      try
        {
          write_checkpoint(folder.path(), scene.models, state, folder.statistics_digest);
          return fmt::format("The state before it is kept; 'undine resume {}{}' continues it.",
                             folder.path().string(),
                             settings);
        }
      catch (const Error &error)
        {
          return std::string("The state before it could not be kept: ") + error.what();
        }
    }


    /// Keep the state before the step that was not completed; returns what to tell the user, which
    /// is also logged, after `heading`.
    template <int dim>
    std::string
    failure_report(const Error        &error,
                   const State<dim>   &state,
                   const Scene<dim>   &scene,
                   const ResultFolder &folder,
                   Log                &log,
                   const std::string  &heading  = "Error: ",
                   const std::string  &settings = " --set \"Section/Key=value\"")
    {
      const std::string message = fmt::format("step {}, which begins at {:.6g} s: {}\n{}",
                                              state.clock.step + 1,
                                              state.clock.time,
                                              error.what(),
                                              keep_last_state(state, scene, folder, settings));
      log.record("\n" + heading + message + "\n");
      return message;
    }


    /// About expressions of the scene that had no finite value at `since` [s] or later; empty if all
    /// had. Collective.
    std::string
    undefined_values(const Options &options, const double since, const MPI_Comm communicator)
    {
      std::string complaints;
      for (const auto &complaint : options.undefined_values(since))
        complaints += complaint + "\n";
      return first_message(complaints, communicator);
    }


    /// The same with the failure that may follow from it.
    std::string
    undefined_values(const Options &options,
                     const double   since,
                     const Error   &failure,
                     const MPI_Comm communicator)
    {
      const std::string complaints = undefined_values(options, since, communicator);
      return complaints.empty() ? "" : complaints + "What failed: " + failure.what();
    }


    /// A failed run keeps its last good state: it can be looked at, and resumed with other
    /// settings. So does one that is stopped.
    template <int dim>
    void
    run_keeping_last_state(State<dim>         &state,
                           Scene<dim>         &scene,
                           const Options      &options,
                           const Watch<dim>   &watch,
                           const ResultFolder &folder,
                           Log                &log,
                           TimingTree         &timing)
    {
      try
        {
          run_time_loop(state, scene, watch, log, timing);
        }
      catch (const FileError &error)
        {
          log.record(std::string("\nError: ") + error.what() + "\n");
          throw;
        }
      catch (const Interruption &error)
        {
          throw Interruption(failure_report(error, state, scene, folder, log, "", ""));
        }
      catch (const InputError &error)
        {
          throw InputError(failure_report(error, state, scene, folder, log));
        }
      catch (const Error &error)
        {
          const std::string complaint =
            undefined_values(options, state.clock.time, error, scene.models.communicator());
          if (!complaint.empty())
            throw InputError(failure_report(InputError(complaint), state, scene, folder, log));
          throw SolveError(failure_report(error, state, scene, folder, log));
        }
    }


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
          const auto report = scene.scheme->initialize(state, scene.models, timing);
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
      Report     first = start(state, scene, options, timing);
      ask_probes(first, state, scene, timing);

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
      write_timing(folder, timing, log, communicator);
      conclude(findings, folder, state.clock, log, communicator);
      folder.finish();
      page.finish();
    }


    /// The parameters of every part of a scene.
    Options
    all_of_scenes()
    {
      auto options = Options::for_reference();
      declare_scene<3>(options);
      declare_scene<2>(options); // adds the few keys that only plane scenes have
      return options;
    }


    void
    print_reference_of(const std::string &section)
    {
      if (!write_reference_of(std::cout, all_of_scenes(), section))
        throw InputError("no section of a scene is called '" + section +
                         "'. Try one of those that 'undine --reference' lists, or a part of its "
                         "path, such as 'Output', 'Output/vtu' or 'viscosity'.");
    }


    void
    print_reference()
    {
      const auto options = all_of_scenes();
      std::cout << "# Parameters\n\nGenerated by `undine --reference`. `<name>` stands for a name "
                   "that the scene chooses;\nan *italic condition* says when a key exists. "
                   "Vectors are listed with three numbers; plane scenes give\ntwo.\n";
      write_reference(std::cout, options);
      std::cout << "\n# Parameters of studies\n\nOf `./undine study STUDY.prm`, see "
                   "[studies](studies.md).\n";
      const auto study = Options::for_reference();
      read_study(study);
      write_reference(std::cout, study);
    }


    void
    print_study(const std::string &file)
    {
      const auto options = Options::collecting(ParameterFile(file));
      read_study(options);
      options.assert_all_used();
      options.throw_mistakes();
      write_json(std::cout, options);
    }


    void
    print_parameters(const Request &request)
    {
      ParameterFile file(request.scene_file);
      for (const auto &assignment : request.assignments)
        file.set(assignment);
      const auto options = Options::collecting(file);
      if (read_dimension(options) == 2)
        check_sections<2>(options);
      else
        check_sections<3>(options);
      write_json(std::cout, options);
    }


    /// A line for each line "x y z t" of the standard input.
    void
    print_values(const std::string &text)
    {
      const Expression<3> expression(text);
      std::string         line;
      for (unsigned int number = 1; std::getline(std::cin, line); ++number)
        {
          std::istringstream numbers(line);
          if ((numbers >> std::ws).eof()) // an empty line
            continue;
          dealii::Point<3> place;
          double           time = 0;
          if (!(numbers >> place[0] >> place[1] >> place[2] >> time) || !(numbers >> std::ws).eof())
            throw InputError(
              fmt::format("line {} of the standard input, '{}', is not four numbers.\n"
                          "  Allowed: x y z [m] and t [s], separated by spaces.",
                          number,
                          line));
          std::cout << fmt::format("{:.17g}\n", expression.value(place, time));
        }
    }


    bool
    needs_scene(const Request &request)
    {
      return request.action == Request::Action::run || request.action == Request::Action::resume ||
             request.action == Request::Action::validate;
    }


    /// What needs no scene.
    void
    answer(const Request &request)
    {
      if (request.action == Request::Action::reference)
        request.section.empty() ? print_reference() : print_reference_of(request.section);
      else if (request.action == Request::Action::parameters)
        print_parameters(request);
      else if (request.action == Request::Action::study)
        print_study(request.scene_file);
      else if (request.action == Request::Action::evaluate)
        print_values(request.expression);
    }


    ParameterFile
    parameter_file(const Request &request)
    {
      const bool    resumed = request.action == Request::Action::resume;
      ParameterFile file(resumed ? request.directory + "/parameters.prm" : request.scene_file);
      for (const auto &assignment : request.assignments)
        file.set(assignment);
      // The copy of the scene in the folder of the run must find the same files.
      if (file.find("Folder of files") == nullptr)
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
