// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_plain_vector_h
#define undine_particle_model_plain_vector_h

#include <deal.II/base/point.h>

#include <undine/particles/math/vector.h>

namespace undine
{
  /// For the particles' code, which knows no deal.II.
  template <int dim>
  particles::Vector<dim, double>
  plain(const dealii::Tensor<1, dim> &vector)
  {
    particles::Vector<dim, double> result;
    for (int axis = 0; axis < dim; ++axis)
      result[axis] = vector[axis];
    return result;
  }

  /// And back.
  template <int dim>
  dealii::Point<dim>
  point_of(const particles::Vector<dim, double> &vector)
  {
    dealii::Point<dim> result;
    for (int axis = 0; axis < dim; ++axis)
      result[axis] = vector[axis];
    return result;
  }
} // namespace undine

#endif
