// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/nearest_in_simplex.h>

#include <limits>

namespace undine
{
  template <int dim>
  dealii::Tensor<2, dim>
  inverse_of_products(const unsigned int n, const std::array<dealii::Point<dim>, dim> &places)
  {
    dealii::Tensor<2, dim> result;
    if (n < 2)
      return result;
    const auto   a  = places[1] - places[0];
    const double aa = a * a;
    if (n == 2)
      {
        result[0][0] = aa > 0 ? 1 / aa : 0;
        return result;
      }
    const auto   b           = places[n - 1] - places[0];
    const double bb          = b * b;
    const double ab          = a * b;
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > 1e-24 * aa * bb))
      return result;
    result[0][0] = bb / determinant;
    result[1][1] = aa / determinant;
    result[0][1] = result[1][0] = -ab / determinant;
    return result;
  }


  namespace
  {
    /// The simplex without its node k.
    template <int dim>
    NearestInSimplex<dim>
    nearest_without(const Simplex<dim>                 &simplex,
                    std::array<dealii::Point<dim>, dim> places,
                    const dealii::Point<dim>           &x,
                    const unsigned int                  k)
    {
      Simplex<dim> rest = simplex;
      --rest.n;
      for (unsigned int i = k; i < rest.n; ++i)
        {
          rest.nodes[i] = simplex.nodes[i + 1];
          places[i]     = places[i + 1];
        }
      rest.nodes[rest.n] = 0;
      return nearest_in_simplex<dim>(rest, places, x);
    }
  } // namespace


  template <int dim>
  NearestInSimplex<dim>
  nearest_in_simplex(const Simplex<dim>                        &simplex,
                     const std::array<dealii::Point<dim>, dim> &places,
                     const dealii::Point<dim>                  &x)
  {
    NearestInSimplex<dim> result{simplex, {}, x - places[0], 0};
    const auto            inverse = inverse_of_products<dim>(simplex.n, places);
    const auto            segment = result.from;
    result.weights[0]             = 1;
    for (unsigned int a = 0; a + 1 < simplex.n; ++a)
      {
        double weight = 0;
        for (unsigned int b = 0; b + 1 < simplex.n; ++b)
          weight += inverse[a][b] * ((places[b + 1] - places[0]) * segment);
        result.weights[a + 1] = weight;
        result.weights[0] -= weight;
        result.from -= weight * (places[a + 1] - places[0]);
      }
    bool is_inside = true;
    for (unsigned int k = 0; k < simplex.n; ++k)
      is_inside = is_inside && result.weights[k] > 0;
    result.distance = result.from.norm();
    if (is_inside)
      return result;

    NearestInSimplex<dim> nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    for (unsigned int k = 0; k < simplex.n; ++k)
      {
        const auto other = nearest_without<dim>(simplex, places, x, k);
        if (other.distance < nearest.distance)
          nearest = other;
      }
    return nearest;
  }


#define UNDINE_INSTANTIATE(dim)                             \
  template NearestInSimplex<dim> nearest_in_simplex<dim>(   \
    const Simplex<dim> &,                                   \
    const std::array<dealii::Point<dim>, dim> &,            \
    const dealii::Point<dim> &);                            \
  template dealii::Tensor<2, dim> inverse_of_products<dim>( \
    const unsigned int, const std::array<dealii::Point<dim>, dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
