// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_physics_h
#define undine_coupled_step_physics_h

#include <undine/base/core/newton.h>
#include <undine/base/core/stage.h>
#include <undine/base/parallel/interruption.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>

namespace undine
{
  /// The equations of a scene: a fluid, bodies, or both in one of the ways to couple them.
  template <int dim>
  class Physics
  {
  public:
    explicit Physics(const MPI_Comm communicator)
      : communicator(communicator)
    {
    }

    virtual ~Physics() = default;

    /// Bring an empty state to the time of its clock and add to the report. `dt` [s] is the length
    /// of the first step. Collective.
    virtual void
    initialize(State<dim> &state, double dt, Report &report) = 0;

    /// A step from the time of the state's clock, which stays, in its stages one after the other;
    /// add to the report, its columns at the end of the step. Collective. Throws SolveError and
    /// Interruption; the state may then be half advanced.
    virtual void
    advance(State<dim> &state, const Stages &stages, Report &report)
    {
      for (const auto &stage : stages)
        {
          throw_if_interrupted(communicator);
          solve_stage(state, stage, report);
        }
    }

    /// The stage of a step from the time of the state's clock, which stays; add to the report, its
    /// columns at the end of the step. Collective. Throws SolveError; the state may then be half
    /// advanced.
    virtual void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) = 0;

    /// Forces of the fluid on the surfaces in it at the end of the last stage, at `time` [s], in
    /// all their nodes [N]; empty if they do not act on bodies. Collective.
    virtual std::vector<dealii::Tensor<1, dim>>
    loads_on_surfaces(const State<dim> & /*state*/, double /*time*/) const
    {
      return {};
    }

  private:
    const MPI_Comm communicator;
  };


  /// The last residual of Newton's method over the first [1]; zero if there was none.
  inline double
  reduction(const NewtonReport &newton)
  {
    const auto &residuals = newton.residuals;
    return residuals.empty() || residuals.front() <= 0 ? 0. : residuals.back() / residuals.front();
  }


  /// Appends columns.
  inline void
  append(Columns &columns, const Columns &more)
  {
    columns.insert(columns.end(), more.begin(), more.end());
  }
} // namespace undine

#endif
