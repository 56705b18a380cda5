// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_factorisation_work_h
#define undine_solid_solvers_factorisation_work_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// How often factors of a tangent are used before they are made anew.
  enum class FactorUse
  {
    a_few_solves,  ///< of bodies alone
    preconditioner ///< of bodies and fluid: in every iteration of several solves
  };

  /// Up to how many operations a factorisation is cheaper than multigrid, and takes no more memory
  /// than there is: for a few solves 7e9, which are 30000 unknowns of a square, 6000 of a cube.
  /// Elements with a dilatation of their own need more iterations: at a Poisson's ratio of 0.48 in
  /// 3D both cost the same with 20000 unknowns, at 0.4999 the iteration does not converge. For a
  /// preconditioner 2e11: 27000 unknowns of a cube. (Of cubes with 15000 and 47000 the linear
  /// systems took 0.55 and 0.86 of the time with multigrid, but 1.4 and 2 times the memory; of two
  /// sheets one element thick with 72000 altogether, which are 6e10, 0.45 of the time.)
  double
  most_work_of_factors(FactorUse use, bool with_dilatation);

  /// The approximate number of operations of a factorisation of the bodies' tangent: the sum over
  /// bodies of n w^2, where the n unknowns lie in a row of slices of w along the direction with the
  /// most elements. A thin sheet or a slender bar takes far fewer than a cube with as many
  /// unknowns. Collective.
  template <int dim>
  double
  factorisation_work(const SolidModel<dim> &model);
} // namespace undine

#endif
