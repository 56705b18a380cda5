// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_math_rotation_h
#define undine_particles_math_rotation_h

#include <undine/particles/math/matrix.h>

namespace undine::particles
{
  template <class Real>
  UNDINE_HOST_DEVICE
  Vector<3, Real>
  cross(const Vector<3, Real> &a, const Vector<3, Real> &b)
  {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }

  /// The columns of R turned about `turn`, by its length as an angle.
  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<3, Real>
  rotated(const Matrix<3, Real> &R, const Vector<3, Real> &turn)
  {
    // Of Rodrigues, in terms of half the angle's tangent: a rotation for any t.
    const Real      square = norm_square(turn) / 4, scale = 2 / (1 + square);
    Matrix<3, Real> result;
    for (int k = 0; k < 3; ++k)
      {
        const Vector<3, Real> column = {{R[0][k], R[1][k], R[2][k]}};
        const Vector<3, Real> once   = cross(Real(.5) * turn, column);
        const Vector<3, Real> all    = column + scale * (once + cross(Real(.5) * turn, once));
        for (int a = 0; a < 3; ++a)
          result[a][k] = all[a];
      }
    return result;
  }

  /// Turn a rotation R until R^T F is symmetric.
  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<3, Real>
  turned_towards(const Matrix<3, Real> &F, Matrix<3, Real> R, const Real enough)
  {
    for (int iteration = 0; iteration < 40; ++iteration)
      {
        Vector<3, Real> axis  = Vector<3, Real>::zero(); // sum of columns r x f
        Real            trace = 0;
        for (int k = 0; k < 3; ++k)
          for (int a = 0; a < 3; ++a)
            {
              const int b = (a + 1) % 3, c = (a + 2) % 3;
              axis[a] += R[b][k] * F[c][k] - R[c][k] * F[b][k];
              trace += R[a][k] * F[a][k];
            }
        const Real scale = 1 / ((trace < 0 ? -trace : trace) + Real(1e-6));
        R                = rotated(R, scale * axis);
        if (!(norm_square(axis) * scale * scale > enough * enough))
          break;
      }
    return R;
  }

  /// The rotation R that is nearest to F: of all rotations it makes tr(R^T F) largest, for inverted
  /// and flat F, too, and changes continuously with F. `last` is a guess. @{
  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<2, Real>
  rotation_of(const Matrix<2, Real> &F, const Matrix<2, Real> &last)
  {
    const Real along = F[0][0] + F[1][1], across = F[1][0] - F[0][1];
    const Real square = along * along + across * across;
    if (!(square > Real(1e-12)))
      return last;
    const Real inverse = inverse_square_root(square);
    const Real c = inverse * along, s = inverse * across;
    return {{{c, -s}, {s, c}}};
  }

  /// By Newton's iteration R <- (R + R^{-T}) / 2 [Higham 1986], whose error becomes half its
  /// square; where F is nearly flat or inverted, by turning R towards F [Mueller et al. 2016].
  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<3, Real>
  rotation_of(const Matrix<3, Real> &F, const Matrix<3, Real> &last)
  {
    const Real enough = sizeof(Real) == 4 ? Real(2e-4) : Real(1e-8);
    if (!(determinant(F) > Real(1e-2)))
      return turned_towards(F, last, enough);
    Matrix<3, Real> rotation = F;
    for (int iteration = 0; iteration < 20; ++iteration)
      {
        const auto other  = inverse_transpose(rotation);
        Real       change = 0;
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            {
              const Real half = (other[i][j] - rotation[i][j]) / 2;
              rotation[i][j] += half;
              change = maximum(change, half < 0 ? -half : half);
            }
        if (change < enough)
          break;
      }
    return rotation;
  }
  /// @}
} // namespace undine::particles

#endif
