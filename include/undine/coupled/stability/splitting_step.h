// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_stability_splitting_step_h
#define undine_coupled_stability_splitting_step_h

#include <undine/coupled/stability/added_mass.h>
#include <undine/solid/solvers/factorisation.h>
#include <undine/solid/time/time_integrator.h>

namespace undine
{
  /// What moves the surfaces in the fluid in time splitting: the bodies' velocity at the end of a
  /// step, or the displacement in the step over its length.
  enum class DrivenBy
  {
    velocity,
    displacement
  };

  /// A step of time splitting, linearised about a state (V14): small motions of the bodies, in a
  /// fluid of which nothing counts but the pressure that makes way for them. Loads, contact and
  /// follower pressures are left out. For integrators of one stage that keep no accelerations.
  template <int dim>
  class SplittingStep
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// A step of `dt` [s]. The models must outlive it. Collective. Throws SolveError if an element
    /// of the state is inverted.
    SplittingStep(const Models<dim> &models, const State<dim> &state, double dt);

    /// Bodies and their surfaces between two steps.
    struct Motion
    {
      Vector displacement;    ///< d [m]
      Vector velocity;        ///< u [m/s]
      Vector surface;         ///< w, the velocity of the surfaces in the fluid [m/s]
      Vector pressure_forces; ///< [N]
    };

    /// The motion after a step.
    Motion
    after(const Motion &before, DrivenBy driven_by);

    /// The motion u, -u, u, ... of the velocities.
    Motion
    alternating(const Vector &velocity) const;

    /// The inertia against which the pressure of a step pushes where the motion alternates, in the
    /// place of the mass: (V15) [kg].
    const Matrix &
    alternating_inertia() const
    {
      return inertia_if_alternating;
    }

    const AddedMass<dim> &
    added_mass() const
    {
      return fluid;
    }

  private:
    Matrix
    sum(double mass_factor, double stiffness_factor, double viscosity_factor) const;
    Vector
    forces_at_begin(const Motion &before) const;

    const SolidModel<dim>  &model;
    const double            dt; ///< [s]
    const StageCoefficients stage;
    const AddedMass<dim>    fluid;
    double                  mass_damping = 0; ///< alpha [1/s]
    Matrix                  M;                ///< [kg]
    Matrix                  K;                ///< [N/m]
    Matrix                  V;                ///< eta times the sum of weights times V (S15) [kg/s]
    Matrix                  inertia_if_alternating;
    Factorisation           tangent;
  };
} // namespace undine

#endif
