// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_initial_guesses_h
#define undine_solid_step_initial_guesses_h

#include <undine/base/core/newton.h>
#include <undine/base/core/timing.h>
#include <undine/solid/solvers/tangent_solver.h>
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  /// u [m/s] for which bodies stay at d^n, except that they follow supports that have moved, by a
  /// linear prediction that `solver` solves. Collective. Throws SolveError.
  template <int dim>
  typename SolidModel<dim>::Vector
  resting_guess(const SolidEquations<dim> &equations,
                TangentSolver<dim>        &solver,
                TimingTree                &timing)
  {
    auto velocity = equations.guess_at_rest();
    if (equations.has_motion())
      {
        const auto system = equations.motion_predictor();
        const auto timed  = timing.section("solve linear system");
        solver.initialize(system.matrix, equations.displacement(velocity));
        velocity.add(1., solver.solve(system.right_side));
      }
    return velocity;
  }


  /// The result of solve(u), Newton's method from the guess u: from `found`, what an earlier
  /// solution of the same stage has found (empty: none); if there is none or it fails from the
  /// guess of `equations`, and if that fails from rest(). The last two in the other order without
  /// inertia, where an extrapolated equilibrium changes the volume of what is nearly
  /// incompressible, and with a given number of corrections, which are not tried twice. Throws what
  /// the last solve() throws.
  template <int dim, class Rest, class Solve>
  NewtonReport
  solve_from_guesses(const SolidEquations<dim>              &equations,
                     const NewtonOptions                    &options,
                     const typename SolidModel<dim>::Vector &found,
                     const Rest                             &rest,
                     const Solve                            &solve)
  {
    const bool only_once  = options.fixed_iterations > 0;
    const bool rest_first = equations.is_static() || only_once;
    if (found.size() > 0 && !only_once)
      try
        {
          return solve(found);
        }
      catch (const SolveError &)
        {
        }
    try
      {
        return solve(rest_first ? rest() : equations.guess());
      }
    catch (const SolveError &)
      {
        if (only_once)
          throw;
      }
    return solve(rest_first ? equations.guess() : rest());
  }
} // namespace undine

#endif
