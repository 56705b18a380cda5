// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_correction_request_h
#define undine_base_core_correction_request_h

namespace undine
{
  /// What stands for r'(x).
  enum class Tangent
  {
    exact,
    convex ///< without what makes it indefinite, as far as the problem knows that
  };

  /// What Newton's method asks of a correction.
  struct CorrectionRequest
  {
    bool    new_tangent;              ///< r'(x); else the tangent that the last correction had
    double  reduction;                ///< the part of |r| that the linear solver may leave [1]
    Tangent tangent = Tangent::exact; ///< if it is new
  };
} // namespace undine

#endif
