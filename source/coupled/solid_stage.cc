// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/solid_stage.h>

namespace undine
{
  namespace
  {
    /// Displacement and velocity go on for `length` [s] with the rates of `of`.
    void
    add_rates(SolidState &solid, const double length, const SolidState &of)
    {
      if (length == 0)
        return;
      solid.displacement.add(length, of.velocity);
      solid.velocity.add(length, of.acceleration);
    }
  } // namespace


  template <int dim>
  void
  start_stage(State<dim> &state, const Stage &stage)
  {
    if (!stage.keeps_rates)
      return;
    const SolidState now = state.solid;
    if (stage.is_first)
      add_rates(state.solid, stage.rate, now);
    else
      state.solid = state.next_solid;
    state.next_solid = stage.is_last ? SolidState() : now;
    add_rates(state.next_solid, stage.next_old, now);
  }


  template <int dim>
  void
  end_stage(State<dim> &state, const Stage &stage)
  {
    if (stage.keeps_rates && !stage.is_last)
      add_rates(state.next_solid, stage.next_new, state.solid);
  }


  template void
  start_stage(State<2> &, const Stage &);
  template void
  start_stage(State<3> &, const Stage &);
  template void
  end_stage(State<2> &, const Stage &);
  template void
  end_stage(State<3> &, const Stage &);
} // namespace undine
