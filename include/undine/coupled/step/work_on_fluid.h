// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_work_on_fluid_h
#define undine_coupled_step_work_on_fluid_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/fluid_stage.h>
#include <undine/fluid/pressure/pressure_balance.h>

#include <array>

namespace undine
{
  /// Does the fluid carry its own momentum, and kinetic energy, along?
  template <int dim>
  bool
  is_carried(const Models<dim> &models);


  /// What is put into fluid and bodies from outside through the fluid, for the account that
  /// EnergyMonitor keeps (B3).
  template <int dim>
  class WorkOnFluid
  {
  public:
    /// `cut`: the grid as surfaces cut it; nullptr if there are none. The references must outlive
    /// it.
    WorkOnFluid(const Models<dim> &models, const FluidGeometry<dim> *cut);

    /// What obstacles that move do to the fluid by its friction [W].
    double
    friction_of_obstacles(const FluidStage<dim> &fluid) const;

    /// Add to `account`, when the last stage is done, the powers at the end of the step of sides,
    /// whose balance of `pressures` that is, and of obstacles by the same `pressure` [Pa], as it
    /// has acted; and the work of what acts on bodies through the fluid: the weight that the
    /// reduced pressure leaves out, the mean pressure at openings, against which they take their
    /// volume, and what is outside of openings. Collective.
    void
    add(EnergyAccount              &account,
        const State<dim>           &state,
        double                      time,
        const PressureBalance<dim> &pressures,
        const Field<dim>           &pressure) const;

  private:
    double
    kinetic_energy_of_way_made(const State<dim> &state) const;
    void
    add_work_on_bodies(EnergyAccount    &account,
                       const State<dim> &state,
                       double            time,
                       double            level) const;
    std::array<double, 2>
    works_outside(const State<dim> &state, double time) const;

    const Models<dim>              &models;
    const FluidModel<dim>          &model;
    const dealii::Tensor<1, dim>    gravity;
    const FluidGeometry<dim> *const cut;
  };
} // namespace undine

#endif
