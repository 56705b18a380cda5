// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_linearised_bodies_h
#define undine_coupled_immersed_linearised_bodies_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/viscosity/body_impedance.h>
#include <undine/operators/turning_stress.h>
#include <undine/solid/solvers/tangent_preconditioner.h>
#include <undine/solid/solvers/tangent_solver.h>
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  /// The impedance of the bodies in a stage: their equations R (SolidEquations), with the loads by
  /// pressures L of the fluid at the end of the last stage, linearised where they are at its begin,
  /// supports having moved,
  ///
  ///     Z = dR/du (u0),   load = L - R(u0),
  ///
  /// each with the forces of TurningStress.
  template <int dim>
  class LinearisedBodies : public BodyImpedance<dim>
  {
  public:
    using Vector  = typename BodyImpedance<dim>::Vector;
    using Vectors = typename BodyImpedance<dim>::Vectors;
    using Matrix  = typename SolidModel<dim>::Matrix;

    /// For the model's bodies.
    struct Solvers
    {
      explicit Solvers(const SolidModel<dim> &model)
        : preconditioner(model)
        , motion(model)
      {
      }

      TangentPreconditioner<dim> preconditioner; ///< of Z
      TangentSolver<dim>         motion;         ///< of supports
    };

    /// A stage begins from what `state` holds, in a fluid with `viscosity` [Pa s]. The references
    /// to models and solvers must outlive this. Collective. Throws SolveError.
    LinearisedBodies(const Models<dim>           &models,
                     const Matrix                &mass,
                     const SolidEnvironment<dim> &environment,
                     const FluidGeometry<dim>    &geometry,
                     const State<dim>            &state,
                     const Stage                 &stage,
                     double                       viscosity,
                     TimingTree                  &timing,
                     Solvers                     &solvers);

    Vector
    vector() const override;
    const Vector &
    load() const override
    {
      return all_but_friction;
    }
    const Vectors &
    velocities() const override
    {
      return of_surfaces;
    }
    Vectors
    on_surfaces(const Vector &change) const override;
    void
    add_friction_of_motion(Vectors &forces, const Vectors &velocities) const override
    {
      turning_stress.add_forces(forces, velocities);
    }
    Vector
    on_bodies(const Vectors &forces) const override;
    Vector
    force(const Vector &change) const override;
    double
    rounding(const Vector &change) const override;
    void
    prepare(const std::array<NodeDampings, dim> &damping) override;
    Vector
    approximate_change(const Vector &force) const override;

  private:
    template <class Action>
    void
    for_each_entry(const std::array<NodeDampings, dim> &damping, const Action &action) const;
    Vector
    by_turning_stress(const Vectors &velocities) const;

    const Models<dim>          &models;
    TangentPreconditioner<dim> &preconditioner;
    const TurningStress<dim>    turning_stress;
    Matrix                      tangent;
    Vector                      displacement; ///< where it is that [m]
    Vector                      all_but_friction;
    Vectors                     of_surfaces;
  };
} // namespace undine

#endif
