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


  template double
  interpolate(const Field<2> &, const dealii::Point<2> &);
  template double
  interpolate(const Field<3> &, const dealii::Point<3> &);
  template BoundedValue
  interpolate_with_bounds(const Field<2> &, const dealii::Point<2> &);
  template BoundedValue
  interpolate_with_bounds(const Field<3> &, const dealii::Point<3> &);
} // namespace undine
