// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_budget_budget_h
#define undine_coupled_budget_budget_h

#include <undine/base/core/column.h>
#include <undine/base/core/stage.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/budget_amounts.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/pressure/pressure_balance.h>
#include <undine/solid/step/solid_balance.h>

#include <optional>
#include <vector>

namespace undine
{
  /// Forces and velocities that fluid and surfaces exchanged in a stage, [nodes of all surfaces],
  /// those of bodies first.
  template <int dim>
  struct SurfaceExchange
  {
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    Vectors by_fluid; ///< B^T p with the B of the cut grid and the p that accelerated the fluid [N]
    Vectors by_surface_flux;             ///< the same with the B of the surface flux [N]
    Vectors velocities;                  ///< w, the velocity in the surface flux B w [m/s]
    double  power_beside_velocities = 0; ///< of p and what the surface flux is besides B w [W]
    Vectors on_bodies;                   ///< J p, the load on the bodies [N]
    Vectors at_rest;   ///< the other loads on bodies: weight of the fluid, void regions [N]
    Vectors friction;  ///< forces of friction on surfaces [N]; empty without
    Vectors increment; ///< d^{n+1} - d^n of bodies [m]
  };


  enum class KeepBudget
  {
    no,
    yes
  };


  /// Where energy and momentum of a step come from and go to, each term from its own formula, and
  /// what is missing in the sum. A budget that is not kept does nothing and costs nothing.
  ///
  /// Stages (T10) go on with the rates of earlier times, for a length l_j with that of time j, and
  /// then with the rate at their end for the length g. So does the work of every force: that of the
  /// power P_j = F_j.v_j [W] is
  ///
  ///     sum_j l_j P_j + g P                                                               [J]
  ///
  /// over the stage, which is a quadrature of the order of the method. What the sum of it over all
  /// forces differs from the change of energy is quadratic in the rates; it is the integrator's,
  /// computed from them.
  template <int dim>
  class Budget
  {
  public:
    /// `models` must outlive it.
    Budget(const Models<dim> &models, KeepBudget kept);

    /// False if the budget is not kept: all functions do nothing and there are no columns.
    bool
    is_on() const
    {
      return kept == KeepBudget::yes;
    }

    /// From now on bodies that sleep count as obstacles; `surface`: that in which only the others
    /// move.
    void
    follow(const ImmersedSurface<dim> *surface);

    /// A step begins, with the rates (as returned by rates()) of the time at which it begins.
    void
    start(const BudgetAmounts<dim> &rates);

    /// Bodies fell asleep where the step begins: their energy and momentum, and the power and force
    /// by which these would have gone on to change, are taken from them.
    void
    add_rest(const SolidAmounts<dim> &rest, const SolidAmounts<dim> &rates);

    /// The step's stages, one after the other; between begin and end of a stage what has happened
    /// in it is added. @{
    void
    begin_stage(const Stage &stage);
    void
    end_stage();
    /// @}

    /// The fluid goes on from `begin` at the begin of the stage to `start`, its implicit step
    /// begins. Collective.
    void
    go_on(const Velocity<dim> &begin, const Velocity<dim> &start);

    /// Bodies do. `jump` holds |u^0 - u^b|^2/2 and u^b.(u^0 - u^b), both with M [J].
    struct Jump
    {
      double half_square = 0;
      double along       = 0;
    };
    void
    go_on(const SolidAmounts<dim> &begin, const SolidAmounts<dim> &start, const Jump &jump);

    /// The bodies' stage has ended; `along`: (u - u^b).(u^0 - u^b) with M [J].
    void
    end_bodies(double along);

    /// The flow has advected the fluid to `velocity`, or effect number `effect` of `models` has;
    /// its energy is `work` [J], of this rank, by the effect's own formula, or if that is empty the
    /// change of the kinetic energy. Collective. @{
    void
    transport(const Velocity<dim> &velocity);
    void
    transport(unsigned int                 effect,
              const Velocity<dim>         &velocity,
              const std::optional<double> &work);
    /// @}

    /// The effect of that number has accelerated the fluid to `velocity`: `term` is forces or
    /// diffusion; `work` as above, with the mean of the velocities before and after. Collective.
    void
    accelerate(BudgetTerm                   term,
               unsigned int                 effect,
               const Velocity<dim>         &velocity,
               const std::optional<double> &work);

    /// Pressures have led from `before`, with velocities on inflows and walls in place, to `after`.
    /// Collective.
    void
    add(const PressureBalance<dim> &pressures,
        const Velocity<dim>        &before,
        const Velocity<dim>        &after);

    /// The fluid's stage has ended with `velocity`, of which `by_contact` (or none, nullptr) is no
    /// rate that the next stage goes on with; `begin` is what the velocity at the begin of the
    /// stage has been advected to if a mean rate is kept, else nullptr. Collective.
    void
    end_fluid(const Velocity<dim> &velocity,
              const Velocity<dim> *by_contact,
              const Velocity<dim> *begin);

    /// What followed in the implicit step. @{
    void
    add(const SurfaceExchange<dim> &surfaces);
    void
    add(const SolidBalance<dim> &solid);
    /// @}

    /// Forget what has been added since `earlier` was copied from this: a part of the step is
    /// solved again.
    void
    go_back_to(const Budget &earlier);

    /// The power and force of every term at the end of the step, for the next one. Empty if no
    /// rates are kept.
    BudgetAmounts<dim>
    rates() const;

    /// Of a state at rest.
    BudgetAmounts<dim>
    rates_at_start() const;

    /// The terms as gains of fluid and bodies, energies in J, momenta in kg m/s (in 2D per metre).
    /// After them "energy by NAME" for every effect that is on: what of the terms is due to it.
    /// "energy closure": |gain - sum of terms| over energy and |terms|. "momentum closure": the
    /// same over the sizes of impulses, in the fluid, on surfaces and of all terms. None if off.
    Columns
    columns() const;

  private:
    using Amounts = BudgetAmounts<dim>;
    using Amount  = typename Amounts::Amount;

    /// The sum of the powers of all rates that are kept differs from that of the rate itself: with
    /// u, the power of a rate r is u.M r [W].
    struct Kept
    {
      double                 by_integrator = 0; ///< it belongs to another velocity [W]
      double                 by_transport  = 0; ///< rate and velocity have been advected [W]
      dealii::Tensor<1, dim> momentum;          ///< by transport [N]
    };

    /// A change of the fluid's velocity whose work is known when the stage's end is.
    struct Change
    {
      BudgetTerm    term;
      int           effect; ///< -1: none
      Velocity<dim> velocity;
      double        own_work; ///< the formula's less the measured one [J]
    };

    /// All that changes in a step.
    struct Books
    {
      Amounts              amounts; ///< of the step
      Amounts              acting;  ///< of the implicit step of the stage
      std::vector<Amounts> rates;   ///< at the begin of the step and the ends of its stages
      Amount               gain;
      double               energy           = 0; ///< sum of the sizes of what there is [J]
      double               impulse_of_fluid = 0; ///< sum of the sizes of impulses on it [N s]
      double               energy_rounding  = 0; ///< what rounding may leave [J]
      double               impulse_rounding = 0; ///< [N s]
      Stage                stage;
      bool                 knows_rates = false;
      Kept                 fluid, bodies;
      // Of the fluid in this stage.
      int                 advecting = -1;     ///< the effect that has advected the fluid, if any
      Amount              at_begin, at_start; ///< v^b and v^0
      double              begin_along = 0;    ///< v^b.(v^0 - v^b) [J]
      Velocity<dim>       advected;           ///< what v^0 has been advected to
      Velocity<dim>       last;
      double              last_energy = 0;
      std::vector<Change> changes;
    };

    static const char *
    name(BudgetTerm term);
    bool
    concerns(BudgetTerm term) const;
    Amount
    missing() const;
    Amount
    amount(const Velocity<dim> &velocity) const;
    double
    duration_of_kept() const;
    double
    mass_of_fluid() const;
    void
    add_effects(Columns &columns) const;

    const Models<dim>          &models;
    const KeepBudget            kept;
    const bool                  has_contact;
    const bool                  has_sleep;
    const ImmersedSurface<dim> *surface; ///< nullptr: none
    Books                       books;
  };
} // namespace undine

#endif
