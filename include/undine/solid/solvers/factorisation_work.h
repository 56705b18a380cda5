// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_factorisation_work_h
#define undine_solid_solvers_factorisation_work_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// Up to so many operations a factorisation is cheaper than multigrid: 30000 unknowns of a
  /// square, 6000 of a cube. Elements with a dilatation of their own need more iterations: at a
  /// Poisson's ratio of 0.48 in 3D both cost the same with 20000 unknowns, at 0.4999 the iteration
  /// does not converge.
  struct MostWork
  {
    static constexpr double of_factors                 = 7e9;
    static constexpr double of_factors_with_dilatation = 8e10;
  };

  /// The approximate number of operations of a factorisation of the bodies' tangent: the sum over
  /// bodies of n w^2, where the n unknowns lie in a row of slices of w along the direction with the
  /// most elements. A thin sheet or a slender bar takes far fewer than a cube with as many
  /// unknowns. Collective.
  template <int dim>
  double
  factorisation_work(const SolidModel<dim> &model);
} // namespace undine

#endif
