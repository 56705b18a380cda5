// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solvers_symmetry_h
#define undine_solid_solvers_symmetry_h

namespace undine
{
  /// Of a matrix.
  enum class Symmetry
  {
    none,
    symmetric
  };
} // namespace undine

#endif
