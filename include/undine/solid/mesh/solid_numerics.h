// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_solid_numerics_h
#define undine_solid_mesh_solid_numerics_h

#include <undine/base/core/newton.h>
#include <undine/base/options/options.h>
#include <undine/solid/time/time_integrator.h>

#include <memory>
#include <string>

namespace undine
{
  /// The discretisation and solution of the bodies' equations: the section `Solid numerics`, and
  /// the integrator of section `Time`.
  struct SolidNumerics
  {
    /// Read the keys.
    explicit SolidNumerics(const Options &scene);

    std::unique_ptr<TimeIntegrator> integrator;
    unsigned int                    degree = 2; ///< of the finite elements: 1 or 2
    NewtonOptions                   newton;
    std::string                     linear_solver    = "auto"; ///< auto | direct | multigrid
    double                          linear_tolerance = 1e-10;  ///< of the first residual [1]
  };
} // namespace undine

#endif
