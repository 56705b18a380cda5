// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/solvers/mass_solve.h>
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  template <int dim>
  const typename SolidEquations<dim>::Vector &
  SolidEquations<dim>::last_place() const
  {
    return contact_start.place.size() > 0 ? contact_start.place : old_state.displacement;
  }


  template <int dim>
  double
  SolidEquations<dim>::last_time() const
  {
    return contact_start.place.size() > 0 ? contact_start.time : time;
  }


  /// weight (-dE/dd) at the end of the step [N]; empty if nothing touches.
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::contact_forces(const Vector &end) const
  {
    if (!contact)
      return {};
    const auto timed  = timing.section("contact");
    Vector     result = contact->forces(end, time + dt);
    if (result.size() > 0)
      result *= contact_start.weight;
    return result;
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::kept_apart(const Vector &guess) const
  {
    if (!contact)
      return guess;
    const auto timed = timing.section("contact");
    // The velocity that leads to the last position, except at supports, which are where they are
    // prescribed to be.
    Vector still = guess_at_rest();
    still.add(1 / coefficients.displacement, last_place());
    still.add(-1 / coefficients.displacement, old_state.displacement);
    const Vector place = displacement(still);
    if (contact->free_part({last_place(), last_time()}, {place, time + dt}) < 1)
      throw SolveError("supports or obstacles that move as prescribed run into a body within the "
                       "step. Try: a smaller step, or another motion.");
    Vector       displacement_increment = guess;
    const double part = contact->free_part({place, time + dt}, {displacement(guess), time + dt});
    if (part == 1)
      return guess;
    displacement_increment.add(-1., still);
    still.add(part, displacement_increment);
    return still;
  }


  template <int dim>
  double
  SolidEquations<dim>::free_part(const Vector &velocity, const Vector &correction) const
  {
    if (!contact)
      return 1;
    const auto timed = timing.section("contact");
    Vector     end   = velocity;
    end.add(1., correction);
    return contact->free_part({displacement(velocity), time + dt}, {displacement(end), time + dt});
  }


  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::contact_velocity(const Vector &velocity) const
  {
    if (!contact_start.keeps_rates && !model.numerics().integrator->uses_acceleration())
      return {};
    Vector result = contact_forces(displacement(velocity));
    if (result.size() > 0)
      {
        result = solve_mass(model, mass, result, model.vector());
        result *= dt;
      }
    return result;
  }


  template <int dim>
  void
  SolidEquations<dim>::balance_contact(SolidBalance<dim> &result,
                                       const Vector      &end,
                                       const Vector      &displacement_increment) const
  {
    if (!contact)
      return;
    const auto   timed    = timing.section("contact");
    const double before   = contact_start.old_energy ? *contact_start.old_energy
                                                     : contact->energy(last_place(), last_time());
    result.contact_energy = contact->energy(end, time + dt) - before;
    const Vector pushes   = contact_forces(end);
    if (pushes.size() == 0)
      return;
    result.contact = pushes * displacement_increment;
    for (const auto &of_body : sums_by_body(model, pushes))
      result.contact_force += of_body;
  }


#define UNDINE_INSTANTIATE(dim)                                                                   \
  template const SolidEquations<dim>::Vector &SolidEquations<dim>::last_place() const;            \
  template double                             SolidEquations<dim>::last_time() const;             \
  template SolidEquations<dim>::Vector SolidEquations<dim>::contact_forces(const Vector &) const; \
  template SolidEquations<dim>::Vector SolidEquations<dim>::kept_apart(const Vector &) const;     \
  template double SolidEquations<dim>::free_part(const Vector &, const Vector &) const;           \
  template SolidEquations<dim>::Vector SolidEquations<dim>::contact_velocity(const Vector &)      \
    const;                                                                                        \
  template void SolidEquations<dim>::balance_contact(                                             \
    SolidBalance<dim> &, const Vector &, const Vector &) const;

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
