// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_step_motion_h
#define undine_solid_step_step_motion_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_state.h>
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// The displacements to which an end velocity u = u^{n+1} leads in one step, by
  /// StageCoefficients, with the prescribed ones in place. All functions that take or return
  /// vectors are collective.
  template <int dim>
  class StepMotion
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;

    /// From `old_state` at `time` [s] over `dt` [s]. The model and the state must outlive it.
    StepMotion(const SolidModel<dim>   &model,
               const SolidState        &old_state,
               const StageCoefficients &coefficients,
               double                   time,
               double                   dt);

    const SolidModel<dim> &
    model() const
    {
      return solid;
    }

    const SolidState &
    old_state() const
    {
      return old;
    }

    const StageCoefficients &
    coefficients() const
    {
      return step_coefficients;
    }

    /// [s]
    double
    dt() const
    {
      return length;
    }

    /// A first u [m/s]: u^n with prescribed velocities in place.
    Vector
    guess() const;

    /// A first u [m/s] that keeps d^{n+1} = d^n at free degrees of freedom.
    Vector
    guess_at_rest() const;

    /// d^{n+1} [m].
    Vector
    displacement(const Vector &velocity) const;

    /// d^{n+1} - d^n [m], without what rounding leaves of the difference of both.
    Vector
    increment(const Vector &velocity) const;

    /// d^{n+1} - d^n at fixed degrees of freedom, zero elsewhere [m].
    Vector
    prescribed_increment() const;

    /// (1 - s) d^n + s d^{n+1} at the position s [m].
    Vector
    level_displacement(const Vector &end_displacement, double position) const;

  private:
    void
    add_old_accelerations(Vector &vector, double factor) const;
    Vector
    free_increment(const Vector &velocity) const;

    const SolidModel<dim>  &solid;
    const SolidState       &old;
    const StageCoefficients step_coefficients;
    const double            time;
    const double            length;
  };
} // namespace undine

#endif
