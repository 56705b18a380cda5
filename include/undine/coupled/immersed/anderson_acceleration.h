// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_anderson_acceleration_h
#define undine_coupled_immersed_anderson_acceleration_h

#include <deal.II/base/point.h>
#include <deal.II/lac/qr.h>
#include <deal.II/lac/vector.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace undine
{
  /// Fixed-point iteration for positions of nodes, x = F(x), with Anderson's acceleration (Walker,
  /// Ni: Anderson acceleration for fixed-point iterations, 2011), which in the coupling of fluids
  /// and bodies is known as interface quasi-Newton method (Degroote, Bathe, Vierendeels:
  /// Performance of a new partitioned procedure versus a monolithic procedure in fluid-structure
  /// interaction, 2009):
  ///
  ///     x_{k+1} = x_k + r_k - sum_j gamma_j (dx_j + dr_j),  r_k = F(x_k) - x_k,
  ///
  /// where dx_j and dr_j are the changes of x and of r in earlier iterations and gamma minimises
  /// |r_k - sum_j gamma_j dr_j|. For a linear map with m different eigenvalues the (m + 1)-th
  /// position that it returns is the fixed point, wherever the plain iteration goes.
  template <int dim>
  class AndersonAcceleration
  {
  public:
    using Positions = std::vector<dealii::Point<dim>>;

    /// x_{k+1} [m] of `at` = x_k and `reached` = F(x_k), which have equally many nodes in all
    /// calls.
    Positions
    next(const Positions &at, const Positions &reached)
    {
      const auto place    = numbers(at);
      auto       residual = numbers(reached);
      residual -= place;
      if (last_place.size() > 0)
        {
          residual_changes.push_back(residual);
          residual_changes.back() -= last_residual;
          place_changes.push_back(place);
          place_changes.back() -= last_place;
        }
      last_place    = place;
      last_residual = residual;
      auto result   = place;
      result += residual;
      subtract_explained(result, residual);
      return positions(result);
    }

  private:
    using Vector = dealii::Vector<double>;

    // Of a change of the residual, what earlier ones must leave of it to be told from rounding and
    // from what is not linear.
    static constexpr double least_new_share = 1e-2;

    /// Subtract sum_j gamma_j (dx_j + dr_j) from `result`; the latest changes come first.
    void
    subtract_explained(Vector &result, const Vector &residual) const
    {
      dealii::QR<Vector>       factors;
      std::vector<std::size_t> used;
      for (std::size_t j = residual_changes.size(); j-- > 0;)
        {
          factors.append_column(residual_changes[j]);
          const auto last = factors.size() - 1;
          if (std::abs(factors.get_R()(last, last)) >
              least_new_share * residual_changes[j].l2_norm())
            used.push_back(j);
          else
            factors.remove_column(last);
        }
      if (used.empty())
        return;
      Vector projected(used.size()), gamma(used.size());
      factors.multiply_with_QT(projected, residual);
      factors.solve(gamma, projected);
      for (std::size_t column = 0; column < used.size(); ++column)
        {
          result.add(-gamma[column], place_changes[used[column]]);
          result.add(-gamma[column], residual_changes[used[column]]);
        }
    }

    static Vector
    numbers(const Positions &points)
    {
      Vector result(points.size() * dim);
      for (std::size_t node = 0; node < points.size(); ++node)
        for (unsigned int d = 0; d < dim; ++d)
          result[node * dim + d] = points[node][d];
      return result;
    }

    static Positions
    positions(const Vector &numbers)
    {
      Positions result(numbers.size() / dim);
      for (std::size_t node = 0; node < result.size(); ++node)
        for (unsigned int d = 0; d < dim; ++d)
          result[node][d] = numbers[node * dim + d];
      return result;
    }

    std::vector<Vector> place_changes, residual_changes;
    Vector              last_place, last_residual;
  };
} // namespace undine

#endif
