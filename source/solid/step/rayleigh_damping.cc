// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/step/rayleigh_damping.h>

namespace undine
{
  template <int dim>
  RayleighDamping<dim>::RayleighDamping(const Matrix                &mass,
                                        const SolidEnvironment<dim> &environment,
                                        const StepMotion<dim>       &motion,
                                        const StageBegin            &begin,
                                        TimingTree                  &timing)
    : model(motion.model())
    , mass(mass)
    , environment(environment)
    , motion(motion)
    , begin(begin)
    , timing(timing)
  {
  }


  template <int dim>
  bool
  RayleighDamping<dim>::is_on() const
  {
    return motion.coefficients().damping != 0 &&
           (environment.mass_damping > 0 || environment.stiffness_damping > 0);
  }


  template <int dim>
  bool
  RayleighDamping<dim>::is_viscous() const
  {
    return environment.stiffness_damping > 0 && motion.coefficients().damping != 0;
  }


  template <int dim>
  double
  RayleighDamping<dim>::duration() const
  {
    return begin.displacement.size() > 0 ? begin.duration : motion.dt();
  }


  template <int dim>
  const typename RayleighDamping<dim>::Vector &
  RayleighDamping<dim>::begin_place() const
  {
    return begin.displacement.size() > 0 ? begin.displacement : motion.old_state().displacement;
  }


  /// u_C [m/s].
  template <int dim>
  typename RayleighDamping<dim>::Vector
  RayleighDamping<dim>::drag_velocity(const Vector &end_velocity) const
  {
    const auto &coefficients = motion.coefficients();
    Vector      result       = end_velocity;
    result.sadd(
      coefficients.damping, coefficients.damping_old_velocity, motion.old_state().velocity);
    return result;
  }


  /// u_V [m/s], not from the difference of two displacements: rounding of that over a short step is
  /// more than Newton's method may leave.
  template <int dim>
  typename RayleighDamping<dim>::Vector
  RayleighDamping<dim>::mean_velocity(const Vector &end_velocity) const
  {
    Vector result = motion.increment(end_velocity);
    if (begin.displacement.size() > 0)
      result.add(1., motion.old_state().displacement, -1., begin.displacement);
    result *= 1 / duration();
    return result;
  }


  /// d_V [m].
  template <int dim>
  typename RayleighDamping<dim>::Vector
  RayleighDamping<dim>::middle(const Vector &end_displacement) const
  {
    Vector result = end_displacement;
    result.sadd(0.5, 0.5, begin_place());
    return result;
  }


  template <int dim>
  void
  RayleighDamping<dim>::add_drag(Vector &forces, const Vector &end_velocity) const
  {
    if (environment.mass_damping == 0 || motion.coefficients().damping == 0)
      return;
    const auto timed   = timing.section("damping");
    Vector     product = model.vector();
    mass.vmult(product, drag_velocity(end_velocity));
    forces.add(environment.mass_damping, product);
  }


  template <int dim>
  void
  RayleighDamping<dim>::add_forces(Vector &forces, const Vector &end_velocity) const
  {
    add_drag(forces, end_velocity);
    if (!is_viscous())
      return;
    const auto   timed = timing.section("damping");
    const Vector end   = motion.displacement(end_velocity);
    forces.add(environment.stiffness_damping * motion.coefficients().sum_of_weights(),
               viscous_forces(model, middle(end), mean_velocity(end_velocity)));
  }


  template <int dim>
  void
  RayleighDamping<dim>::add_jacobian(Matrix       &A,
                                     const Vector &end_velocity,
                                     const Vector &end_displacement) const
  {
    const auto &coefficients = motion.coefficients();
    if (environment.mass_damping > 0 && coefficients.damping != 0)
      A.add(coefficients.damping * environment.mass_damping, mass);
    if (!is_viscous())
      return;
    const auto timed     = timing.section("damping");
    const auto stiffness = viscous_stiffness(model,
                                             middle(end_displacement),
                                             mean_velocity(end_velocity),
                                             0.5 * coefficients.displacement,
                                             coefficients.displacement / duration());
    timing.memory.hold_briefly("damping", stiffness.memory_consumption());
    A.add(environment.stiffness_damping * coefficients.sum_of_weights(), stiffness);
  }


  template <int dim>
  double
  RayleighDamping<dim>::power(const Vector &end_velocity) const
  {
    const double weight = motion.coefficients().sum_of_weights();
    Vector       drag   = model.vector();
    add_drag(drag, end_velocity);
    double result = drag * drag_velocity(end_velocity) / (weight * weight);
    if (is_viscous())
      {
        const Vector end = motion.displacement(end_velocity), mean = mean_velocity(end_velocity);
        result += environment.stiffness_damping * (viscous_forces(model, middle(end), mean) * mean);
      }
    return result;
  }


  template class RayleighDamping<2>;
  template class RayleighDamping<3>;
} // namespace undine
