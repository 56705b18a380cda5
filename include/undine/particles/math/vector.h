// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_math_vector_h
#define undine_particles_math_vector_h

#include <undine/particles/math/host_device.h>

#include <cmath>

namespace undine::particles
{
  /// 1 / sqrt(x), by the device's instruction where there is one.
  UNDINE_HOST_DEVICE
  float
  inverse_square_root(const float x)
  {
#ifdef __CUDA_ARCH__
    return rsqrtf(x);
#else
    return 1 / std::sqrt(x);
#endif
  }

  UNDINE_HOST_DEVICE
  double
  inverse_square_root(const double x)
  {
    return 1 / sqrt(x);
  }

  /// sqrt(x), without the detour by double of sqrt() on the host.
  UNDINE_HOST_DEVICE
  float
  square_root(const float x)
  {
    return sqrtf(x);
  }

  UNDINE_HOST_DEVICE
  double
  square_root(const double x)
  {
    return sqrt(x);
  }

  template <class Real>
  UNDINE_HOST_DEVICE
  Real
  minimum(const Real a, const Real b)
  {
    return b < a ? b : a;
  }

  template <class Real>
  UNDINE_HOST_DEVICE
  Real
  maximum(const Real a, const Real b)
  {
    return a < b ? b : a;
  }


  template <class Real>
  UNDINE_HOST_DEVICE
  Real
  absolute(const Real a)
  {
    return a < 0 ? -a : a;
  }


  /// A vector in space; trivially copyable, so that it can live on a device.
  template <int dim, class Real>
  struct Vector
  {
    Real entries[dim];

    UNDINE_HOST_DEVICE
    Real &
    operator[](const int axis)
    {
      return entries[axis];
    }

    UNDINE_HOST_DEVICE
    const Real &
    operator[](const int axis) const
    {
      return entries[axis];
    }

    UNDINE_HOST_DEVICE
    Vector &
    operator+=(const Vector &other)
    {
      for (int axis = 0; axis < dim; ++axis)
        entries[axis] += other[axis];
      return *this;
    }

    UNDINE_HOST_DEVICE
    Vector &
    operator-=(const Vector &other)
    {
      for (int axis = 0; axis < dim; ++axis)
        entries[axis] -= other[axis];
      return *this;
    }

    UNDINE_HOST_DEVICE
    Vector &
    operator*=(const Real factor)
    {
      for (int axis = 0; axis < dim; ++axis)
        entries[axis] *= factor;
      return *this;
    }

    UNDINE_HOST_DEVICE
    static Vector
    zero()
    {
      Vector result;
      for (int axis = 0; axis < dim; ++axis)
        result[axis] = 0;
      return result;
    }
  };

  /// In another precision.
  template <int dim, class To, class From>
  Vector<dim, To>
  converted(const Vector<dim, From> &from)
  {
    Vector<dim, To> to;
    for (int axis = 0; axis < dim; ++axis)
      to[axis] = static_cast<To>(from[axis]);
    return to;
  }

  /// The same in memory where others read it in any order: the device reads it at once, as one
  /// word.
  template <int dim, class Real>
  struct alignas(4 * sizeof(Real)) StoredVector
  {
    Real entries[4];

    /// A fourth number, for something else that the same readers need; assigning a vector makes it
    /// zero.
    UNDINE_HOST_DEVICE
    Real
    companion() const
    {
      return entries[3];
    }

    UNDINE_HOST_DEVICE
    void
    set_companion(const Real value)
    {
      entries[3] = value;
    }

    UNDINE_HOST_DEVICE
    operator Vector<dim, Real>() const
    {
      Vector<dim, Real> result;
#ifdef __CUDA_ARCH__
      if constexpr (sizeof(Real) == 4)
        {
          const float4 word     = *reinterpret_cast<const float4 *>(this);
          const Real   words[4] = {word.x, word.y, word.z, word.w};
          for (int axis = 0; axis < dim; ++axis)
            result[axis] = words[axis];
        }
      else
#endif
        for (int axis = 0; axis < dim; ++axis)
          result[axis] = entries[axis];
      return result;
    }

    UNDINE_HOST_DEVICE
    StoredVector &
    operator=(const Vector<dim, Real> &vector)
    {
      for (int axis = 0; axis < 4; ++axis)
        entries[axis] = axis < dim ? vector[axis < dim ? axis : 0] : Real(0);
      return *this;
    }
  };

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  operator+(Vector<dim, Real> a, const Vector<dim, Real> &b)
  {
    return a += b;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  operator-(Vector<dim, Real> a, const Vector<dim, Real> &b)
  {
    return a -= b;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Vector<dim, Real>
  operator*(const Real factor, Vector<dim, Real> a)
  {
    return a *= factor;
  }

  /// The scalar product.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  operator*(const Vector<dim, Real> &a, const Vector<dim, Real> &b)
  {
    Real sum = 0;
    for (int axis = 0; axis < dim; ++axis)
      sum += a[axis] * b[axis];
    return sum;
  }

  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  norm_square(const Vector<dim, Real> &a)
  {
    return a * a;
  }
} // namespace undine::particles

#endif
