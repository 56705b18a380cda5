// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_lattice_h
#define undine_particles_lattice_h

#include <undine/particles/host_device.h>

namespace undine::particles
{
  /// What the weight w(r) = r_e / r - 1 (0 beyond r_e) sums to on a full lattice of unit spacing
  /// [Koshizuka, Oka 1996].
  struct Lattice
  {
    double number_density; ///< n0 = sum w [1]
    double spread;         ///< lambda = sum w r^2 / n0 [spacing^2]
  };

  /// `reach` is r_e in spacings.
  Lattice
  full_lattice(int dim, double reach);
} // namespace undine::particles

#endif
