// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_solid_stepper_h
#define undine_solid_step_solid_stepper_h

#include <undine/base/core/newton.h>
#include <undine/base/core/timing.h>
#include <undine/solid/assembly/contact.h>
#include <undine/solid/assembly/solid_environment.h>
#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_state.h>
#include <undine/solid/solvers/tangent_solver.h>
#include <undine/solid/step/solid_balance.h>
#include <undine/solid/step/stage_begin.h>

#include <optional>
#include <string>

namespace undine
{
  /// The report on a step of the bodies.
  template <int dim>
  struct SolidReport
  {
    NewtonReport newton;

    /// Forces of supports on the bodies [N] at fixed degrees of freedom, at the time level at which
    /// the integrator balances forces, what bears contact at the end of the step; zero elsewhere.
    dealii::TrilinosWrappers::MPI::Vector reactions;

    /// For each body the force that the balance of its linear momentum over the step lacks [1], of
    /// the size of the forces by which Newton's method is stopped (SolidEquations::scale).
    std::vector<double> momentum_residuals;

    /// Only if asked for, see SolidStepper::keep_balance().
    std::optional<SolidBalance<dim>> balance;

    /// A note on anything unusual, such as "the tangent is indefinite: solved directly"; empty if
    /// there was nothing.
    std::string note;
  };

  /// Displacement and velocity as the scene's expressions give them at t = 0. Collective.
  template <int dim>
  SolidState
  start_of_bodies(const SolidModel<dim> &model);

  /// Advances the bodies without a fluid.
  template <int dim>
  class SolidStepper
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// `model` must outlive it. Collective.
    explicit SolidStepper(const SolidModel<dim> &model);

    /// From now on reports hold the balance of energy and momentum, which costs time.
    void
    keep_balance();

    /// The state at `time` [s]: displacements and velocities from the scene's expressions, and for
    /// the integrators that use it the acceleration that the loads give. `dt` [s] is the step that
    /// will follow: prescribed motions are differentiated within it. Collective.
    SolidState
    initialize(const SolidEnvironment<dim> &environment, double time, double dt) const;

    /// The acceleration that loads and stresses give at `time` [s], before a step of `dt` [s].
    /// Collective.
    Vector
    acceleration(const SolidState            &state,
                 const SolidEnvironment<dim> &environment,
                 double                       time,
                 double                       dt) const;

    /// From `time` to `time + dt` [s]. `nodal_forces` [N], if not empty, act during the whole step
    /// (SolidEquations, also for `contact` and `begin`). Collective. Throws SolveError; the state
    /// is then unchanged.
    ///
    ///  1. guess u^{n+1} = u^n
    ///  2. Newton: assemble residual and tangent, solve, line search
    ///  3. if that fails, again from the guess d^{n+1} = d^n
    ///  4. d^{n+1}, u^{n+1}, a^{n+1} from u^{n+1}
    SolidReport<dim>
    step(SolidState                  &state,
         const SolidEnvironment<dim> &environment,
         double                       time,
         double                       dt,
         TimingTree                  &timing,
         const Vector                &nodal_forces = {},
         const ContactStart          &contact      = {},
         const StageBegin            &begin        = {});

    /// f - K(d) - alpha M u of a state at `time` [s], f being loads but those of a fluid and of
    /// contact, supports not counted [N]. Without the viscous stress: velocities at the start may
    /// strain the material at any rate. Collective. Throws SolveError.
    Vector
    unbalanced_forces(const SolidState            &state,
                      const SolidEnvironment<dim> &environment,
                      double                       time) const;

    /// Energy and momentum of a state. Collective.
    SolidAmounts<dim>
    amounts(const SolidState &state) const;

    /// The mass matrix M [kg].
    const Matrix &
    mass() const;

    /// Volume of each body at t = 0 [m^dim].
    const std::vector<double> &
    initial_volumes() const;

  private:
    const SolidModel<dim> &model;
    const Matrix           mass_matrix;
    std::vector<double>    volumes; ///< at t = 0
    TangentSolver<dim>     solver;
    bool                   keeps_balance = false;
  };
} // namespace undine

#endif
