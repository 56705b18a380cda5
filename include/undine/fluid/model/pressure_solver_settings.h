// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_model_pressure_solver_settings_h
#define undine_fluid_model_pressure_solver_settings_h

#include <undine/base/options/options.h>

#include <string>

namespace undine
{
  /// Numerics of the pressure equation.
  struct PressureSolverSettings
  {
    /// Largest allowed |div v| dx / max |v| after a step [1], dx the smallest width of the cell.
    double       divergence_tolerance = 1e-10;
    unsigned int maximum_iterations   = 300;         ///< of conjugate gradients
    std::string  multigrid            = "geometric"; ///< name of a CellPreconditioner

    /// `options` is the section of the pressure solver.
    void
    add_options(const Options &options);
  };
} // namespace undine

#endif
