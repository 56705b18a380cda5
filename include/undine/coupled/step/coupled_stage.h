// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_coupled_stage_h
#define undine_coupled_step_coupled_stage_h

#include <undine/coupled/budget/budget.h>
#include <undine/coupled/state/state.h>
#include <undine/coupled/step/coupled_equations.h>
#include <undine/fluid/fluid_stage.h>
#include <undine/solid/solvers/tangent_solver.h>
#include <undine/solid/step/solid_stepper.h>

#include <memory>
#include <optional>
#include <string>

namespace undine
{
  /// The simultaneous solution (C1) of bodies and fluid in one stage of a step, with everything
  /// that lives only that long.
  template <int dim>
  class CoupledStage
  {
  public:
    using Vector = BlockSystem::Vector;

    /// The objects that it uses; all must outlive it.
    struct Parts
    {
      const Models<dim>                      &models;
      const typename SolidModel<dim>::Matrix &mass;
      const SolidEnvironment<dim>            &environment;
      const FluidGeometry<dim>               &geometry;
      BlockSolver<dim>                       &solver;
      TangentSolver<dim>                     &motion_solver;  ///< for bodies alone
      BlockSolver<dim>                       &impulse_solver; ///< for what contact does
      TimingTree                             &timing;
    };

    /// `state` holds u^n and, in the fluid, v*, which gets the velocities of inflows and walls.
    /// `boundary_flux`: `initial` or `swept`, see make_surface_flux(). Collective. Throws
    /// InputError, SolveError.
    CoupledStage(const Parts           &parts,
                 const FluidStage<dim> &fluid,
                 State<dim>            &state,
                 const std::string     &boundary_flux);

    /// The state becomes that of t^{n+1}. `found`: u^{n+1} of an earlier solution of
    /// this stage; empty: there is none. Collective. Throws SolveError.
    SolidReport<dim>
    solve(const Vector &found);

    /// u^{n+1}, after solve() [m/s].
    const Vector &
    velocity_of_bodies() const
    {
      return x.block(0);
    }

    /// What forces of contact have contributed to the fluid's velocity that is not kept as a rate,
    /// after solve() [m/s]; empty: nothing touches, or later stages need not know.
    const std::optional<Velocity<dim>> &
    velocity_by_contact() const
    {
      return fluid_by_contact;
    }

    /// The forces on all nodes of surfaces by the pressures of contact, if impulses are asked for.
    const ContactForces<dim> &
    pressures_of_contact() const
    {
      return forces_by_contact;
    }

    /// v* with the velocities of inflows and walls [m/s].
    const Velocity<dim> &
    velocity_before_pressures() const
    {
      return predicted;
    }

    /// max |D v + B u| per face of a cell and speed after solve() [1].
    double
    divergence() const;

    /// p after solve(), with what changes of contact take of it and the levels of closed regions as
    /// they were solved for [Pa]. Collective.
    Field<dim>
    pressure() const;

    /// The terms of the budget after solve(). Collective. @{
    PressureBalance<dim>
    pressure_balance() const;
    SurfaceExchange<dim>
    exchange() const;
    SolidBalance<dim>
    solid_balance() const;
    /// @}

  private:
    double
    solve_round(NewtonReport        &report,
                const NewtonOptions &options,
                const Vector        &found,
                bool                 goes_on = false);
    NewtonReport
    solve_from(const Vector        &velocity,
               const Vector        &pressure,
               const NewtonOptions &options,
               bool                 has_tangent = false);
    void
    end(SolidReport<dim> &report);
    ContactResponse
    respond_to_contact();
    Vector
    loads_besides_pressure();
    FollowerPressure<dim>
    make_follower() const;

    const Parts                             parts;
    const FluidStage<dim>                  &fluid;
    State<dim>                             &state;
    const NewtonOptions                    &newton;
    const double                            end_time;
    const SolidState                        old_solid;
    SurfaceExchange<dim>                    surfaces; ///< only what is known beforehand
    SolidEquations<dim>                     equations;
    const PressureNumbers<dim>              numbers;
    const std::unique_ptr<SurfaceFlux<dim>> surface;
    const FollowerPressure<dim>             follower;
    PressureEquations<dim>                  pressures;
    CoupledEquations<dim>                   problem;
    BlockSystem::BlockVector                x; ///< u^{n+1}, p
    Vector                                  last_pressure;
    Velocity<dim>                           predicted; ///< v*
    std::optional<Velocity<dim>>            fluid_by_contact;
    ContactForces<dim>                      forces_by_contact;
    typename SurfaceExchange<dim>::Vectors  on_nodes;  ///< forces of pressures on the bodies [N]
    Vector                                  reactions; ///< with which the stage balances [N]
    ContactResponse                         bodies_by_contact;
    double                                  divergence_left = 0;
  };
} // namespace undine

#endif
