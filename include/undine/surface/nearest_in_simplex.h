// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_nearest_in_simplex_h
#define undine_surface_nearest_in_simplex_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace undine
{
  /// A corner, a segment or, in space, a triangle: numbers of its n <= dim nodes, ascending.
  template <int dim>
  struct Simplex
  {
    unsigned int                  n = 0;
    std::array<unsigned int, dim> nodes{};

    bool
    operator<(const Simplex &other) const
    {
      return n != other.n ? n < other.n : nodes < other.nodes;
    }
  };

  /// The point of a simplex that is nearest to a place x.
  template <int dim>
  struct NearestInSimplex
  {
    Simplex<dim>            inside;       ///< the corner, segment or triangle in whose inside it is
    std::array<double, dim> weights{};    ///< of its nodes [1], all positive
    dealii::Tensor<1, dim>  from;         ///< x less the point [m]
    double                  distance = 0; ///< [m]
  };

  /// Given by the places of its nodes [m], in the order of their numbers.
  template <int dim>
  NearestInSimplex<dim>
  nearest_in_simplex(const Simplex<dim>                        &simplex,
                     const std::array<dealii::Point<dim>, dim> &places,
                     const dealii::Point<dim>                  &x);

  /// The inverse of the matrix T_a.T_b [1/m^2] of the difference vectors T_a from a simplex's first
  /// node to the others; zero if the simplex has no extent.
  template <int dim>
  dealii::Tensor<2, dim>
  inverse_of_products(const unsigned int n, const std::array<dealii::Point<dim>, dim> &places);
} // namespace undine

#endif
