// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_splitting_stability_h
#define undine_coupled_state_splitting_stability_h

#include <optional>
#include <string>

namespace undine
{
  /// What linear theory foretells of time splitting (V14), whether or not a run uses it. Infinite
  /// where bodies close off a region of the fluid: then it has no solution.
  struct SplittingStability
  {
    /// The largest ratio of the fluid's added mass to the inertia of the bodies (V15) [1]. Above 1
    /// time splitting is unstable if their velocity drives the fluid.
    double added_mass_ratio = 0;

    /// The factor by which small motions grow in a step, at most 1 if nothing does; if the fluid is
    /// driven by the bodies' velocity, or by their displacement [1]. Not a number if it was not
    /// found. @{
    double growth_by_velocity     = 0;
    double growth_by_displacement = 0;
    /// @}

    /// That of them which is of the run itself, if it uses time splitting.
    std::optional<double> growth_of_run = {};

    /// For the user.
    std::string
    text() const;
  };
} // namespace undine

#endif
