// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_rayleigh_damping_h
#define undine_solid_step_rayleigh_damping_h

#include <undine/base/core/timing.h>
#include <undine/solid/assembly/solid_environment.h>
#include <undine/solid/step/stage_begin.h>
#include <undine/solid/step/step_motion.h>

namespace undine
{
  /// Rayleigh damping in one stage, alpha M u_C + eta V(d_V) u_V (S15) with alpha and eta of the
  /// environment; nothing without damping. u_C is that of StageCoefficients, u_V the mean velocity
  /// of the bodies over the stage and d_V the middle of their way: the rate at which the material
  /// is strained is then (E^e - E^b) / duration for the strains E at both ends, exactly. It is zero
  /// however far a body turns within the stage, and the work of the viscous stress is never
  /// positive. With other velocities or places a rotation would look like a strain, and damping
  /// would put energy in. All functions that take or return vectors are collective.
  template <int dim>
  class RayleighDamping
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// The references must outlive it.
    RayleighDamping(const Matrix                &mass,
                    const SolidEnvironment<dim> &environment,
                    const StepMotion<dim>       &motion,
                    const StageBegin            &begin,
                    TimingTree                  &timing);

    /// Is there any damping?
    bool
    is_on() const;

    /// Is there a viscous stress?
    bool
    is_viscous() const;

    /// forces += alpha M u_C + eta W V u_V. Throws nothing.
    void
    add_forces(Vector &forces, const Vector &end_velocity) const;

    /// forces += alpha M u_C, the part of the forces that does not sum to zero over a body.
    void
    add_drag(Vector &forces, const Vector &end_velocity) const;

    /// A += the derivative of the forces with respect to the end velocity, where the step ends with
    /// `end_displacement`.
    void
    add_jacobian(Matrix &A, const Vector &end_velocity, const Vector &end_displacement) const;

    /// (alpha M u_C + eta W V u_V) times u_C and u_V, over W, never negative [W].
    double
    power(const Vector &end_velocity) const;

  private:
    Vector
    drag_velocity(const Vector &end_velocity) const;
    Vector
    mean_velocity(const Vector &end_velocity) const;
    Vector
    middle(const Vector &end_displacement) const;
    double
    duration() const;
    const Vector &
    begin_place() const;

    const SolidModel<dim>       &model;
    const Matrix                &mass;
    const SolidEnvironment<dim> &environment;
    const StepMotion<dim>       &motion;
    const StageBegin             begin;
    TimingTree                  &timing;
  };
} // namespace undine

#endif
