// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/output.h>

#include <chrono>

namespace undine
{
  /// Checkpoints during a run, by steps and by wall time; the driver writes another one at its end,
  /// good or bad, and when the run is stopped.
  template <int dim>
  class CheckpointOutput : public Output<dim>
  {
  public:
    void
    add_options(const Options &output) override
    {
      const auto options = output.section("checkpoint");
      options.add("Interval",
                  interval,
                  "",
                  Allowed::positive(),
                  "Steps between checkpoints: a run that is killed loses at most so many.");
      options.add("Wall time interval",
                  wall_interval,
                  "s",
                  Allowed::not_negative(),
                  "There is also a checkpoint after so many seconds of computing since the last "
                  "one. 0: only by steps.");
    }

    void
    start(const OutputContext<dim> &new_context, const State<dim> &) override
    {
      context = std::make_unique<const OutputContext<dim>>(new_context);
      last    = Clockwork::now();
    }

    bool
    due(const Clock &clock) const override
    {
      if (clock.step == 0 || clock.ended())
        return false;
      const double passed = std::chrono::duration<double>(Clockwork::now() - last).count();
      const bool   late   = wall_interval > 0 && passed >= wall_interval;
      // All ranks go by the watch of the first.
      return dealii::Utilities::MPI::broadcast(context->communicator, late) ||
             clock.step % interval == 0;
    }

    void
    write(const State<dim> &state, const Report &) override
    {
      const auto timed = context->timing.section("checkpoint");
      write_checkpoint(
        context->folder.path(), context->models, state, context->folder.statistics_digest);
      last = Clockwork::now();
    }

  private:
    using Clockwork = std::chrono::steady_clock;

    unsigned int                              interval      = 10;  // [steps]
    double                                    wall_interval = 600; // [s]
    Clockwork::time_point                     last;
    std::unique_ptr<const OutputContext<dim>> context;
  };


  namespace
  {
    const RegisterForDimensions<Output, CheckpointOutput>
      checkpoint("checkpoint", "whole states in alternating slots, to resume from");
  }
} // namespace undine
