// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint.h>
#include <undine/output/output.h>

namespace undine
{
  /// Checkpoints during a run; the driver writes another one at its end, good or bad.
  template <int dim>
  class CheckpointOutput : public Output<dim>
  {
  public:
    void
    add_options(const Options &output) override
    {
      output.section("checkpoint")
        .add("Interval",
             interval,
             "",
             Allowed::positive(),
             "Steps between checkpoints: a run that is killed loses at most so many.");
    }

    void
    start(const OutputContext<dim> &new_context, const State<dim> &) override
    {
      context = std::make_unique<const OutputContext<dim>>(new_context);
    }

    bool
    due(const Clock &clock) const override
    {
      return clock.step > 0 && clock.step % interval == 0 && !clock.ended();
    }

    void
    write(const State<dim> &state, const Report &) override
    {
      const auto timed = context->timing.section("checkpoint");
      write_checkpoint(context->directory, context->models, state);
    }

  private:
    unsigned int                              interval = 10; // [steps]
    std::unique_ptr<const OutputContext<dim>> context;
  };


  namespace
  {
    const RegisterForDimensions<Output, CheckpointOutput>
      checkpoint("checkpoint", "whole states in alternating slots, to resume from");
  }
} // namespace undine
