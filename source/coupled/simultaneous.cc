// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/scheme.h>
#include <undine/coupled/single_physics.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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


  /// The main scheme. A step of length h from t^n:
  ///
  ///  1. fluid: transport, forces, implicit terms of every effect that is on; v^n becomes v*
  ///  2. bodies: Newton's method for u^{n+1}
  ///  3. fluid: projection; v* becomes v^{n+1}, p
  ///
  /// A step that fails is redone from the saved state with half its length, as long as that is not
  /// below the shortest one, Time/Step halved `Maximum cuts` times. The next step has the length
  /// that went well, and those after it double it up to the length asked for; a resumed run begins
  /// with the latter. The limit is one of lengths, not of cuts of each step: short of a time that
  /// no step gets past, every accepted step would allow yet shorter ones. Wrong input fails at
  /// once.
  template <int dim>
  class Simultaneous : public Scheme<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      const auto time = options.section("Time");
      time.require("Step", asked_step, "s", Allowed::positive(), "Length of a time step.");
      time.add(
        "Maximum cuts",
        maximum_cuts,
        "",
        Allowed::between(0, 20),
        "A step that fails is redone with half its length; the run stops where that would be "
        "less than Step halved so often.");
    }

    Report
    initialize(State<dim> &state, const Models<dim> &models, TimingTree &timing) override
    {
      if (models.solid)
        solid = std::make_unique<SolidAlone<dim>>(models, timing);
      if (models.fluid)
        fluid = std::make_unique<FluidAlone<dim>>(models, timing);

      Report report;
      if (solid)
        solid->initialize(state, choose_dt(state), report);
      if (fluid)
        fluid->initialize(state, choose_dt(state), report);
      return report;
    }

    double
    choose_dt(const State<dim> &state) const override
    {
      return state.clock.land(std::min(asked_step, allowed_step));
    }

    Report
    step(State<dim> &state, const double asked) override
    {
      const State<dim> saved = state;
      for (Report report;; ++report.cuts)
        try
          {
            report.dt = asked / (1u << report.cuts);
            advance(state, report);
            allowed_step = report.cuts > 0 ? report.dt : 2 * allowed_step;
            return report;
          }
        catch (const SolveError &error)
          {
            state                    = saved;
            report.newton_iterations = report.linear_iterations = 0;
            report.columns.clear();
            if (report.dt / 2 < shortest_step() * (1 - 1e-9))
              throw SolveError(complaint(asked, report, error));
          }
        catch (const Error &)
          {
            state = saved;
            throw;
          }
    }

  private:
    void
    advance(State<dim> &state, Report &report)
    {
      if (solid)
        solid->step(state, report);
      if (fluid)
        fluid->step(state, report);
      assert_finite(report.columns);
    }

    double
    shortest_step() const
    {
      return asked_step / (1u << maximum_cuts);
    }

    std::string
    complaint(const double asked, const Report &last, const SolveError &error) const
    {
      const std::string shorter =
        last.cuts == 0 ? "" : fmt::format(" and {} shorter one(s)", last.cuts);
      return fmt::format("a step of {:.4g} s{} failed, the last one of {:.4g} s: {}\nTime/Step = "
                         "{:.4g} and Time/Maximum cuts = {} allow none shorter than {:.4g} s. If "
                         "steps became shorter and shorter on the way here, no step will do: try "
                         "what is said above; else try more cuts.",
                         asked,
                         shorter,
                         last.dt,
                         error.what(),
                         asked_step,
                         maximum_cuts,
                         shortest_step());
    }

    double                           asked_step   = 0.01; // [s]
    unsigned int                     maximum_cuts = 6;
    double                           allowed_step = std::numeric_limits<double>::infinity(); // [s]
    std::unique_ptr<SolidAlone<dim>> solid;
    std::unique_ptr<FluidAlone<dim>> fluid;
  };


  namespace
  {
    const RegisterForDimensions<Scheme, Simultaneous>
      simultaneous("simultaneous", "fluid pressures and velocities of bodies are solved together");
  }
} // namespace undine
