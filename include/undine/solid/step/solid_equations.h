// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_solid_equations_h
#define undine_solid_step_solid_equations_h

#include <undine/solid/assembly/norms_by_body.h>
#include <undine/solid/solvers/symmetry.h>
#include <undine/solid/step/rayleigh_damping.h>
#include <undine/solid/step/step_contact.h>

#include <vector>

namespace undine
{
  /// What forces of contact that are not part of the rate at the end of a step do in it.
  struct ContactResponse
  {
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    Vector velocity;  ///< that is not kept as a rate, with the fluid's inertia [m/s]; empty: none
    Vector by_change; ///< that of the change of contact (S24) [m/s]; empty: none
    Vector pressures; ///< forces on the bodies by which a fluid answers that, or without rates the
                      ///< forces of contact [N]; empty: none
  };

  /// The balance of momentum over one step (T1), with StageCoefficients, as equations for the end
  /// velocity u = u^{n+1}: residual, Jacobian and what u makes of the state. Fixed degrees of
  /// freedom have a zero residual and a diagonal Jacobian; u has to carry the prescribed velocity
  /// there, which guess() does, and d^{n+1} is the prescribed displacement exactly. All functions
  /// that take or return vectors are collective.
  template <int dim>
  class SolidEquations
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// From `old_state` at `time` [s] over `dt` [s]. `mass` is mass_matrix(model). `nodal_forces`
    /// [N] act during the whole step and enter the momentum once, as J p does; empty: none. Forces
    /// of contact (`environment`), at the end of the step, count alike, in stages as in (T1).
    /// `begin` is where a stage began that starts from elsewhere. The references to model, mass,
    /// state, environment and timing must outlive the equations. Collective. Throws SolveError.
    SolidEquations(const SolidModel<dim>       &model,
                   const Matrix                &mass,
                   const SolidState            &old_state,
                   const SolidEnvironment<dim> &environment,
                   double                       time,
                   double                       dt,
                   TimingTree                  &timing,
                   const Vector                &nodal_forces = {},
                   const ContactStart          &contact      = {},
                   const StageBegin            &begin        = {});

    /// A first u [m/s]: u^n, or where bodies touch the one that leads where they are expected
    /// (ContactStart), with prescribed velocities in place.
    Vector
    guess() const
    {
      return contact.guess(motion);
    }

    /// A first u [m/s] that keeps d^{n+1} = d^n, the point at which one Newton correction is a
    /// linearisation at d^n. Fixed degrees of freedom have moved, so that this is admissible only
    /// with the change of u that motion_predictor() gives.
    Vector
    guess_at_rest() const
    {
      return motion.guess_at_rest();
    }

    /// The u nearest to `guess`, on the segment that begins at the velocity which leads to the last
    /// position of the bodies (ContactStart), up to which no gap closes (Contact). `guess` itself
    /// without contact, and where bodies can get there on a straight way. Throws SolveError if
    /// supports or obstacles alone close a gap. Collective.
    Vector
    kept_apart(const Vector &guess) const
    {
      return contact.kept_apart(guess, motion);
    }

    /// The fraction of `correction` that can be added to `velocity` without closing a gap [1].
    /// Collective.
    double
    collision_free_fraction(const Vector &velocity, const Vector &correction) const
    {
      return contact.collision_free_fraction(velocity, correction, motion);
    }

    /// matrix times the unknown = right_side.
    struct LinearSystem
    {
      Matrix matrix;
      Vector right_side;
    };

    /// Do fixed degrees of freedom move during the step?
    bool
    has_motion() const
    {
      return motion.prescribed_increment().linfty_norm() > 0;
    }

    /// Linearised at d^n: the change of u at free degrees of freedom by which the bodies follow the
    /// prescribed motions, A_ff du_f = -A_fg dd_g / (d d^{n+1} / du).
    LinearSystem
    motion_predictor() const;

    /// More nodal forces [N] that act during the whole step.
    void
    add_forces(const Vector &more);

    /// The left side of the balance for u [N], zero at fixed degrees of freedom. Throws SolveError
    /// where a point is inverted. Collective.
    Vector
    residual(const Vector &velocity);

    /// Forces of the supports on the bodies at fixed degrees of freedom [N], zero elsewhere: the
    /// left side of the balance there, divided by the sum of the stages' weights, except given
    /// nodal forces and those of contact, which are not averaged. Throws as residual() does.
    /// Collective.
    Vector
    reactions(const Vector &velocity);

    /// The balance of linear momentum of each body, in which inner forces cancel, [bodies] [1]:
    ///
    ///     | sum over its nodes of  M (m u + m_u u^n + m_a a^n) + alpha M u_C
    ///                              - loads - contact - supports |  /  size
    ///
    /// by the size of the forces on the body itself, as in norm().
    ///
    /// `reactions` are those of the same u. Collective. Throws SolveError as residual() does.
    std::vector<double>
    momentum_residuals(const Vector &velocity, const Vector &reactions) const;

    /// Energy and momentum of the step that ends with `velocity`, for the `reactions` of the same.
    /// Costs several evaluations of internal forces. Collective.
    SolidBalance<dim>
    balance(const Vector &velocity, const Vector &reactions, const Vector &by_contact) const;

    /// d residual / du [kg/s], with a diagonal of its own size at fixed degrees of freedom; a
    /// convex one has contact's convex stiffness.
    Matrix
    jacobian(const Vector &velocity, Tangent kind = Tangent::exact) const;

    /// d^{n+1} [m].
    Vector
    displacement(const Vector &velocity) const
    {
      return motion.displacement(velocity);
    }

    /// d^{n+1} - d^n [m], without what rounding leaves of the difference of both.
    Vector
    increment(const Vector &velocity) const
    {
      return motion.increment(velocity);
    }

    /// d d^{n+1} / du at free degrees of freedom [s].
    double
    displacement_factor() const
    {
      return coefficients.displacement;
    }

    /// StepContact::change() and beside_rates() [N], zero at fixed degrees of freedom. Collective.
    /// @{
    Vector
    change_of_contact(const Vector &velocity) const;
    Vector
    contact_beside_rates(const Vector &velocity) const;
    /// @}

    /// Is what the change of contact does left out of the rates that are kept?
    bool
    leaves_out_change() const
    {
      return contact.keeps_rate_at_end();
    }

    /// What these do in the step to bodies without a fluid. Collective.
    ContactResponse
    contact_response(const Vector &velocity) const;

    /// The `reactions` at the end of the step, where f_c of contact is borne once, whatever acts in
    /// the stage beside it (S22). Collective.
    Vector
    reactions_at_end(const Vector          &reactions,
                     const Vector          &velocity,
                     const ContactResponse &by_contact) const;

    /// The state at the end of the step. The acceleration that the integrator or later stages use
    /// leaves out what is `by_contact`. Collective.
    SolidState
    end_state(const Vector &velocity, const ContactResponse &by_contact) const;

    /// Of jacobian(): follower pressures and viscosity of bodies make it unsymmetric.
    Symmetry
    symmetry() const
    {
      return has_pressure || rayleigh_damping.is_viscous() ? Symmetry::none : Symmetry::symmetric;
    }

    /// Does the step leave out inertia?
    bool
    is_static() const
    {
      return coefficients.mass == 0;
    }

    /// Size of the terms of the residual evaluated last [N], and the norm that rounding gives their
    /// sum [N]. @{
    double
    scale() const;
    double
    rounding() const
    {
      return own_rounding;
    }
    /// @}

    /// The norm of a residual in which every body counts in proportion to the forces on it: scale()
    /// times the root mean square over the bodies of |r_b| / size_b, sizes being at least 1e-6 of
    /// scale() and not so small that rounding would matter (T6) [N]. Of one body the l2 norm.
    /// Collective.
    double
    norm(const Vector &residual) const;

    /// That norm of what rounding() is the l2 norm of [N].
    double
    norm_of_rounding() const
    {
      return weighted_norm(rounding_by_body);
    }

  private:
    Vector
    full_residual(const Vector &velocity);
    Vector
    weighted(const Vector &reactions, const Vector &velocity) const;
    Vector
    not_averaged(const Vector &velocity) const;
    Vector
    inertia(const Vector &velocity) const;
    void
    add_level_forces(Vector                             &forces,
                     const StageCoefficients::TimeLevel &level,
                     const Vector                       &displacement);
    Matrix
    full_jacobian(const Vector &velocity,
                  const Vector &end_displacement,
                  const Vector &in_contact,
                  Tangent       kind) const;
    void
    find_known_forces();
    void
    note_size(const Vector &term, double factor);
    std::vector<double>
    sizes() const;
    double
    weighted_norm(const std::vector<double> &norms) const;

    const SolidModel<dim>       &model;
    const Matrix                &mass;
    const SolidState            &old_state;
    const SolidEnvironment<dim> &environment;
    const double                 time;
    const double                 dt;
    TimingTree                  &timing;
    Vector                       nodal_forces;
    const StageCoefficients      coefficients;
    const StepMotion<dim>        motion;
    const RayleighDamping<dim>   rayleigh_damping;
    const StepContact<dim>       contact;
    const bool                   has_pressure;
    const NormsByBody<dim>       norms_by_body;
    std::vector<double>          largest_known;    ///< sizes of the terms without u, by body [N]
    std::vector<double>          largest_term;     ///< of all terms [N]
    std::vector<double>          rounding_by_body; ///< [N]
    double                       own_rounding;     ///< of all [N]
    Vector                       dead;             ///< loads that do not depend on u, weighted [N]
    Vector                       known; ///< terms of the residual without u, but for inertia [N]
  };
} // namespace undine

#endif
