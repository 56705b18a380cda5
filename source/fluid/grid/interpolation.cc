// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/interpolation.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The 2^dim samples around a place and how far it is from the lower ones.
    template <int dim>
    struct Samples
    {
      std::array<double, (1 << dim)> values;
      std::array<double, dim>        weights;
    };


    /// `bracket(d)`: between which points of the field's row the place is.
    template <int dim, class Bracket>
    inline Samples<dim>
    samples_around(const Field<dim> &field, const Bracket &bracket)
    {
      Samples<dim>   samples;
      GridIndex<dim> lower;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Row::Bracket between = bracket(d);
          lower[d]                   = between.lower;
          samples.weights[d]         = between.weight;
        }
      const double *const first = field.data(lower);
      for (unsigned int corner = 0; corner < (1 << dim); ++corner)
        {
          std::ptrdiff_t offset = 0;
          for (unsigned int d = 0; d < dim; ++d)
            if (corner & (1 << d))
              offset += field.stride(d);
          samples.values[corner] = first[offset];
        }
      return samples;
    }


    template <int dim>
    inline Samples<dim>
    samples_around(const Field<dim> &field, const dealii::Point<dim> &place)
    {
      return samples_around(
        field, [&](const unsigned int d) { return field.lattice().row(d).locate(place[d]); });
    }


    template <int dim>
    inline double
    multilinear(Samples<dim> samples)
    {
      for (unsigned int d = dim; d-- > 0;)
        for (unsigned int corner = 0; corner < (1u << d); ++corner)
          samples.values[corner] +=
            samples.weights[d] * (samples.values[corner + (1 << d)] - samples.values[corner]);
      return samples.values[0];
    }
  } // namespace


  template <int dim>
  double
  interpolate(const Field<dim> &field, const dealii::Point<dim> &place)
  {
    return multilinear(samples_around(field, place));
  }


  template <int dim>
  dealii::Tensor<1, dim>
  interpolate(const Velocity<dim> &velocity, const dealii::Point<dim> &place)
  {
    // Each row of planes belongs to one component, each row of centres to all others.
    std::array<Row::Bracket, dim> planes, centres;
    for (unsigned int d = 0; d < dim; ++d)
      {
        planes[d]  = velocity[d].lattice().row(d).locate(place[d]);
        centres[d] = velocity[d == 0 ? 1 : 0].lattice().row(d).locate(place[d]);
      }
    dealii::Tensor<1, dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      result[axis] = multilinear(samples_around(
        velocity[axis], [&](const unsigned int d) { return d == axis ? planes[d] : centres[d]; }));
    return result;
  }


  template <int dim>
  BoundedValue
  interpolate_with_bounds(const Field<dim> &field, const dealii::Point<dim> &place)
  {
    const auto samples = samples_around(field, place);
    const auto bounds  = std::minmax_element(samples.values.begin(), samples.values.end());
    return {multilinear(samples), *bounds.first, *bounds.second};
  }


  template <int dim>
  double
  interpolate_cubic(const Field<dim>         &field,
                    const dealii::Point<dim> &place,
                    const Overshoot           overshoot)
  {
    std::array<Row::Stencil, dim> stencils;
    GridIndex<dim>                begin;
    unsigned int                  n_lines = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        stencils[d] = field.lattice().row(d).stencil(place[d]);
        begin[d]    = stencils[d].first;
        n_lines *= d == 0 ? 1 : stencils[d].n_points;
      }
    const double *const first = field.data(begin);
    double              sum   = 0;
    for (unsigned int line = 0; line < n_lines; ++line)
      {
        const double *sample = first;
        double        weight = 1;
        unsigned int  rest   = line;
        for (unsigned int d = 1; d < dim; ++d)
          {
            const unsigned int k = rest % stencils[d].n_points;
            rest /= stencils[d].n_points;
            sample += k * field.stride(d);
            weight *= stencils[d].weights[k];
          }
        double along = 0;
        for (unsigned int k = 0; k < stencils[0].n_points; ++k)
          along += stencils[0].weights[k] * sample[k];
        sum += weight * along;
      }
    if (overshoot == Overshoot::kept)
      return sum;
    const auto samples = samples_around(field, place);
    const auto bounds  = std::minmax_element(samples.values.begin(), samples.values.end());
    return std::clamp(sum, *bounds.first, *bounds.second);
  }


  template double
  interpolate(const Field<2> &, const dealii::Point<2> &);
  template double
  interpolate(const Field<3> &, const dealii::Point<3> &);
  template double
  interpolate_cubic(const Field<2> &, const dealii::Point<2> &, const Overshoot);
  template dealii::Tensor<1, 2>
  interpolate(const Velocity<2> &, const dealii::Point<2> &);
  template double
  interpolate_cubic(const Field<3> &, const dealii::Point<3> &, const Overshoot);
  template dealii::Tensor<1, 3>
  interpolate(const Velocity<3> &, const dealii::Point<3> &);
  template BoundedValue
  interpolate_with_bounds(const Field<2> &, const dealii::Point<2> &);
  template BoundedValue
  interpolate_with_bounds(const Field<3> &, const dealii::Point<3> &);
} // namespace undine
