// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_stored_correction_h
#define undine_particles_fluid_stored_correction_h

#include <undine/particles/math/exact_float.h>
#include <undine/particles/math/matrix.h>

namespace undine::particles
{
  /// The pressure of a particle as the pressure equation sees it.
  enum class PressureIs
  {
    given,
    unknown
  };


  /// The correction M of a particle's gradients in memory, where its neighbours read it, with
  /// whether its pressure is unknown.
  template <int dim, class Real>
  struct StoredCorrection
  {
    SymmetricMatrix<dim, Real> M;
    bool                       is_unknown;

    /// Entries of M - I must be smaller than this.
    static constexpr Real bound = 8;

    UNDINE_HOST_DEVICE
    static StoredCorrection
    of(const SymmetricMatrix<dim, Real> &M, const PressureIs pressure)
    {
      return {M, pressure == PressureIs::unknown};
    }

    UNDINE_HOST_DEVICE
    SymmetricMatrix<dim, Real>
    matrix() const
    {
      return M;
    }

    UNDINE_HOST_DEVICE
    bool
    has_unknown() const
    {
      return is_unknown;
    }
  };

  /// In single precision one word of 16 bytes, which the device reads at once: M - I + 8 in steps
  /// of 2^-17, 21 bits each. Both sides of a face see the same rounded M, so that faces stay equal
  /// and opposite.
  template <int dim>
  struct StoredCorrection<dim, float>
  {
    alignas(16) std::uint32_t words[4];

    static constexpr float bound = 8;

    UNDINE_HOST_DEVICE
    static StoredCorrection
    of(const SymmetricMatrix<dim, float> &M, const PressureIs pressure)
    {
      StoredCorrection result = {};
      for (int k = 0; k < M.size; ++k)
        {
          const float         x    = (M.entries[k] - identity(k) + bound) * steps + 0.5f;
          const std::uint32_t bits = minimum(static_cast<std::uint32_t>(x), largest);
          if (k < 4)
            result.words[k] |= bits;
          else // in what the first four leave
            {
              result.words[2 * k - 8] |= bits >> 10 << 21;
              result.words[2 * k - 7] |= (bits & 0x3ff) << 21;
            }
        }
      result.words[1] |= (pressure == PressureIs::unknown ? 1u : 0u) << 31;
      return result;
    }

    UNDINE_HOST_DEVICE
    SymmetricMatrix<dim, float>
    matrix() const
    {
      SymmetricMatrix<dim, float> M;
      UNDINE_UNROLL
      for (int k = 0; k < M.size; ++k)
        {
          const std::uint32_t bits = k < 4 ? words[k < 4 ? k : 0]
                                           : (words[k < 4 ? 0 : 2 * k - 8] >> 21) << 10 |
                                               (words[k < 4 ? 0 : 2 * k - 7] >> 21 & 0x3ff);
          M.entries[k] =
            float_beyond<largest>(bits) * (1 / steps) + (identity(k) - bound - two_to_23 / steps);
        }
      return M;
    }

    UNDINE_HOST_DEVICE
    bool
    has_unknown() const
    {
      return words[1] >> 31 != 0;
    }

  private:
    static constexpr float         steps   = 131072; ///< 2^17
    static constexpr std::uint32_t largest = (1u << 21) - 1;

    /// Of the entries of I, in the order of SymmetricMatrix.
    UNDINE_HOST_DEVICE
    static float
    identity(const int k)
    {
      return k == 0 || k == 2 || k == 5 ? 1.f : 0.f;
    }
  };
} // namespace undine::particles

#endif
