// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/step/rayleigh_damping.h>

namespace undine
{
  template <int dim>
  RayleighDamping<dim>::RayleighDamping(const SolidModel<dim>       &model,
                                        const Matrix                &mass,
                                        const SolidEnvironment<dim> &environment,
                                        TimingTree                  &timing)
    : model(model)
    , mass(mass)
    , environment(environment)
    , timing(timing)
  {
  }


  template <int dim>
  void
  RayleighDamping<dim>::assemble(const StepMotion<dim> &motion)
  {
    const auto &coefficients = motion.coefficients();
    const auto &old_state    = motion.old_state();
    if (!(environment.stiffness_damping > 0 && coefficients.damping != 0))
      return;
    const auto timed        = timing.section("damping");
    Vector     displacement = old_state.displacement;
    displacement.add(coefficients.damping_position * motion.dt(), old_state.velocity);
    try
      {
        stiffness.reinit(model.matrix());
        stiffness.add(1., internal_stiffness(model, displacement));
      }
    catch (const SolveError &)
      {
        // The extrapolation may invert a cell where d^n does not.
        stiffness.add(1., internal_stiffness(model, old_state.displacement));
      }
    timing.memory.hold_briefly("damping", stiffness.memory_consumption());
  }


  template <int dim>
  void
  RayleighDamping<dim>::add_forces(Vector       &forces,
                                   const Vector &velocity,
                                   const double  factor) const
  {
    if (environment.mass_damping == 0 && stiffness.m() == 0)
      return;
    const auto timed   = timing.section("damping");
    Vector     product = model.vector();
    if (environment.mass_damping > 0)
      {
        mass.vmult(product, velocity);
        forces.add(factor * environment.mass_damping, product);
      }
    if (stiffness.m() > 0)
      {
        stiffness.vmult(product, velocity);
        forces.add(factor * environment.stiffness_damping, product);
      }
  }


  template <int dim>
  void
  RayleighDamping<dim>::add_stiffness(Matrix &A, const double factor) const
  {
    if (stiffness.m() > 0)
      A.add(factor * environment.stiffness_damping, stiffness);
  }


  template class RayleighDamping<2>;
  template class RayleighDamping<3>;
} // namespace undine
