// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/mean_distance.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Means over a part of the boundary of l and l^2 / 2 where l > 0, else of 0.
    struct Means
    {
      double first, second;
    };


    /// Of a linear function between two values.
    Means
    means_between(const double middle, const double half_difference)
    {
      const double most = middle + half_difference;
      if (most <= 0)
        return {0, 0};
      if (middle - half_difference >= 0)
        return {middle, (middle * middle + half_difference * half_difference / 3) / 2};
      return {most * most / (4 * half_difference), most * most * most / (12 * half_difference)};
    }
  } // namespace


  /// By Green's theorem: with l in front of the chord and its normal n, the divergence of -n g(l)
  /// is g'(l).
  template <int dim>
  std::optional<double>
  mean_distance_in_front(const PlaneChord<dim> &chord, const std::vector<PlaneChord<dim>> &boundary)
  {
    constexpr double       rounding = 1e-6, negligible = 1e-9;
    const auto             normal = chord.normal / chord.normal.norm();
    dealii::Tensor<1, dim> closure;
    double                 length = 0, area = 0, moment = 0, extent = 0;
    for (const auto &part : boundary)
      {
        const double across = part.normal * normal;
        const double along  = std::sqrt(std::max(0., part.normal.norm_square() - across * across));
        const double distance = (chord.middle - part.middle) * normal;
        const auto   means    = means_between(distance, along / 2);
        area -= across * means.first;
        moment -= across * means.second;
        closure += part.normal;
        length += part.normal.norm();
        extent = std::max(extent, std::abs(distance) + along / 2);
      }
    if (closure.norm() > rounding * length || !(area > negligible * extent * length))
      return {};
    return moment / area;
  }


  template std::optional<double>
  mean_distance_in_front(const PlaneChord<2> &, const std::vector<PlaneChord<2>> &);
  template std::optional<double>
  mean_distance_in_front(const PlaneChord<3> &, const std::vector<PlaneChord<3>> &);
} // namespace undine
