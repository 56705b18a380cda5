// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/interruption.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/driver/failures.h>
#include <undine/output/checkpoint/checkpoint.h>

#include <fmt/format.h>

namespace undine
{
  namespace
  {
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
  } // namespace


  std::string
  undefined_values(const Options &options, const double since, const MPI_Comm communicator)
  {
    std::string complaints;
    for (const auto &complaint : options.undefined_values(since))
      complaints += complaint + "\n";
    return first_message(complaints, communicator);
  }


  std::string
  undefined_values(const Options &options,
                   const double   since,
                   const Error   &failure,
                   const MPI_Comm communicator)
  {
    const std::string complaints = undefined_values(options, since, communicator);
    return complaints.empty() ? "" : complaints + "What failed: " + failure.what();
  }


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


#define UNDINE_INSTANTIATE(dim)                              \
  template void run_keeping_last_state(State<dim> &,         \
                                       Scene<dim> &,         \
                                       const Options &,      \
                                       const Watch<dim> &,   \
                                       const ResultFolder &, \
                                       Log &,                \
                                       TimingTree &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
