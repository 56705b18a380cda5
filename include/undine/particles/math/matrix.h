// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_math_matrix_h
#define undine_particles_math_matrix_h

#include <undine/particles/math/vector.h>

namespace undine::particles
{
  /// A tensor of second order in space.
  template <int dim, class Real>
  struct Matrix
  {
    Real entries[dim][dim];

    UNDINE_HOST_DEVICE
    Real *
    operator[](const int row)
    {
      return entries[row];
    }

    UNDINE_HOST_DEVICE
    const Real *
    operator[](const int row) const
    {
      return entries[row];
    }

    UNDINE_HOST_DEVICE
    static Matrix
    diagonal(const Real value)
    {
      Matrix result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          result[i][j] = i == j ? value : Real(0);
      return result;
    }

    /// Add factor * a b^T.
    UNDINE_HOST_DEVICE
    void
    add_outer_product(const Real factor, const Vector<dim, Real> &a, const Vector<dim, Real> &b)
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          entries[i][j] += factor * a[i] * b[j];
    }
  };

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  operator*(const Matrix<dim, Real> &m, const Vector<dim, Real> &v)
  {
    Vector<dim, Real> result = Vector<dim, Real>::zero();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i] += m[i][j] * v[j];
    return result;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Matrix<dim, Real>
  operator*(const Matrix<dim, Real> &a, const Matrix<dim, Real> &b)
  {
    Matrix<dim, Real> result = Matrix<dim, Real>::diagonal(0);
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          result[i][j] += a[i][k] * b[k][j];
    return result;
  }

  /// a : b
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  double_contraction(const Matrix<dim, Real> &a, const Matrix<dim, Real> &b)
  {
    Real sum = 0;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        sum += a[i][j] * b[i][j];
    return sum;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Matrix<dim, Real>
  transposed(const Matrix<dim, Real> &m)
  {
    Matrix<dim, Real> result;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i][j] = m[j][i];
    return result;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  trace(const Matrix<dim, Real> &m)
  {
    Real sum = 0;
    for (int i = 0; i < dim; ++i)
      sum += m[i][i];
    return sum;
  }

  /// det(m) m^{-T}, which exists for singular m too. @{
  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<2, Real>
  cofactors(const Matrix<2, Real> &m)
  {
    return {{{m[1][1], -m[1][0]}, {-m[0][1], m[0][0]}}};
  }

  template <class Real>
  UNDINE_HOST_DEVICE
  Matrix<3, Real>
  cofactors(const Matrix<3, Real> &m)
  {
    Matrix<3, Real> result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        {
          const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
          result[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    return result;
  }
  /// @}

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  determinant(const Matrix<dim, Real> &m)
  {
    const auto cofactor = cofactors(m);
    Real       sum      = 0;
    for (int j = 0; j < dim; ++j)
      sum += m[0][j] * cofactor[0][j];
    return sum;
  }

  /// m^{-T}; m must be regular.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Matrix<dim, Real>
  inverse_transpose(const Matrix<dim, Real> &m)
  {
    Matrix<dim, Real> result = cofactors(m);
    Real              det    = 0;
    for (int j = 0; j < dim; ++j)
      det += m[0][j] * result[0][j];
    const Real inverse = 1 / det;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i][j] *= inverse;
    return result;
  }

  /// A symmetric tensor, its lower triangle row by row: a block of dim (dim + 1) / 2 numbers.
  /// Aligned for the device, which reads some numbers at once.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) SymmetricMatrix
  {
    static constexpr int size = dim * (dim + 1) / 2;

    Real entries[size];

    UNDINE_HOST_DEVICE
    static int
    index(const int i, const int j)
    {
      return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
    }

    UNDINE_HOST_DEVICE
    static SymmetricMatrix
    diagonal(const Real value)
    {
      SymmetricMatrix result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j <= i; ++j)
          result.entries[index(i, j)] = i == j ? value : Real(0);
      return result;
    }

    /// Add factor * a a^T.
    UNDINE_HOST_DEVICE
    void
    add_square(const Real factor, const Vector<dim, Real> &a)
    {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j <= i; ++j)
          entries[index(i, j)] += factor * a[i] * a[j];
    }

    UNDINE_HOST_DEVICE
    Matrix<dim, Real>
    full() const
    {
      Matrix<dim, Real> result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          result[i][j] = entries[index(i, j)];
      return result;
    }

    /// The lower triangle of a matrix that is symmetric.
    UNDINE_HOST_DEVICE
    static SymmetricMatrix
    of(const Matrix<dim, Real> &m)
    {
      SymmetricMatrix result;
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j <= i; ++j)
          result.entries[index(i, j)] = m[i][j];
      return result;
    }
  };

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  operator*(const SymmetricMatrix<dim, Real> &m, const Vector<dim, Real> &v)
  {
    Vector<dim, Real> result = Vector<dim, Real>::zero();
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        result[i] += m.entries[SymmetricMatrix<dim, Real>::index(i, j)] * v[j];
    return result;
  }
} // namespace undine::particles

#endif
