// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_linearised_bodies_h
#define undine_coupled_immersed_linearised_bodies_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/viscosity/body_impedance.h>
#include <undine/solid/solvers/tangent_preconditioner.h>
#include <undine/solid/step/solid_equations.h>

#include <optional>

namespace undine
{
  /// The impedance of the bodies in a stage: their equations R (SolidEquations), with the pressures
  /// that the last stage has left, linearised where they are at its begin,
  ///
  ///     Z = dR/du (u0),   load = B^T q - R(u0).
  template <int dim>
  class LinearisedBodies : public BodyImpedance<dim>
  {
  public:
    using Vector  = typename BodyImpedance<dim>::Vector;
    using Vectors = typename BodyImpedance<dim>::Vectors;
    using Matrix  = typename SolidModel<dim>::Matrix;

    /// A stage begins that leads from `start` over `dt` [s] to `stage.end` of the step; `state`
    /// holds u^0 and, for the fluid as it is cut now, the pressures q. Keeps a reference to
    /// `models`; the others must live as long. Collective. Throws SolveError.
    LinearisedBodies(const Models<dim>            &models,
                     const Matrix                 &mass,
                     const SolidEnvironment<dim>  &environment,
                     const FluidGeometry<dim>     &geometry,
                     const State<dim>             &state,
                     const dealii::Tensor<1, dim> &gravity,
                     const Stage                  &stage,
                     TimingTree                   &timing);

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
    Vector
    on_bodies(const Vectors &forces) const override;
    Vector
    force(const Vector &change) const override;
    void
    prepare(const Vectors &damping) override;
    Vector
    approximate_change(const Vector &force) const override;

  private:
    void
    linearise(const Vector &velocity);

    const Models<dim>                 &models;
    SolidEquations<dim>                equations;
    Matrix                             tangent;
    Vector                             displacement; ///< where it is that [m]
    Vector                             all_but_friction;
    Vectors                            of_surfaces;
    mutable TangentPreconditioner<dim> preconditioner;
  };
} // namespace undine

#endif
