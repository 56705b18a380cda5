// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_coupled_equations_h
#define undine_coupled_step_coupled_equations_h

#include <undine/base/core/newton.h>
#include <undine/coupled/immersed/follower_pressure.h>
#include <undine/coupled/immersed/surface_flux.h>
#include <undine/coupled/linear/block_solver.h>
#include <undine/fluid/pressure/pressure_equations.h>
#include <undine/solid/step/solid_equations.h>

#include <memory>

namespace undine
{
  /// The equations of a step (C1) for the bodies' velocities u = u^{n+1} and the fluid's pressures
  /// p, in the form that solve_newton() asks for:
  ///
  ///     R(u) - B^T p - f(u) = 0      [N]         R: SolidEquations, f: FollowerPressure
  ///     D v* + B u + h L p = 0       [m^dim/s]   B: SurfaceFlux
  ///
  /// A norm is the root of the sum of the squares of both, each relative to the size of its terms:
  /// the largest where corrections were computed. Points on trial may raise that size tenfold at
  /// most, and only for themselves: otherwise a bad point would seem to have a small residual, and
  /// later tolerances would be too loose.
  template <int dim>
  class CoupledEquations
  {
  public:
    using Unknown = BlockSystem::BlockVector;
    using Vector  = BlockSystem::Vector;
    using Vectors = typename FollowerPressure<dim>::Vectors;

    /// The references must outlive it. `rounding_of_places` [m^dim/s]: what rounding of the bodies'
    /// places makes of B u.
    CoupledEquations(const SolidModel<dim>        &model,
                     SolidEquations<dim>          &solid,
                     SurfaceFlux<dim>             &surface,
                     const FollowerPressure<dim>  &follower,
                     const PressureEquations<dim> &fluid,
                     BlockSolver<dim>             &solver,
                     TimingTree                   &timing,
                     double                        rounding_of_places);

    /// Newton's method begins anew: forget the sizes of terms.
    void
    start();

    /// Moves the bodies to u of `x` and computes both residuals there. Returns their norm [1].
    /// Collective. Throws SolveError.
    double
    evaluate(const Unknown &x);

    /// B^T p + f(u) of `x`, in all nodes of surfaces and over the bodies' degrees of freedom [N].
    /// Collective. @{
    Vectors
    nodal_forces(const Unknown &x) const;
    Vector
    forces(const Unknown &x) const;
    /// @}

    /// The change of `x`, evaluated last, by the linearised equations (C2), shortened where contact
    /// would close a gap. Collective. Throws SolveError and Interruption.
    Unknown
    correction(const Unknown &x, const CorrectionRequest &request);

    /// Has a correction been computed before?
    bool
    has_tangent() const
    {
      return system != nullptr;
    }

    /// The slope along a correction of the potential of bodies and added mass, for the point
    /// evaluated last [N m/s]: R . du, since pressures follow from velocities by equations that are
    /// linear. Where the second of these is not fulfilled yet, as it is after a full correction, it
    /// is off by that. Collective.
    double
    slope(const Unknown &correction) const;

    /// Of the last correction's linear system [1].
    double
    part_left() const;

    /// 1: norms are relative already.
    double
    scale() const;

    /// The norm that rounding of internal forces, places and pressures leaves of the residual: a
    /// closed chamber may have a pressure far above its differences within the fluid [1].
    double
    rounding() const;

    /// Of the block solver since BlockSolver::start_step().
    unsigned int
    linear_iterations() const;

    /// Zero, with a place for all velocities and pressures.
    Unknown
    vector() const;

  private:
    const SolidModel<dim>        &model;
    SolidEquations<dim>          &solid;
    SurfaceFlux<dim>             &surface;
    const FollowerPressure<dim>  &follower;
    const PressureEquations<dim> &fluid;
    BlockSolver<dim>             &solver;
    TimingTree                   &timing;
    const double                  rounding_of_places;
    double  flux_rounding = 0; ///< of h L p, too, for the point evaluated last
    Unknown residual;

    /// Of the terms of both rows.
    struct Sizes
    {
      double force = 0; ///< [N]
      double flux  = 0; ///< [m^dim/s]
    };

    void
    measure(const Sizes &own);
    void
    linearise(const Unknown &x, Tangent kind);

    Sizes reference; ///< where corrections were computed
    Sizes here;      ///< for the point evaluated last

    std::unique_ptr<BlockSystem::Matrix> tangent;
    std::unique_ptr<const BlockSystem>   system; ///< with this tangent
  };
} // namespace undine

#endif
