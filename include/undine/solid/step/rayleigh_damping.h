// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_rayleigh_damping_h
#define undine_solid_step_rayleigh_damping_h

#include <undine/base/core/timing.h>
#include <undine/solid/assembly/solid_environment.h>
#include <undine/solid/step/step_motion.h>

namespace undine
{
  /// C = alpha M + eta K'(d^n + r h u^n) in one step, with alpha and eta of the environment;
  /// nothing without damping. All functions are collective.
  template <int dim>
  class RayleighDamping
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    /// The references must outlive it.
    RayleighDamping(const SolidModel<dim>       &model,
                    const Matrix                &mass,
                    const SolidEnvironment<dim> &environment,
                    TimingTree                  &timing);

    /// Assemble K', if the step needs it. Before the first of the following calls. Throws
    /// SolveError.
    void
    assemble(const StepMotion<dim> &motion);

    /// forces += factor C velocity.
    void
    add_forces(Vector &forces, const Vector &velocity, double factor) const;

    /// A += factor eta K'.
    void
    add_stiffness(Matrix &A, double factor) const;

  private:
    const SolidModel<dim>       &model;
    const Matrix                &mass;
    const SolidEnvironment<dim> &environment;
    TimingTree                  &timing;
    Matrix                       stiffness; ///< K'; empty without it
  };
} // namespace undine

#endif
