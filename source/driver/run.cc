// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/version.h>
#include <undine/coupled/fluid_geometry.h>
#include <undine/driver/effects_report.h>
#include <undine/driver/log.h>
#include <undine/driver/measured_costs.h>
#include <undine/driver/progress.h>
#include <undine/driver/run.h>
#include <undine/driver/run_directory.h>
#include <undine/driver/size_check.h>
#include <undine/output/checkpoint.h>
#include <undine/scene/scene.h>

#include <iostream>
#include <sstream>

namespace undine
{
  namespace
  {
    /// The whole of a simulation. `state` is at its first time, initial or resumed.
    template <int dim>
    void
    run_time_loop(
      State<dim> &state, Scene<dim> &scene, Adviser<dim> &adviser, Log &log, TimingTree &timing)
    {
      Progress      progress(log, state.clock);
      MeasuredCosts costs(log, state.clock, scene.models.communicator());
      scene.scheme->follow([&](const std::string &how_far) {
        progress.within_step(how_far);
        return true;
      });
      while (!state.clock.ended())
        {
          const double dt     = scene.scheme->choose_dt(state);
          const Report report = scene.scheme->step(state, dt);
          state.clock.advance(report.dt); // what was accepted; retries happen inside step
          adviser.observe(state, report);
          const auto timed = timing.section("output");
          for (auto &output : scene.outputs)
            if (output->due(state.clock))
              output->write(state, report);
          progress.report(state.clock, report);
          costs.observe(state.clock);
        }
    }


    /// Write the state as a checkpoint; returns what to tell the user about it.
    template <int dim>
    std::string
    keep_last_state(const State<dim> &state, const Scene<dim> &scene)
    {
      try
        {
          write_checkpoint(scene.directory, scene.models, state);
          return "The state before it is kept; 'undine resume " + scene.directory.string() +
                 " --set \"Section/Key=value\"' continues it.";
        }
      catch (const Error &error)
        {
          return std::string("The state before it could not be kept: ") + error.what();
        }
    }


    /// Keep the state before the step that failed; returns what to tell the user, which is also
    /// logged.
    template <int dim>
    std::string
    last_words(const Error &error, const State<dim> &state, const Scene<dim> &scene, Log &log)
    {
      const std::string message = fmt::format("step {}, which begins at {:.6g} s: {}\n{}",
                                              state.clock.step + 1,
                                              state.clock.time,
                                              error.what(),
                                              keep_last_state(state, scene));
      log.record("\nError: " + message + "\n");
      return message;
    }


    /// A failed run keeps its last good state: it can be looked at, and resumed with other
    /// settings.
    template <int dim>
    void
    run_keeping_last_state(
      State<dim> &state, Scene<dim> &scene, Adviser<dim> &adviser, Log &log, TimingTree &timing)
    {
      try
        {
          run_time_loop(state, scene, adviser, log, timing);
        }
      catch (const FileError &error)
        {
          log.record(std::string("\nError: ") + error.what() + "\n");
          throw;
        }
      catch (const InputError &error)
        {
          throw InputError(last_words(error, state, scene, log));
        }
      catch (const Error &error)
        {
          throw SolveError(last_words(error, state, scene, log));
        }
    }


    template <int dim>
    void
    start_outputs(const State<dim> &state,
                  const Report     &first,
                  Scene<dim>       &scene,
                  TimingTree       &timing,
                  MPI_Comm          communicator)
    {
      const OutputContext<dim> context{
        communicator, scene.directory, scene.models, scene.probes, timing};
      for (auto &output : scene.outputs)
        {
          output->start(context, state);
          if (state.clock.step == 0 && output->due(state.clock))
            output->write(state, first);
        }
    }


    /// Replace an initialised state by that of the last checkpoint.
    template <int dim>
    void
    take_up_again(State<dim> &state, const Scene<dim> &scene, Log &log)
    {
      const auto from = read_checkpoint(scene.directory, scene.models, state);
      for (const auto &reason : from.skipped)
        log.print("skipped a checkpoint: {}", reason);
      log.print("resumed at step {}, time {:.6g} s", state.clock.step, state.clock.time);
    }


    /// Nothing is built that the machine may have too little memory for.
    template <int dim>
    void
    validate(const Options &options, const Request &request, MPI_Comm communicator)
    {
      Log         log(communicator);
      const auto  size   = SizeCheck::of<dim>(options, communicator);
      std::string checks = "no mistakes found";
      if (size.may_be_too_large())
        {
          check_sections<dim>(options);
          checks +=
            " in its sections; nothing was built, so whether meshes, places, boundaries and "
            "probes fit each other was not checked";
        }
      else
        {
          const auto scene     = read_scene<dim>(options, communicator);
          const auto complaint = complaint_at_start(scene.models);
          if (!complaint.empty())
            log.print("note: {}", complaint);
        }
      size.print(log, request.directory.empty() ? "." : request.directory);
      log.print("{}: {}", options.file().name(), checks);
    }


    template <int dim>
    void
    simulate(Options options, const Request &request, MPI_Comm communicator)
    {
      TimingTree timing;
      Log        log(communicator);
      const auto size = SizeCheck::of<dim>(options, communicator);
      if (size.may_be_too_large())
        check_sections<dim>(options); // mistakes first
      size.refuse_what_is_too_large();
      auto scene = read_scene<dim>(options, communicator);
      if (!request.directory.empty())
        scene.directory = request.directory;

      // The folder is touched last: a scene that cannot start leaves an earlier run as it was.
      const bool resumed = request.action == Request::Action::resume;
      print_header(log, scene, options, communicator);
      size.print(log, scene.directory);
      State<dim> state;
      {
        const auto timed   = timing.section("initialise");
        state.clock        = scene.clock;
        const Report first = scene.scheme->initialize(state, scene.models, timing);
        if (resumed)
          take_up_again(state, scene, log);
        prepare_directory(scene.directory, options, resumed, communicator);
        log.open(scene.directory, resumed ? std::ios::app : std::ios::trunc);
        if (!first.note.empty())
          log.print("note: {}", first.note);
        start_outputs(state, first, scene, timing, communicator);
      }
      print_unknowns(log, scene);
      const EffectsReport<dim> effects(scene, timing);
      Adviser<dim>             adviser(scene.models, state);
      const auto               file = scene.directory / "effects.json";
      effects.print_start(log);
      write_whole_file(file, effects.json({}), communicator);
      run_keeping_last_state(state, scene, adviser, log, timing);
      write_checkpoint(scene.directory, scene.models, state);
      write_timing(scene.directory, timing, log, communicator);
      const auto advice = adviser.advice();
      effects.print_end(log, advice);
      write_whole_file(file, effects.json(advice), communicator);
    }


    void
    print_reference()
    {
      const auto options = Options::for_reference();
      declare_scene<3>(options);
      declare_scene<2>(options); // adds the few keys that only plane scenes have
      std::cout << "# Parameters\n\nGenerated by `undine --reference`. `<name>` stands for a name "
                   "that the scene chooses;\nan *italic condition* says when a key exists. "
                   "Vectors are listed with three numbers; plane scenes give\ntwo.\n";
      options.write_reference(std::cout);
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
    if (request.action == Request::Action::nothing)
      return;
    if (request.action == Request::Action::reference)
      {
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          print_reference();
        return;
      }
    const Options options(parameter_file(request));
    const bool    validates = request.action == Request::Action::validate;
    if (read_dimension(options) == 2)
      validates ? validate<2>(options, request, communicator)
                : simulate<2>(options, request, communicator);
    else
      validates ? validate<3>(options, request, communicator)
                : simulate<3>(options, request, communicator);
  }
} // namespace undine
