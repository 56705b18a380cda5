// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/columns_of_step.h>
#include <undine/output/output.h>
#include <undine/output/probes/probe.h>
#include <undine/output/statistics_file.h>

namespace undine
{
  namespace
  {
    void
    append(Columns &columns, const Columns &more)
    {
      columns.insert(columns.end(), more.begin(), more.end());
    }
  } // namespace


  /// The file `statistics`: a row for the initial state and for every step with how the step went,
  /// what the models and the probes measured.
  template <int dim>
  class Statistics : public Output<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    void
    assert_continues(const OutputContext<dim> &context,
                     const State<dim>         &state,
                     const Report             &report,
                     const ResumedFrom        &from) const override
    {
      if (state.clock.step > 0)
        StatisticsFile::assert_continues(context.communicator,
                                         from.directory / "statistics",
                                         state.clock.step,
                                         all_columns(state, report),
                                         from.statistics_digest);
    }

    void
    start(const OutputContext<dim> &new_context, const State<dim> &state) override
    {
      context = std::make_unique<const OutputContext<dim>>(new_context);
      context->folder.claim("statistics");
      file = std::make_unique<StatisticsFile>(
        context->communicator, context->folder.path() / "statistics", state.clock.step);
      context->folder.statistics_digest = file->digest();
    }

    bool
    due(const Clock &) const override
    {
      return true;
    }

    void
    write(const State<dim> &state, const Report &report) override
    {
      const auto timed = context->timing.section("statistics");
      file->append(all_columns(state, report));
      context->folder.statistics_digest = file->digest();
    }

  private:
    static Columns
    all_columns(const State<dim> &state, const Report &report)
    {
      Columns columns = columns_of_step(state.clock, report);
      append(columns, report.columns);
      return columns;
    }

    std::unique_ptr<const OutputContext<dim>> context;
    std::unique_ptr<StatisticsFile>           file;
  };


  namespace
  {
    const RegisterForDimensions<Output, Statistics>
      statistics("statistics", "one row of numbers a step, as text; always written");
  }
} // namespace undine
