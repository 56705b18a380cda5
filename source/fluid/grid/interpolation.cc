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


  namespace
  {
    /// The weighted sum of the samples from `first` on; n_points(d): how many in a direction. Lines
    /// along the first direction are summed first, side by side.
    template <int dim, class Points>
    inline double
    weighted_sum(const Field<dim>                    &field,
                 const double                        *first,
                 const std::array<Row::Stencil, dim> &stencils,
                 const Points                        &n_points)
    {
      unsigned int n_lines = 1;
      for (unsigned int d = 1; d < dim; ++d)
        n_lines *= n_points(d);
      std::array<double, 4> along{};
      for (unsigned int line = 0; line < n_lines; ++line)
        {
          const double *sample = first;
          double        weight = 1;
          unsigned int  rest   = line;
          for (unsigned int d = 1; d < dim; ++d)
            {
              const unsigned int k = rest % n_points(d);
              rest /= n_points(d);
              sample += k * field.stride(d);
              weight *= stencils[d].weights[k];
            }
          for (unsigned int k = 0; k < n_points(0); ++k)
            along[k] += weight * sample[k];
        }
      double sum = 0;
      for (unsigned int k = 0; k < n_points(0); ++k)
        sum += stencils[0].weights[k] * along[k];
      return sum;
    }
  } // namespace


  template <int dim>
  CubicInterpolation<dim>::CubicInterpolation(const Field<dim>         &like,
                                              const dealii::Point<dim> &place)
    : place(place)
    , is_complete(true)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        stencils[d] = like.lattice().row(d).stencil(place[d]);
        begin[d]    = stencils[d].first;
        is_complete = is_complete && stencils[d].n_points == 4;
      }
  }


  template <int dim>
  double
  CubicInterpolation<dim>::value(const Field<dim> &field, const Overshoot overshoot) const
  {
    const double *first = field.data(begin);
    const double  sum =
      is_complete ? weighted_sum<dim>(field, first, stencils, [](unsigned int) { return 4u; })
                   : weighted_sum<dim>(field, first, stencils, [&](const unsigned int d) {
                      return stencils[d].n_points;
                    });
    if (overshoot == Overshoot::kept)
      return sum;
    const auto samples = samples_around(field, place);
    const auto bounds  = std::minmax_element(samples.values.begin(), samples.values.end());
    return std::clamp(sum, *bounds.first, *bounds.second);
  }


  template <int dim>
  double
  interpolate_cubic(const Field<dim>         &field,
                    const dealii::Point<dim> &place,
                    const Overshoot           overshoot)
  {
    return CubicInterpolation<dim>(field, place).value(field, overshoot);
  }


  template class CubicInterpolation<2>;
  template class CubicInterpolation<3>;
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
