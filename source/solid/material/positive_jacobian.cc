// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/material/positive_jacobian.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  void
  assert_positive_jacobian(const double J)
  {
    // Not-a-number fails every comparison, so it is caught here too.
    if (!(J > 0 && std::isfinite(J)))
      throw SolveError(
        fmt::format("an element of a solid is inverted or its displacement is not a "
                    "number (det F = {:g}). Try smaller loads, a finer mesh where the "
                    "solid is bent most, or another time step: a smaller one if "
                    "loads or motions are sudden, a longer one if it shakes more "
                    "in shorter steps.",
                    J));
  }


  double
  positive_jacobian(const dealii::Tensor<2, 3> &F)
  {
    const double J = dealii::determinant(F);
    assert_positive_jacobian(J);
    return J;
  }
} // namespace undine
