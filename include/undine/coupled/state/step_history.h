// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_step_history_h
#define undine_coupled_state_step_history_h

#include <undine/fluid/grid/fluid_state.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace undine
{
  /// What StepError needs of earlier steps to choose the next one. Empty where steps are constant.
  /// Only faces of the fluid that no body cuts count: values on the others are zero.
  template <int dim>
  struct StepHistory
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Velocities at one time.
    struct Sample
    {
      double        time = 0; ///< [s]
      Vector        bodies;   ///< u [m/s]
      Velocity<dim> fluid;    ///< v [m/s]
    };

    /// True if steps are chosen by an estimate.
    bool
    in_use() const
    {
      return !samples.empty();
    }

    std::vector<Sample> samples; ///< the newest first, those that are not taken yet at the end
    unsigned int        n_samples = 0; ///< taken
    Sample              before;        ///< bodies only: at the start of the last step
    Velocity<dim>       uncut;         ///< of how many samples in a row no body has cut a face
    double largest    = 0; ///< y so far: displacement [m], else the fluid's velocity [m/s]
    double derivative = 0; ///< d^(p+1) y / dt^(p+1) by the last estimate
    double error      = 0; ///< sum of the errors of all steps so far, as y
    double best_step  = 0; ///< by the last estimate [s]; 0: none yet
    double next_step  = 0; ///< by the last estimates [s]
    double step       = 0; ///< to try next [s]
  };
} // namespace undine

#endif
