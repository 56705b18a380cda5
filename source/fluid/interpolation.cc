// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/interpolation.h>

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


    template <int dim>
    inline Samples<dim>
    samples_around(const Field<dim> &field, const dealii::Point<dim> &place)
    {
      Samples<dim>   samples;
      GridIndex<dim> lower;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto bracket = field.lattice().row(d).locate(place[d]);
          lower[d]           = bracket.lower;
          samples.weights[d] = bracket.weight;
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
  BoundedValue
  interpolate_with_bounds(const Field<dim> &field, const dealii::Point<dim> &place)
  {
    const auto samples = samples_around(field, place);
    const auto bounds  = std::minmax_element(samples.values.begin(), samples.values.end());
    return {multilinear(samples), *bounds.first, *bounds.second};
  }


  template <int dim>
  BoundedValue
  interpolate_cubic(const Field<dim> &field, const dealii::Point<dim> &place)
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
    const auto samples = samples_around(field, place);
    const auto bounds  = std::minmax_element(samples.values.begin(), samples.values.end());
    return {sum, *bounds.first, *bounds.second};
  }


  template double
  interpolate(const Field<2> &, const dealii::Point<2> &);
  template double
  interpolate(const Field<3> &, const dealii::Point<3> &);
  template BoundedValue
  interpolate_cubic(const Field<2> &, const dealii::Point<2> &);
  template BoundedValue
  interpolate_cubic(const Field<3> &, const dealii::Point<3> &);
  template BoundedValue
  interpolate_with_bounds(const Field<2> &, const dealii::Point<2> &);
  template BoundedValue
  interpolate_with_bounds(const Field<3> &, const dealii::Point<3> &);
} // namespace undine
