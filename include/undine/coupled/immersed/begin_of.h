// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_begin_of_h
#define undine_coupled_immersed_begin_of_h

#include <undine/base/core/stage.h>
#include <undine/coupled/state/state.h>
#include <undine/solid/step/stage_begin.h>

namespace undine
{
  /// Where the bodies were at the begin of the stage; empty if it keeps no rates.
  template <int dim>
  StageBegin
  begin_of(const State<dim> &state, const Stage &stage)
  {
    return {state.stage_begin.displacement, stage.duration()};
  }
} // namespace undine

#endif
