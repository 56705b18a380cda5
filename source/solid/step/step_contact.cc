// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/step/step_contact.h>

#include <fmt/format.h>

namespace undine
{
  namespace
  {
    /// a x + b y, empty vectors being zero.
    template <class Vector>
    Vector
    combination(const double a, Vector x, const double b, const Vector &y)
    {
      if ((a == 0 || x.size() == 0) && (b == 0 || y.size() == 0))
        return {};
      if (x.size() == 0)
        {
          x = y;
          x *= b;
          return x;
        }
      x *= a;
      if (b != 0 && y.size() > 0)
        x.add(b, y);
      return x;
    }
  } // namespace


  template <int dim>
  StepContact<dim>::StepContact(const Contact<dim>    *contact,
                                const ContactStart    &start,
                                const SolidModel<dim> &model,
                                const SolidState      &old_state,
                                const double           time,
                                const double           dt,
                                TimingTree            &timing)
    : contact(contact)
    , start(start)
    , model(model)
    , old_state(old_state)
    , time(time)
    , dt(dt)
    , timing(timing)
  {
    if (contact)
      contact->begin_stage();
  }


  template <int dim>
  const typename StepContact<dim>::Vector &
  StepContact<dim>::last_displacement() const
  {
    return start.displacement.size() > 0 ? start.displacement : old_state.displacement;
  }


  template <int dim>
  double
  StepContact<dim>::last_time() const
  {
    return start.displacement.size() > 0 ? start.time : time;
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::rate(const Vector &end) const
  {
    if (!contact)
      return {};
    const auto timed = timing.section("contact");
    return contact->forces(end, time + dt);
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::forces(const Vector &end) const
  {
    return combination(start.weight, rate(end), 1 - start.weight, old_state.contact_forces);
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::change(const Vector &end) const
  {
    if (!is_part_of_rates() || start.weight == 1)
      return {};
    return combination(start.weight - 1, rate(end), 1 - start.weight, old_state.contact_forces);
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::beside_rates(const Vector &end) const
  {
    if (is_part_of_rates())
      return is_lasting(end)
               ? Vector()
               : combination(keeps_rate_at_end() ? 1. : start.weight, rate(end), 0., Vector());
    return model.numerics().integrator->uses_acceleration() ? forces(end) : Vector();
  }


  template <int dim>
  bool
  StepContact<dim>::is_lasting(const Vector &end) const
  {
    constexpr double largest_change = .5; // of the force
    Vector           now            = rate(end);
    if (now.size() == 0)
      return true;
    const auto   timed  = timing.section("contact");
    const Vector before = contact->forces(last_displacement(), last_time());
    if (before.size() == 0)
      return false;
    const double size = now.l2_norm();
    now.add(-1., before);
    return now.l2_norm() <= largest_change * size;
  }


  template <int dim>
  void
  StepContact<dim>::add_stiffness(Matrix       &A,
                                  const double  factor,
                                  const Vector &end,
                                  const Tangent kind) const
  {
    if (!contact)
      return;
    const auto timed = timing.section("contact");
    contact->add_stiffness(A, start.weight * factor, end, time + dt, kind);
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::guess(const StepMotion<dim> &motion) const
  {
    if (start.velocity.size() == 0)
      return motion.guess();
    Vector result = leading_to_last_displacement(motion);
    result.add(start.weight, start.velocity);
    take_fixed(result, motion.guess());
    return result;
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::leading_to_last_displacement(const StepMotion<dim> &motion) const
  {
    Vector result = motion.guess_at_rest();
    result.add(1 / motion.coefficients().displacement, last_displacement());
    result.add(-1 / motion.coefficients().displacement, old_state.displacement);
    return result;
  }


  /// Entries of `velocity` at fixed degrees of freedom become those of `known`.
  template <int dim>
  void
  StepContact<dim>::take_fixed(Vector &velocity, const Vector &known) const
  {
    for (const auto &fixed : model.fixed())
      velocity(fixed.dof) = known(fixed.dof);
    velocity.compress(dealii::VectorOperation::insert);
  }


  template <int dim>
  typename StepContact<dim>::Vector
  StepContact<dim>::kept_apart(const Vector &guess, const StepMotion<dim> &motion) const
  {
    if (!contact)
      return guess;
    const auto timed = timing.section("contact");
    if (contact->collision_free_fraction({last_displacement(), last_time()},
                                         {motion.displacement(guess), time + dt}) == 1)
      return guess;
    // Except at supports, which are where they are prescribed to be.
    Vector       still = leading_to_last_displacement(motion);
    const Vector begin = motion.displacement(still);
    const double free =
      contact->collision_free_fraction({last_displacement(), last_time()}, {begin, time + dt});
    if (free < 1)
      throw SolveError(
        fmt::format("supports or obstacles that move as prescribed run into a body within the "
                    "step, of which {:.0f} % leave a gap. Try: a smaller step, in which the body "
                    "can give way, or another motion.",
                    100 * free));
    Vector       displacement_increment = guess;
    const double part =
      contact->collision_free_fraction({begin, time + dt}, {motion.displacement(guess), time + dt});
    if (part == 1)
      return guess;
    displacement_increment.add(-1., still);
    still.add(part, displacement_increment);
    take_fixed(still, guess); // where it is no guess
    return still;
  }


  template <int dim>
  double
  StepContact<dim>::collision_free_fraction(const Vector          &velocity,
                                            const Vector          &correction,
                                            const StepMotion<dim> &motion) const
  {
    if (!contact)
      return 1;
    const auto timed = timing.section("contact");
    Vector     end   = velocity;
    end.add(1., correction);
    return contact->collision_free_fraction({motion.displacement(velocity), time + dt},
                                            {motion.displacement(end), time + dt});
  }


  template <int dim>
  bool
  StepContact<dim>::keeps_rate_at_end() const
  {
    return start.kept != KeptRate::mean;
  }


  template <int dim>
  void
  StepContact<dim>::balance(SolidBalance<dim> &result,
                            const Vector      &end,
                            const Vector      &displacement_increment) const
  {
    if (!contact)
      return;
    const auto timed = timing.section("contact");
    result.contact_energy =
      contact->energy(end, time + dt) - contact->energy(last_displacement(), last_time());
    const Vector repulsion = forces(end);
    if (repulsion.size() == 0)
      return;
    result.contact = repulsion * displacement_increment;
    for (const auto &of_body : sums_by_body(model, repulsion))
      result.contact_force += of_body;
  }


  template class StepContact<2>;
  template class StepContact<3>;
} // namespace undine
