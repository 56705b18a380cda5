// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_balance_terms_h
#define undine_solid_step_balance_terms_h

#include <undine/solid/step/solid_balance.h>
#include <undine/solid/step/step_motion.h>

namespace undine
{
  /// Terms of the balance of energy and momentum over the step that ends with `velocity`, whose
  /// displacement increment is dd. Collective. @{

  /// The sum of nodal forces over all bodies [N].
  template <int dim>
  dealii::Tensor<1, dim>
  resultant(const SolidModel<dim> &model, const typename SolidModel<dim>::Vector &forces);

  /// Set kinetic, inertia_loss, momentum and inertia_gap, given `force` = M (m u + m_u u^n +
  /// m_a a^n) [N].
  template <int dim>
  void
  balance_inertia(SolidBalance<dim>                      &result,
                  const StepMotion<dim>                  &motion,
                  const typename SolidModel<dim>::Matrix &mass,
                  const typename SolidModel<dim>::Vector &force,
                  const typename SolidModel<dim>::Vector &velocity,
                  const typename SolidModel<dim>::Vector &displacement_increment);

  /// Set elastic, elastic_work and elastic_loss. `end` is d^{n+1} [m], `rounding` what rounding
  /// leaves of forces [N]. Costs several evaluations of internal forces.
  template <int dim>
  void
  balance_elasticity(SolidBalance<dim>                      &result,
                     const StepMotion<dim>                  &motion,
                     const typename SolidModel<dim>::Vector &end,
                     const typename SolidModel<dim>::Vector &displacement_increment,
                     double                                  rounding);
  /// @}
} // namespace undine

#endif
