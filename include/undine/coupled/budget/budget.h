// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_budget_h
#define undine_coupled_budget_budget_h

#include <undine/base/core/column.h>
#include <undine/coupled/model/models.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/pressure/pressure_balance.h>
#include <undine/solid/step/solid_balance.h>

#include <array>
#include <optional>
#include <vector>

namespace undine
{
  /// Forces and velocities that fluid and surfaces exchanged in a step, [nodes of all surfaces],
  /// those of bodies first.
  template <int dim>
  struct SurfaceExchange
  {
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    Vectors by_fluid; ///< B^T p with the B of the cut grid and the p that accelerated the fluid [N]
    Vectors by_surface_flux; ///< the same with the B of the surface flux [N]
    Vectors velocities;      ///< w, the velocity in the surface flux B w [m/s]
    Vectors on_bodies;       ///< J p, the load on the bodies [N]
    Vectors at_rest;         ///< the other loads on bodies: weight of the fluid, void regions [N]
    Vectors friction;        ///< forces of friction on surfaces [N]; empty without
    Vectors increment;       ///< d^{n+1} - d^n of bodies [m]
  };


  /// The steps of which a budget is kept. Those of several stages keep rates (Stage): what earlier
  /// stages do is a term of their budget.
  enum class BudgetOf
  {
    nothing,
    steps_of_one_stage,
    steps_of_several_stages
  };


  /// Where energy and momentum of a step come from and go to, each term from its own formula, and
  /// what is missing in the sum. A budget of nothing does nothing and costs nothing.
  template <int dim>
  class Budget
  {
  public:
    /// The phases of a stage that change the fluid's velocity before the pressures.
    enum Phase
    {
      transport, ///< also to the new topology of the fluid
      forces,
      diffusion,
      boundary_values ///< velocities given on inflows and walls
    };

    /// `models` must outlive it.
    Budget(const Models<dim> &models, BudgetOf kept);

    /// False if the budget is kept of nothing: all functions do nothing and there are no columns.
    bool
    is_on() const
    {
      return kept != BudgetOf::nothing;
    }

    /// From now on bodies that sleep count as obstacles; `surface`: that in which only the others
    /// move.
    void
    follow(const ImmersedSurface<dim> *surface);

    /// A step begins; with a fluid: with v^n, collective. @{
    void
    start();
    void
    start(const Velocity<dim> &velocity);
    /// @}

    /// Stages that keep rates (Stage): the budget of the last one is that of a step from its start.
    /// What leads to that start, by the rates of earlier stages, is a term of its own for bodies,
    /// and included in `transport` for the fluid. To be called with the bodies at t^n, then with
    /// those at the last stage's start. @{
    void
    start(const SolidAmounts<dim> &bodies);
    void
    add(const SolidAmounts<dim> &bodies);
    /// @}

    /// A phase has led to `velocity`, or effect number `effect` of `models` in that phase has; its
    /// energy is `work` [J], of this rank, by the effect's own formula, or if that is empty the
    /// change of the kinetic energy. Collective. @{
    void
    add(Phase phase, const Velocity<dim> &velocity);
    void
    add(Phase                        phase,
        unsigned int                 effect,
        const Velocity<dim>         &velocity,
        const std::optional<double> &work);
    /// @}

    /// What followed in a step of `dt` [s]; boundary_values are what pressures found changed.
    /// @{
    void
    add(const PressureBalance<dim> &pressures, double dt);
    void
    add(const SurfaceExchange<dim> &surfaces, double dt);
    void
    add(const SolidBalance<dim> &solid, double dt);
    /// @}

    /// Forget what has been added since `earlier` was copied from this: a part of the step is
    /// solved again.
    void
    go_back_to(const Budget &earlier);

    /// Energy and momentum taken from bodies that fell asleep.
    void
    add_rest(const SolidAmounts<dim> &rest);

    /// The terms as gains of fluid and bodies, energies in J, momenta in kg m/s (in 2D per metre).
    /// After them "energy by NAME" for every effect that is on: what of the terms is due to it.
    /// "energy closure": |gain - sum of terms| over energy and |terms|. "momentum closure": the
    /// same over h sum_i |(B^T p)_i| or, where no surface feels the fluid, over |terms|. None if
    /// off.
    Columns
    columns() const;

  private:
    enum Term
    {
      // fluid
      by_transport,
      by_forces,
      by_diffusion,
      by_boundary_values,
      by_sides,    ///< where the velocity is given
      by_openings, ///< where the pressure is given
      by_projection,
      // surfaces
      by_obstacles,
      by_interface, ///< what bodies get less what the fluid gives
      by_fluid_at_rest,
      by_friction, ///< what bodies get; the fluid gives it by diffusion
                   // bodies
      by_loads,
      by_supports,
      by_damping,
      by_contact,    ///< in energy the integrator's: work and gain of the potential
      by_inertia,    ///< of the integrator
      by_elasticity, ///< of the integrator
      by_stages,     ///< the earlier ones
      by_sleep,      ///< taken from bodies that fall asleep
      n_terms
    };

    static_assert(int(by_boundary_values) == int(boundary_values), "phases are the first terms");

    struct Amount
    {
      double                 energy = 0;
      dealii::Tensor<1, dim> momentum;
    };

    static const char *const names[n_terms];

    bool
    concerns(unsigned int term) const;
    Amount
    missing() const;
    Amount
    amount(const Velocity<dim> &velocity) const;
    void
    add_effects(Columns &columns) const;

    const Models<dim>          &models;
    const BudgetOf              kept;
    const bool                  has_contact;
    const bool                  has_sleep;
    const ImmersedSurface<dim> *surface; ///< nullptr: none
    Amount                      fluid;   ///< what it has, as far as the step has come
    Amount                      bodies;  ///< what they had at t^n
    Amount                      gain;
    std::array<Amount, n_terms> terms;
    std::vector<double>         by_effect;            ///< [J]
    double                      energy           = 0; ///< of fluid and bodies
    double                      impulse_of_fluid = 0; ///< h sum_i |(B^T p)_i|
  };
} // namespace undine

#endif
