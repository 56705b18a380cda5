// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_coupled_equations_h
#define undine_coupled_step_coupled_equations_h

#include <undine/coupled/immersed/surface_flux.h>
#include <undine/coupled/linear/block_solver.h>
#include <undine/fluid/pressure/pressure_equations.h>
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  /// The equations of a step for the bodies' velocities u = u^{n+1} and the fluid's pressures p, as
  /// Newton's method sees them (Newton):
  ///
  ///     R(u) - B^T p = 0             [N]         R: SolidEquations
  ///     D v* + B u + h L p = 0       [m^dim/s]   B: SurfaceFlux
  ///
  /// Norms are sums of both, each relative to the size of its terms: the largest where corrections
  /// were computed. Points on trial may raise it tenfold at most, and only for themselves: they
  /// must neither hide how far off they are nor loosen what follows.
  template <int dim>
  class CoupledEquations
  {
  public:
    using Unknown = BlockSystem::BlockVector;
    using Vector  = BlockSystem::Vector;

    /// The references must outlive it. `flux_rounding` [m^dim/s]: what rounding of the bodies'
    /// places makes of B u.
    CoupledEquations(const SolidModel<dim>        &model,
                     SolidEquations<dim>          &solid,
                     SurfaceFlux<dim>             &surface,
                     const PressureEquations<dim> &fluid,
                     BlockSolver<dim>             &solver,
                     TimingTree                   &timing,
                     double                        flux_rounding);

    /// Newton's method begins anew: forget sizes.
    void
    start();

    double
    evaluate(const Unknown &x);

    Unknown
    correction(const Unknown &x);

    double
    scale() const;

    double
    rounding() const;

    unsigned int
    linear_iterations() const;

    /// Zero, with a place for all velocities and pressures.
    Unknown
    vector() const;

  private:
    const SolidModel<dim>        &model;
    SolidEquations<dim>          &solid;
    SurfaceFlux<dim>             &surface;
    const PressureEquations<dim> &fluid;
    BlockSolver<dim>             &solver;
    TimingTree                   &timing;
    const double                  flux_rounding;
    Unknown                       residual;

    /// Of the terms of both rows.
    struct Sizes
    {
      double force = 0; ///< [N]
      double flux  = 0; ///< [m^dim/s]
    };

    void
    measure(const Sizes &own);

    Sizes  reference; ///< where corrections were computed
    Sizes  here;      ///< for the point evaluated last
    double last_norm = 0;
  };
} // namespace undine

#endif
