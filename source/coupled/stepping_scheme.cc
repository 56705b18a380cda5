// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/single_physics.h>
#include <undine/coupled/stepping_scheme.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Throws SolveError naming the first quantity that is no finite number.
    void
    assert_finite(const Columns &columns)
    {
      for (const auto &column : columns)
        if (!std::isfinite(column.value))
          throw SolveError("'" + column.name +
                           "' is not a finite number. Check the expressions of the scene at this "
                           "time, or try a smaller Time/Step.");
    }
  } // namespace


  template <int dim>
  void
  SteppingScheme<dim>::add_options(const Options &options)
  {
    const auto time = options.section("Time");
    time.require("Step", asked_step, "s", Allowed::positive(), "Length of a time step.");
    time.add("Maximum cuts",
             maximum_cuts,
             "",
             Allowed::between(0, 20),
             "How often a step that fails is halved and redone before the run stops.");
  }


  template <int dim>
  Report
  SteppingScheme<dim>::initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing)
  {
    if (models.solid && models.fluid)
      physics = couple(models, timing);
    else if (models.solid)
      physics = std::make_unique<SolidAlone<dim>>(models, timing);
    else
      physics = std::make_unique<FluidAlone<dim>>(models, timing);

    Report report;
    physics->initialize(state, choose_dt(state), report);
    return report;
  }


  template <int dim>
  double
  SteppingScheme<dim>::choose_dt(const State<dim> &state) const
  {
    return state.clock.land(std::min(asked_step, allowed_step));
  }


  template <int dim>
  Report
  SteppingScheme<dim>::step(State<dim> &state, const double asked)
  {
    const State<dim> saved = state;
    for (Report report;; ++report.cuts)
      try
        {
          report.dt = asked / (1u << report.cuts);
          physics->step(state, report);
          assert_finite(report.columns);
          allowed_step = report.cuts > 0 ? report.dt : 2 * allowed_step;
          return report;
        }
      catch (const SolveError &error)
        {
          state                    = saved;
          report.newton_iterations = report.linear_iterations = 0;
          report.columns.clear();
          report.note.clear();
          if (report.cuts == maximum_cuts)
            throw SolveError(fmt::format("the step of {:.4g} s failed, and so did {} shorter "
                                         "one(s), down to {:.4g} s: {}",
                                         asked,
                                         maximum_cuts,
                                         report.dt,
                                         error.what()));
        }
  }


  template class SteppingScheme<2>;
  template class SteppingScheme<3>;
} // namespace undine
