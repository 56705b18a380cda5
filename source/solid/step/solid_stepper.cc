// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/interruption.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/solid/assembly/cell_forces.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/assembly/mass_matrix.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/solvers/mass_solve.h>
#include <undine/solid/step/initial_guesses.h>
#include <undine/solid/step/solid_columns.h>
#include <undine/solid/step/solid_equations.h>
#include <undine/solid/step/solid_stepper.h>

#include <fmt/format.h>

#include <memory>

namespace undine
{
  namespace
  {
    /// The equations of a step in the form that solve_newton() asks for.
    template <int dim>
    class StepProblem
    {
    public:
      using Unknown = typename SolidModel<dim>::Vector;
      using Matrix  = typename SolidModel<dim>::Matrix;

      StepProblem(SolidEquations<dim> &equations, TangentSolver<dim> &solver, TimingTree &timing)
        : equations(equations)
        , solver(solver)
        , timing(timing)
      {
        solver.begin_stage(equations.symmetry());
      }

      double
      evaluate(const Unknown &velocity)
      {
        residual = equations.residual(velocity);
        return equations.norm(residual);
      }

      Unknown
      correction(const Unknown &velocity, const CorrectionRequest &request)
      {
        throw_if_interrupted(velocity.get_mpi_communicator());
        if (request.new_tangent)
          {
            jacobian =
              std::make_unique<const Matrix>(equations.jacobian(velocity, request.tangent));
            solver.initialize(*jacobian, equations.displacement(velocity));
          }
        const auto timed  = timing.section("solve linear system");
        auto       change = solver.solve(residual, request.reduction);
        change *= -1.;
        const double part = equations.collision_free_fraction(velocity, change);
        if (part < 1)
          change *= part;
        return change;
      }

      double
      slope(const Unknown &change) const
      {
        return residual * change;
      }

      double
      part_left() const
      {
        return solver.part_left();
      }

      double
      scale() const
      {
        return equations.scale();
      }

      double
      rounding() const
      {
        return equations.norm_of_rounding();
      }

      unsigned int
      linear_iterations() const
      {
        return solver.iterations();
      }

    private:
      SolidEquations<dim> &equations;
      TangentSolver<dim>  &solver;
      TimingTree          &timing;
      Unknown              residual;

      std::unique_ptr<const Matrix> jacobian;
    };


    /// Throws InputError on all ranks if the initial displacement inverts a body whose law does not
    /// tolerate that.
    template <int dim>
    void
    assert_not_inverted(const typename SolidModel<dim>::Vector &displacement,
                        const SolidModel<dim>                  &model)
    {
      const auto     &geometry = model.geometry();
      const auto      ghosted  = model.ghosted(displacement);
      CellForces<dim> cell_forces(model);
      std::string     failure;
      for (unsigned int cell = 0; cell < geometry.n_cells() && failure.empty(); ++cell)
        {
          const auto &body = model.bodies()[geometry.body(cell)];
          cell_forces.reinit(cell, ghosted);
          for (unsigned int q = 0; q < geometry.n_points() && failure.empty(); ++q)
            if (const double J = cell_forces.stretched_volume(q);
                !(J > 0) && !body.material->tolerates_inversion())
              failure = body.options
                          .error("Initial displacement",
                                 fmt::format("leaves the body inverted (det F = {:g})", J),
                                 "Try: one that keeps the orientation of every part of body '" +
                                   body.name + "'.")
                          .what();
        }
      throw_together<InputError>(failure, model.communicator());
    }


  } // namespace


  template <int dim>
  SolidState
  start_of_bodies(const SolidModel<dim> &model)
  {
    SolidState  state{model.vector(), model.vector(), model.vector(), {}, {}};
    const auto &geometry = model.geometry();
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        const auto &body = model.bodies()[geometry.body(cell)];
        for (const auto dof : geometry.dofs(cell))
          if (model.locally_owned().is_element(dof))
            {
              const auto        &position = model.rest_position(dof);
              const unsigned int axis     = model.axis(dof);
              state.displacement(dof)     = body.displacement.value(position, 0., axis);
              state.velocity(dof)         = body.velocity.value(position, 0., axis);
            }
      }
    state.displacement.compress(dealii::VectorOperation::insert);
    state.velocity.compress(dealii::VectorOperation::insert);
    return state;
  }


  template <int dim>
  SolidStepper<dim>::SolidStepper(const SolidModel<dim> &model)
    : model(model)
    , mass_matrix(undine::mass_matrix(model))
    , solver(model)
  {
    for (const auto &body : measure_bodies(model, start_of_bodies(model).displacement))
      volumes.push_back(body.volume);
  }


  template <int dim>
  typename SolidStepper<dim>::Vector
  SolidStepper<dim>::unbalanced_forces(const SolidState            &state,
                                       const SolidEnvironment<dim> &environment,
                                       const double                 time) const
  {
    auto result  = dead_loads(model, environment, time);
    auto product = model.vector();
    result.add(1., pressure_loads(model, state.displacement, time));
    result.add(-1., internal_forces(model, state.displacement));
    mass_matrix.vmult(product, state.velocity);
    result.add(-environment.mass_damping, product);
    return result;
  }


  template <int dim>
  SolidAmounts<dim>
  SolidStepper<dim>::amounts(const SolidState &state) const
  {
    auto momenta = model.vector();
    mass_matrix.vmult(momenta, state.velocity);
    SolidAmounts<dim> result;
    result.kinetic = (momenta * state.velocity) / 2;
    result.elastic = elastic_energy(model, state.displacement);
    for (const auto &of_body : sums_by_body(model, momenta))
      result.momentum += of_body;
    return result;
  }


  template <int dim>
  const typename SolidStepper<dim>::Matrix &
  SolidStepper<dim>::mass() const
  {
    return mass_matrix;
  }


  template <int dim>
  const std::vector<double> &
  SolidStepper<dim>::initial_volumes() const
  {
    return volumes;
  }


  template <int dim>
  void
  SolidStepper<dim>::keep_balance()
  {
    keeps_balance = true;
  }


  template <int dim>
  SolidState
  SolidStepper<dim>::initialize(const SolidEnvironment<dim> &environment,
                                const double                 time,
                                const double                 dt) const
  {
    SolidState state = start_of_bodies(model);
    assert_not_inverted(state.displacement, model);
    if (environment.contact)
      environment.contact->check_start(state.displacement, time);
    prescribe_velocity(state.velocity, model, time, dt);
    if (model.numerics().integrator->uses_acceleration())
      state.acceleration = acceleration(state, environment, time, dt);
    return state;
  }


  template <int dim>
  typename SolidStepper<dim>::Vector
  SolidStepper<dim>::acceleration(const SolidState            &state,
                                  const SolidEnvironment<dim> &environment,
                                  const double                 time,
                                  const double                 dt) const
  {
    auto fixed = model.vector();
    prescribe_acceleration(fixed, model, time, dt);
    return solve_mass(model, mass_matrix, unbalanced_forces(state, environment, time), fixed);
  }


  template <int dim>
  SolidReport<dim>
  SolidStepper<dim>::step(SolidState                  &state,
                          const SolidEnvironment<dim> &environment,
                          const double                 time,
                          const double                 dt,
                          TimingTree                  &timing,
                          const Vector                &nodal_forces,
                          const ContactStart          &contact,
                          const StageBegin            &begin)
  {
    const auto          timed = timing.section("solid");
    SolidEquations<dim> equations(
      model, mass_matrix, state, environment, time, dt, timing, nodal_forces, contact, begin);
    StepProblem<dim> problem(equations, solver, timing);
    auto             velocity = model.vector();

    SolidReport<dim> report;
    const auto      &newton = model.numerics().newton;
    report.newton           = solve_from_guesses(
      equations,
      newton,
      {},
      [&] { return resting_guess(equations, solver, timing); },
      [&](const Vector &guess) {
        velocity = equations.kept_apart(guess);
        return solve_newton(problem, velocity, newton);
      });
    report.reactions          = equations.reactions(velocity);
    report.note               = solver.note();
    report.momentum_residuals = equations.momentum_residuals(velocity, report.reactions);
    const auto by_contact     = equations.contact_response(velocity);
    if (keeps_balance)
      report.balance = equations.balance(velocity, report.reactions, by_contact.velocity);
    report.reactions = equations.reactions_at_end(report.reactions, velocity, by_contact);
    state            = equations.end_state(velocity, by_contact);
    return report;
  }


  template SolidState
  start_of_bodies(const SolidModel<2> &);
  template SolidState
  start_of_bodies(const SolidModel<3> &);
  template class SolidStepper<2>;
  template class SolidStepper<3>;
} // namespace undine
