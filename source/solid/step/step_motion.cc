// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/step/step_motion.h>

namespace undine
{
  template <int dim>
  StepMotion<dim>::StepMotion(const SolidModel<dim>   &model,
                              const SolidState        &old_state,
                              const StageCoefficients &coefficients,
                              const double             time,
                              const double             dt)
    : solid(model)
    , old(old_state)
    , step_coefficients(coefficients)
    , time(time)
    , length(dt)
  {
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::guess() const
  {
    Vector velocity = old.velocity;
    prescribe_velocity(velocity, solid, time + length, length);
    return velocity;
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::guess_at_rest() const
  {
    Vector velocity = solid.vector();
    velocity.add(-step_coefficients.displacement_velocity / step_coefficients.displacement,
                 old.velocity);
    add_old_accelerations(
      velocity, -step_coefficients.displacement_acceleration / step_coefficients.displacement);
    prescribe_velocity(velocity, solid, time + length, length);
    return velocity;
  }


  /// All that there was of acceleration at the begin of the step.
  template <int dim>
  void
  StepMotion<dim>::add_old_accelerations(Vector &vector, const double factor) const
  {
    if (factor == 0)
      return;
    vector.add(factor, old.acceleration);
    if (old.impulse_acceleration.size() > 0)
      vector.add(factor, old.impulse_acceleration);
  }


  /// d^{n+1} - d^n at free degrees of freedom [m].
  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::free_increment(const Vector &velocity) const
  {
    Vector result = velocity;
    result *= step_coefficients.displacement;
    result.add(step_coefficients.displacement_velocity, old.velocity);
    add_old_accelerations(result, step_coefficients.displacement_acceleration);
    return result;
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::increment(const Vector &velocity) const
  {
    Vector result = free_increment(velocity);
    clear_fixed(result, solid);
    result.add(1., prescribed_increment());
    return result;
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::displacement(const Vector &velocity) const
  {
    Vector result = free_increment(velocity);
    result.add(1., old.displacement);
    prescribe_displacement(result, solid, time + length);
    return result;
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::level_displacement(const Vector &end_displacement, const double position) const
  {
    Vector result = end_displacement;
    result.sadd(position, 1 - position, old.displacement);
    return result;
  }


  template <int dim>
  typename StepMotion<dim>::Vector
  StepMotion<dim>::prescribed_increment() const
  {
    Vector result = solid.vector();
    prescribe_displacement(result, solid, time + length);
    for (const auto &fixed : solid.fixed())
      result(fixed.dof) -= old.displacement(fixed.dof);
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template class StepMotion<2>;
  template class StepMotion<3>;
} // namespace undine
