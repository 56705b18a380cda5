// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/solvers/mass_solve.h>
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  template <int dim>
  SolidState
  SolidEquations<dim>::end_state(const Vector &velocity, const Vector &contact_velocity) const
  {
    SolidState state;
    state.displacement = displacement(velocity);
    state.velocity     = velocity;
    state.acceleration = model.vector();
    state.acceleration.add(
      coefficients.acceleration, velocity, coefficients.acceleration_velocity, old_state.velocity);
    if (contact_velocity.size() > 0)
      state.acceleration.add(-coefficients.acceleration, contact_velocity);
    const auto &integrator = *model.numerics().integrator;
    if (integrator.uses_acceleration())
      {
        state.acceleration.add(coefficients.acceleration_acceleration, old_state.acceleration);
        if (nodal_forces.size() > 0)
          state.acceleration.add(-coefficients.acceleration * dt,
                                 solve_mass(model, mass, nodal_forces, model.vector()));
        prescribe_acceleration(
          state.acceleration, model, time + (1 + integrator.acceleration_shift()) * dt, dt);
      }
    return state;
  }


  template SolidState
  SolidEquations<2>::end_state(const Vector &, const Vector &) const;
  template SolidState
  SolidEquations<3>::end_state(const Vector &, const Vector &) const;
} // namespace undine
