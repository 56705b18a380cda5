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

    /// Reads one that will not be needed again soon: others stay in the caches.
    UNDINE_HOST_DEVICE
    static PackedEntry
    once(const PackedEntry *entry)
    {
#ifdef __CUDA_ARCH__
      return {__ldcs(&entry->bits)};
#else
      return *entry;
#endif
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
    static WideEntry
    once(const WideEntry *entry)
    {
      return *entry;
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
      Value sum = Value();
      for_each_in_row<Value>(row, x, [&](const Entry entry, const Value &value) {
        sum += entry.coefficient(scale) * value;
      });
      return sum;
    }

    /// f(entry, x_j) for the entries of a row, and for the empty ones that fill its last group. The
    /// entries of the next groups are on the way while the numbers that belong to the present one
    /// are: as many groups as registers hold.
    template <class Value, class Numbers, class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_in_row(const int row, const Numbers &x, const Function &f) const
    {
      constexpr int ahead                   = sizeof(Value) > sizeof(double) ? 1 : 2;
      const int     count                   = counts[row];
      const Entry  *from                    = entries + list_slot(row, 0, capacity);
      Entry         entry[ahead + 1][group] = {};
      UNDINE_UNROLL
      for (int g = 0; g < ahead; ++g)
        fetch(from, g * group, count, entry[g]);
      for (int first = 0; first < count; first += group)
        {
          Value value[group];
          UNDINE_UNROLL
          for (int k = 0; k < group; ++k)
            value[k] = x[row + entry[0][k].difference()];
          fetch(from, first + ahead * group, count, entry[ahead]);
          UNDINE_UNROLL
          for (int k = 0; k < group; ++k)
            {
              f(entry[0][k], value[k]);
              UNDINE_UNROLL
              for (int g = 0; g < ahead; ++g)
                entry[g][k] = entry[g + 1][k];
            }
        }
    }

    /// After `count` entries have been written to a row.
    UNDINE_HOST_DEVICE
    void
    fill_last_group(const int row, const int count) const
    {
      counts[row] = count;
      for (int k = count; k % group != 0; ++k)
        entries[list_slot(row, k, capacity)] = Entry{};
    }

  private:
    static constexpr int group = 4;

    /// A group of entries, if the row has it.
    UNDINE_HOST_DEVICE
    static void
    fetch(const Entry *from, const int first, const int count, Entry (&to)[group])
    {
      if (first < count)
        {
          UNDINE_UNROLL
          for (int k = 0; k < group; ++k)
            to[k] = Entry::once(from + 32 * (first + k));
        }
    }
  };
} // namespace undine::particles

#endif
