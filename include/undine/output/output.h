// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_output_h
#define undine_output_output_h

#include <undine/base/core/timing.h>
#include <undine/base/options/options.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/files/result_folder.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace undine
{
  template <int dim>
  class Probe;

  /// All that an output may use besides the state. The references outlive the outputs.
  template <int dim>
  struct OutputContext
  {
    MPI_Comm                                        communicator;
    ResultFolder                                   &folder; ///< every file is claimed in it
    const Models<dim>                              &models;
    const std::vector<std::unique_ptr<Probe<dim>>> &probes;
    TimingTree                                     &timing;
  };

  /// Something that is written during a run. A new output is one new .cc file that registers
  /// itself; a scene asks for it by its name in `Output / Parts`.
  template <int dim>
  class Output
  {
  public:
    virtual ~Output() = default;

    /// Declares and reads the keys of the output's own subsection of `Output`.
    virtual void
    add_options(const Options &options) = 0;

    /// Called before start() when a run is taken up again `from` a checkpoint; `state` is that of
    /// the checkpoint, `report` one with the columns of this run. Throws FileError if what was
    /// written before cannot be continued; changes nothing. Collective.
    virtual void
    assert_continues(const OutputContext<dim> &context,
                     const State<dim>         &state,
                     const Report             &report,
                     const ResumedFrom        &from) const
    {
      (void)context, (void)state, (void)report, (void)from;
    }

    /// Called once before the first write. Collective. `state` is the initial one, or that of a
    /// checkpoint when the run is resumed: records later than its clock must be dropped, earlier
    /// ones kept.
    virtual void
    start(const OutputContext<dim> &context, const State<dim> &state) = 0;

    /// Is there something to write now? Called for the initial state and after every step.
    virtual bool
    due(const Clock &clock) const = 0;

    /// Collective. Files are written under a temporary name and renamed, or appended to by whole
    /// lines, so that what exists is valid at any moment. Throws FileError.
    virtual void
    write(const State<dim> &state, const Report &report) = 0;
  };
} // namespace undine

#endif
