// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_aitken_relaxation_h
#define undine_coupled_immersed_aitken_relaxation_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace undine
{
  /// Fixed-point iteration for positions of nodes, x = F(x), with the dynamic relaxation of Aitken
  /// (Irons, Tuck: A version of the Aitken accelerator for computer iteration, 1969):
  ///
  ///     x_{k+1} = x_k + omega_k r_k,  r_k = F(x_k) - x_k,
  ///     omega_k = -omega_{k-1} r_{k-1} . (r_k - r_{k-1}) / |r_k - r_{k-1}|^2
  ///
  /// and omega_0 = 1. It finds the fixed point between two positions that F exchanges.
  template <int dim>
  class AitkenRelaxation
  {
  public:
    using Positions = std::vector<dealii::Point<dim>>;

    /// x_{k+1} [m] of `at` = x_k and `reached` = F(x_k), which have equally many nodes in all
    /// calls.
    Positions
    next(const Positions &at, const Positions &reached)
    {
      Residual residual(at.size());
      for (std::size_t node = 0; node < at.size(); ++node)
        residual[node] = reached[node] - at[node];
      if (!last.empty())
        omega *= ratio(residual);
      last             = residual;
      Positions result = at;
      for (std::size_t node = 0; node < at.size(); ++node)
        result[node] += omega * residual[node];
      return result;
    }

  private:
    using Residual = std::vector<dealii::Tensor<1, dim>>;

    // Of omega_k over omega_{k-1}: an iteration that all but repeats itself says little.
    static constexpr double smallest = 0.1;
    static constexpr double largest  = 2;

    double
    ratio(const Residual &residual) const
    {
      double product = 0, square = 0;
      for (std::size_t node = 0; node < residual.size(); ++node)
        {
          const auto change = residual[node] - last[node];
          product -= last[node] * change;
          square += change.norm_square();
        }
      return square > 0 ? std::clamp(product / square, smallest, largest) : 1;
    }

    Residual last;
    double   omega = 1;
  };
} // namespace undine

#endif
