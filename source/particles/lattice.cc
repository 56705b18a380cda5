// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/lattice.h>

#include <cmath>

namespace undine::particles
{
  Lattice
  full_lattice(const int dim, const double reach)
  {
    Lattice   lattice{0, 0, 0};
    const int layers = static_cast<int>(std::ceil(reach));
    const int side   = 2 * layers + 1;
    const int points = static_cast<int>(std::lround(std::pow(side, dim)));
    for (int point = 0; point < points; ++point)
      {
        double square = 0;
        for (int axis = 0, rest = point; axis < dim; ++axis, rest /= side)
          square += std::pow(rest % side - layers, 2);
        const double distance = std::sqrt(square);
        if (square == 0 || distance >= reach)
          continue;
        const double weight = reach / distance - 1;
        lattice.number_density += weight;
        lattice.spread += weight * square;
        lattice.filling += filling(square / (reach * reach));
      }
    lattice.spread /= lattice.number_density;
    return lattice;
  }
} // namespace undine::particles
