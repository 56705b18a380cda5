// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_numerics.h>

namespace undine
{
  SolidNumerics::SolidNumerics(const Options &scene)
    : integrator(choose_time_integrator(scene))
  {
    const auto options = scene.section("Solid numerics");
    options.add("Element degree",
                degree,
                "1",
                Allowed::between(1, 2),
                "Of the polynomials that interpolate displacements; 2 does not lock when bent.");
    options.add("Newton tolerance",
                newton.relative_tolerance,
                "1",
                Allowed::between(1e-14, 1e-2),
                "Of the residual of forces, relative to the largest of the forces that it sums.");
    options.add(
      "Newton maximum iterations",
      newton.maximum_iterations,
      "1",
      Allowed::positive(),
      "The step fails if these are not enough. Where no correction lowers the residual, up to "
      "twice as many more go down the potential.");
    options.add("Newton iterations",
                newton.fixed_iterations,
                "1",
                Allowed::not_negative(),
                "Do exactly so many, converged or not, from d = d^n; 0: as many as it takes.");
    options.add("Inexact Newton",
                newton.inexact,
                "",
                Allowed::anything(),
                "Keep the tangent as long as corrections reduce the residual tenfold, and solve "
                "linear systems no further than a correction can gain; false: a new tangent and "
                "the linear tolerance for each. Results agree up to the Newton tolerance.");
    options.add(
      "Linear solver",
      linear_solver,
      "",
      Allowed::one_of({"auto", "direct", "multigrid"}),
      "direct: sparse factorisation; multigrid: conjugate gradients with algebraic "
      "multigrid; auto: direct for few unknowns, and in a stage from the first system on for "
      "which multigrid does not converge.");
    options.add("Linear tolerance",
                linear_tolerance,
                "1",
                Allowed::between(1e-15, 1e-1),
                "Of the iterative solver, relative to the norm of the right-hand side.");
  }
} // namespace undine
