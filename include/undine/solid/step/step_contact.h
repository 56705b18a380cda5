// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_step_contact_h
#define undine_solid_step_step_contact_h

#include <undine/base/core/timing.h>
#include <undine/solid/assembly/contact.h>
#include <undine/solid/step/solid_balance.h>
#include <undine/solid/step/step_motion.h>

namespace undine
{
  /// Contact of the bodies in one step, where forces of contact act at its end alone: nothing
  /// without contact. All functions that take or return vectors are collective.
  template <int dim>
  class StepContact
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// For the step from `old_state` at `time` [s] over `dt` [s]; begins its stage. `contact`:
    /// nullptr if there is none. The references must outlive it.
    StepContact(const Contact<dim>    *contact,
                const ContactStart    &start,
                const SolidModel<dim> &model,
                const SolidState      &old_state,
                double                 time,
                double                 dt,
                TimingTree            &timing);

    /// The last displacement at which no gap was closed [m].
    const Vector &
    last_displacement() const;

    /// f_c at the end of the step [N]; empty if nothing touches.
    Vector
    rate(const Vector &end_displacement) const;

    /// kappa f_c - (kappa - 1) f_c^b, with f_c^b of the old state [N]; empty if nothing touches,
    /// nor has.
    Vector
    forces(const Vector &end_displacement) const;

    /// What of these f_c is not [N]: (kappa - 1) (f_c - f_c^b) in stages, nothing else.
    Vector
    change(const Vector &end_displacement) const;

    /// What of them no rate contains that is kept, beside the change() in those at the end of a
    /// stage [N]: f_c, or kappa times that of the mean, of a contact that does not last, and all
    /// where the integrator uses accelerations; empty: nothing, or nobody needs to know.
    Vector
    beside_rates(const Vector &end_displacement) const;

    /// Does contact press about as at the begin of the stage? Then it is part of the rates; what
    /// hits or leaves something would go on with a rate of one stage.
    bool
    is_lasting(const Vector &end_displacement) const;

    /// A += factor weight d^2E/dd^2 at the end of the step, or what is convex of it.
    void
    add_stiffness(Matrix &A, double factor, const Vector &end_displacement, Tangent kind) const;

    /// SolidEquations::guess().
    Vector
    guess(const StepMotion<dim> &motion) const;

    /// SolidEquations::kept_apart().
    Vector
    kept_apart(const Vector &guess, const StepMotion<dim> &motion) const;

    /// SolidEquations::collision_free_fraction().
    double
    collision_free_fraction(const Vector          &velocity,
                            const Vector          &correction,
                            const StepMotion<dim> &motion) const;

    /// Is the rate at the end of the step kept for the next one? Not that of a stage that keeps the
    /// mean, in which contact has given f_c all the same.
    bool
    keeps_rate_at_end() const;

    /// Is f_c part of the rates?
    bool
    is_part_of_rates() const
    {
      return start.kept != KeptRate::none;
    }

    /// Set the terms of contact in a balance.
    void
    balance(SolidBalance<dim> &result,
            const Vector      &end_displacement,
            const Vector      &displacement_increment) const;

  private:
    double
    last_time() const;
    Vector
    leading_to_last_displacement(const StepMotion<dim> &motion) const;
    void
    take_fixed(Vector &velocity, const Vector &known) const;

    const Contact<dim> *const contact; ///< nullptr: none
    const ContactStart        start;
    const SolidModel<dim>    &model;
    const SolidState         &old_state;
    const double              time;
    const double              dt;
    TimingTree               &timing;
  };
} // namespace undine

#endif
