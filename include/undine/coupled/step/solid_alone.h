// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_solid_alone_h
#define undine_coupled_step_solid_alone_h

#include <undine/base/core/timing.h>
#include <undine/coupled/step/physics.h>
#include <undine/coupled/step/solid_side.h>

namespace undine
{
  /// Bodies without a fluid.
  template <int dim>
  class SolidAlone : public Physics<dim>
  {
  public:
    /// The references must outlive it. Collective.
    SolidAlone(const Models<dim> &models, Budget<dim> &budget, TimingTree &timing);

    void
    initialize(State<dim> &state, double dt, Report &report) override;

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override;

  private:
    Budget<dim>   &budget;
    SolidSide<dim> solid_side;
  };
} // namespace undine

#endif
