// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_factorisation_work_h
#define undine_solid_factorisation_work_h

#include <undine/solid/solid_model.h>

namespace undine
{
  /// About how many operations a factorisation of the bodies' tangent takes: the sum over bodies of
  /// n w^2, where the n unknowns lie in a row of slices of w along the direction with the most
  /// elements. A thin sheet or a slender bar takes far fewer than a cube with as many unknowns.
  /// Collective.
  template <int dim>
  double
  factorisation_work(const SolidModel<dim> &model);
} // namespace undine

#endif
