// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/model/lattice.h>

#include <cmath>

namespace undine::particles
{
  Lattice
  full_lattice(const int dim, const double reach)
  {
    Lattice   lattice{0, 0, 0, 0, 0};
    double    above = 0, side = 0; // beyond a plane through a layer
    const int layers = static_cast<int>(std::ceil(reach));
    const int width  = 2 * layers + 1;
    const int points = static_cast<int>(std::lround(std::pow(width, dim)));
    for (int point = 0; point < points; ++point)
      {
        double square = 0, height = 0;
        for (int axis = 0, rest = point; axis < dim; ++axis, rest /= width)
          {
            height = rest % width - layers;
            square += height * height;
          }
        const double distance = std::sqrt(square);
        if (square == 0 || distance >= reach)
          continue;
        const double weight = reach / distance - 1;
        lattice.number_density += weight;
        lattice.spread += weight * square;
        const double square_of_q = square / (reach * reach), rest = 1 - square_of_q;
        lattice.filling += filling(square_of_q);
        lattice.filling_growth +=
          2 * square_of_q * rest * rest * (3 * (1 - 0.8 * square_of_q) + 0.8 * rest) / dim;
        if (!(height > 0))
          continue;
        above += filling(square / (reach * reach));
        side += weight * height / distance;
      }
    lattice.surface_lack = above / lattice.filling * std::pow(lattice.number_density / side, 2);
    lattice.spread /= lattice.number_density;
    lattice.filling_growth /= lattice.filling;
    return lattice;
  }
} // namespace undine::particles
