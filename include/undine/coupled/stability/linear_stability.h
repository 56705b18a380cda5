// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_stability_linear_stability_h
#define undine_coupled_stability_linear_stability_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/splitting_stability.h>
#include <undine/coupled/state/state.h>

namespace undine
{
  /// The stability of time splitting for steps of `dt` [s], linearised about the bodies of `state`
  /// where they cut the grid there. Collective. Throws InputError if the scene has no bodies in a
  /// fluid or if its integrator has more than one stage or keeps accelerations, SolveError if
  /// eigenvalues do not converge.
  template <int dim>
  SplittingStability
  splitting_stability(const Models<dim> &models, const State<dim> &state, double dt);
} // namespace undine

#endif
