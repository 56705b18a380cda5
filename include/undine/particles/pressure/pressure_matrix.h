// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_pressure_matrix_h
#define undine_particles_pressure_pressure_matrix_h

#include <undine/particles/math/exact_float.h>
#include <undine/particles/neighbours/neighbours.h>

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
      return in_units<Real>() * unit(scale);
    }

    /// The same in parts, of which the second is that of all entries. @{
    template <class Real>
    UNDINE_HOST_DEVICE
    Real
    in_units() const
    {
      const Real code = static_cast<Real>(float_beyond<largest>(bits) - two_to_23);
      return code * code;
    }

    template <class Real>
    UNDINE_HOST_DEVICE
    static Real
    unit(const Real scale)
    {
      return scale / (Real(largest) * Real(largest));
    }
    /// @}

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

    template <class Real>
    UNDINE_HOST_DEVICE
    Real
    in_units() const
    {
      return value;
    }

    template <class Real>
    UNDINE_HOST_DEVICE
    static Real
    unit(const Real)
    {
      return 1;
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
    template <class Value, class Numbers>
    UNDINE_HOST_DEVICE
    Value
    row_times(const int row, const Numbers &x) const
    {
      Value sum = Value();
      for_each_in_row<Value>(row, x, [&](const Entry entry, const Value &value) {
        sum += entry.template in_units<Real>() * value;
      });
      return Entry::unit(scale) * sum;
    }

    /// f(entry, x_j) for the entries of a row, and for the empty ones that fill its last group. As
    /// many groups as registers hold are on the way at the same time; each is read into the
    /// registers of one that is done, because to move one means to wait for it.
    template <class Value, class Numbers, class Function>
    UNDINE_HOST_DEVICE
    void
    for_each_in_row(const int row, const Numbers &x, const Function &f) const
    {
      constexpr int groups               = sizeof(Value) > sizeof(double) ? 2 : 3;
      const int     count                = counts[row];
      const Entry  *next                 = entries + list_slot(row, 0, capacity);
      Entry         entry[groups][group] = {};
      UNDINE_UNROLL
      for (int g = 0; g < groups; ++g)
        if (g * group < count)
          fetch(next + 32 * group * g, entry[g]);
      for (int first = 0; first < count; first += groups * group)
        {
          UNDINE_UNROLL
          for (int g = 0; g < groups; ++g)
            if (first + g * group < count)
              {
                Value value[group];
                UNDINE_UNROLL
                for (int k = 0; k < group; ++k)
                  value[k] = x[row + entry[g][k].difference()];
                UNDINE_UNROLL
                for (int k = 0; k < group; ++k)
                  f(entry[g][k], value[k]);
                if (first + (groups + g) * group < count)
                  fetch(next + 32 * group * (groups + g), entry[g]);
              }
          next += 32 * group * groups;
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

    /// A group of entries, which the row must have.
    UNDINE_HOST_DEVICE
    static void
    fetch(const Entry *from, Entry (&to)[group])
    {
      UNDINE_UNROLL
      for (int k = 0; k < group; ++k)
        to[k] = Entry::once(from + 32 * k);
    }
  };
} // namespace undine::particles

#endif
