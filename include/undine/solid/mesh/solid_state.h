// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_solid_state_h
#define undine_solid_mesh_solid_state_h

#include <deal.II/lac/trilinos_vector.h>

namespace undine
{
  /// The bodies at one time: nodal vectors over the locally owned degrees of freedom (no ghosts).
  struct SolidState
  {
    dealii::TrilinosWrappers::MPI::Vector displacement; ///< d [m]
    dealii::TrilinosWrappers::MPI::Vector velocity;     ///< u [m/s]
    dealii::TrilinosWrappers::MPI::Vector acceleration; ///< a [m/s^2]; not used by all integrators

    /// Of a fluid around the bodies but for its friction, at the end of the last stage [N]; empty:
    /// there is none with friction, or nothing is known of them.
    dealii::TrilinosWrappers::MPI::Vector fluid_loads;

    /// f_c of contact, which the rates that the last stage has kept contain (T1) [N]; empty: none.
    dealii::TrilinosWrappers::MPI::Vector contact_forces;

    /// What forces that are no part of `acceleration` bring beside it (T4) [m/s^2]; empty: none.
    dealii::TrilinosWrappers::MPI::Vector impulse_acceleration;
  };
} // namespace undine

#endif
