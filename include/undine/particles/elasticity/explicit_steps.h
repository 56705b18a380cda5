// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_explicit_steps_h
#define undine_particles_elasticity_explicit_steps_h

#include <undine/particles/model/elastic_material.h>
#include <undine/particles/model/step_control.h>

namespace undine::particles
{
  /// Square of the highest frequency of a lattice of particles over c_p / l0: explicit steps are
  /// stable up to about 0.95 l0 / c_p.
  static constexpr double lattice_frequency_square = 4.4;

  /// The same of the bonds' term of (P9) alone, over alpha mu / (rho l0^2). It is largest for the
  /// shortest waves k of a lattice, which F does not see, (4 / a) sum w (1 - cos k X): 7.8 in the
  /// plane and 8.1 in space; near surfaces of blocks and in plates it is up to 8.8 and 9.8.
  static constexpr double hourglass_frequency_square = 9.8;

  /// What alpha > 1 adds to the square of the speed of waves by which explicit steps are chosen:
  /// with alpha = 1 the lattice's highest frequency is that above, and what is added to an energy
  /// raises its square by at most that of its own highest frequency [m^2/s^2].
  template <class Real>
  UNDINE_HOST_DEVICE
  Real
  hourglass_square(const ElasticMaterial<Real> &material)
  {
    const Real factor = static_cast<Real>(hourglass_frequency_square / lattice_frequency_square);
    return maximum(Real(0), material.hourglass - 1) * factor * material.mu / material.density;
  }

  /// As in StepBounds, with damping [1/s]: where elasticity alone has the square `elastic` of that
  /// rate, and the speed of waves that belongs to viscosity has the square `viscous` over l0
  /// [1/s^2]. With omega for the former and beta = eta omega_v^2 + alpha explicit steps are stable
  /// up to h^2 omega^2 + 2 h beta = 4.
  template <class Real>
  UNDINE_HOST_DEVICE
  Real
  damped_rate(const ElasticMaterial<Real> &material, const Real elastic, const Real viscous)
  {
    const Real lattice = static_cast<Real>(lattice_frequency_square);
    const Real beta    = material.viscosity * lattice * viscous + material.drag;
    return (beta + square_root(beta * beta + 4 * lattice * elastic)) / (2 * square_root(lattice));
  }

  /// The explicit steps of elastic bodies in a sub-step: each is chosen when it begins, of equal
  /// ones for what is left.
  struct ExplicitSteps
  {
    double left;         ///< [s]
    double rate_at_rest; ///< as in StepBounds [1/s]
    double share;        ///< of 1 over the rate, for a step [1]
    int    most = 0;     ///< more are a failure

    int  taken   = 0;
    bool goes_on = true;
    bool failed  = false;

    UNDINE_HOST_DEVICE
    ExplicitSteps(const double time, const StepBounds &bounds)
      : left(time)
      , rate_at_rest(bounds.elastic_rate)
      , share(bounds.elastic_share)
    {
      most = 100 * number(0);
    }

    /// How many equal ones the rest would take at a rate [1/s].
    UNDINE_HOST_DEVICE
    int
    number(const double rate) const
    {
      const double steps = ceil(left * maximum(rate_at_rest, rate) / share);
      return static_cast<int>(minimum(maximum(steps, 1.), 1e5));
    }

    /// Length of the next one [s], at the rate that was measured at its beginning.
    UNDINE_HOST_DEVICE
    double
    next(const double rate)
    {
      const int    rest = number(rate);
      const double h    = left / rest;
      left -= h;
      ++taken;
      failed  = rest > 1 && taken > most;
      goes_on = rest > 1 && !failed;
      return h;
    }
  };
} // namespace undine::particles

#endif
