// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_matrix_h
#define undine_particles_pressure_matrix_h

#include <undine/particles/neighbours.h>

#include <cstdint>

namespace undine::particles
{
  /// One coefficient of the matrix with its column in 4 bytes: 19 bits for the difference to the
  /// row, 13 for the root of the coefficient, which keeps small ones accurate. The rounded
  /// coefficients are the same for (i, j) and (j, i), and diagonals are summed from them: rows
  /// still sum to zero.
  struct PackedEntry
  {
    std::uint32_t bits;

    static constexpr int weight_bits = 13;
    static constexpr int largest     = (1 << weight_bits) - 1;
    static constexpr int reach       = 1 << (31 - weight_bits); ///< of column - row

    template <class Real>
    UNDINE_HOST_DEVICE
    static PackedEntry
    of(const int difference, const Real coefficient, const Real scale)
    {
      const Real root = coefficient * inverse_square_root(coefficient * scale) * largest;
      const int  code = minimum(static_cast<int>(root + Real(0.5)), largest);
      return {(static_cast<std::uint32_t>(difference) << weight_bits) |
              static_cast<std::uint32_t>(code)};
    }

    UNDINE_HOST_DEVICE
    int
    difference() const
    {
      return static_cast<std::int32_t>(bits) >> weight_bits;
    }

    template <class Real>
    UNDINE_HOST_DEVICE
    Real
    coefficient(const Real scale) const
    {
      const Real code = static_cast<Real>(bits & largest);
      return code * code * (scale / (Real(largest) * Real(largest)));
    }

    UNDINE_HOST_DEVICE
    static bool
    can_reach(const int difference)
    {
      return difference >= -reach && difference < reach;
    }
  };

  /// The same without rounding and without a bound on the difference.
  template <class Number>
  struct WideEntry
  {
    int    column_difference;
    Number value;

    UNDINE_HOST_DEVICE
    static WideEntry
    of(const int difference, const Number coefficient, const Number)
    {
      return {difference, coefficient};
    }

    UNDINE_HOST_DEVICE
    int
    difference() const
    {
      return column_difference;
    }

    UNDINE_HOST_DEVICE
    Number
    coefficient(const Number) const
    {
      return value;
    }

    UNDINE_HOST_DEVICE
    static bool
    can_reach(const int)
    {
      return true;
    }
  };


  /// The off-diagonal part of the discrete pressure equation, one row a particle:
  ///     d_i P_i - sum_j k_ij P_j = b_i,   k_ij = w_ij rho_f / rho_ij  [1],
  /// symmetric. Particles without unknown pressure have empty rows.
  template <class Real, class Entry>
  struct PressureMatrix
  {
    int    n;
    int    capacity; ///< entries a row
    Real   scale;    ///< of the entries: the largest coefficient [1]
    int   *counts;
    Entry *entries;

    /// sum_j k_ij x_j, for numbers or vectors x_j
    template <class Value, class Stored>
    UNDINE_HOST_DEVICE
    Value
    row_times(const int row, const Stored *x) const
    {
      constexpr int together = 8; // on the way at the same time
      const int     count    = counts[row];
      Value         sum      = Value();
      int           first    = 0;
      for (; first + together <= count; first += together)
        {
          Entry entry[together];
          Value value[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            entry[k] = entries[list_slot(row, first + k, capacity)];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            value[k] = x[row + entry[k].difference()];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            sum += entry[k].coefficient(scale) * value[k];
        }
      for (; first < count; ++first)
        {
          const Entry entry = entries[list_slot(row, first, capacity)];
          sum += entry.coefficient(scale) * Value(x[row + entry.difference()]);
        }
      return sum;
    }
  };
} // namespace undine::particles

#endif
