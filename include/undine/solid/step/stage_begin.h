// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_stage_begin_h
#define undine_solid_step_stage_begin_h

#include <deal.II/lac/trilinos_vector.h>

namespace undine
{
  /// Where a stage (Stage) has begun, before bodies went on with the rates that were kept.
  struct StageBegin
  {
    dealii::TrilinosWrappers::MPI::Vector displacement; ///< [m]; empty: that of the old state
    double                                duration = 0; ///< of the stage [s]; with a displacement
  };
} // namespace undine

#endif
