// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/step/solid_equations.h>

namespace undine
{
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::reactions(const Vector &velocity)
  {
    const Vector forces = full_residual(velocity);
    Vector       result = model.vector();
    // Given nodal forces act un-averaged, and so do supports against them.
    const double weight = coefficients.sum_of_weights();
    for (const auto &fixed : model.fixed())
      {
        const double given = nodal_forces.size() > 0 ? nodal_forces(fixed.dof) : 0.;
        result(fixed.dof)  = (forces(fixed.dof) + given) / weight - given;
      }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  /// Of reactions() what the balance of the step holds at fixed degrees of freedom [N].
  template <int dim>
  typename SolidEquations<dim>::Vector
  SolidEquations<dim>::weighted(const Vector &reactions) const
  {
    Vector       result = model.vector();
    const double weight = coefficients.sum_of_weights();
    for (const auto &fixed : model.fixed())
      {
        const double given = nodal_forces.size() > 0 ? nodal_forces(fixed.dof) : 0.;
        result(fixed.dof)  = weight * (reactions(fixed.dof) + given) - given;
      }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                        \
  template SolidEquations<dim>::Vector SolidEquations<dim>::reactions(const Vector &); \
  template SolidEquations<dim>::Vector SolidEquations<dim>::weighted(const Vector &) const;

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
