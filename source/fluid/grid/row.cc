// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/row.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace undine
{
  Row::Row(std::vector<double> points_, const int first_, const int n_, const double length_)
    : points(std::move(points_))
    , first(first_)
    , n(n_)
    , length(length_)
  {
    const auto begin   = points.begin() - first;
    const auto spacing = n > 1 ? (begin[n - 1] - begin[0]) / (n - 1) : 0.;
    bool       uniform = n > 1;
    for (int i = 0; i + 1 < n; ++i)
      uniform = uniform && std::abs(begin[i + 1] - begin[i] - spacing) < 1e-6 * spacing;
    inverse_spacing = uniform ? 1 / spacing : 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      inverse_gaps.push_back(1 / (points[i + 1] - points[i]));
    set_up_polynomials();
  }


  void
  Row::set_up_polynomials()
  {
    const int n_stored   = points.size();
    const int n_places   = periodic() ? 4 : std::min(4, n_stored);
    const int n_stencils = periodic() ? n : std::max(1, n_stored - 3);
    for (int s = 0; s < n_stencils; ++s)
      {
        Polynomial polynomial{};
        for (int k = 0; k < n_places; ++k)
          polynomial.places[k] = periodic() ? position(s - 1 + k) : points[s + k];
        for (int k = 0; k < n_places; ++k)
          {
            polynomial.factors[k] = 1;
            for (int l = 0; l < n_places; ++l)
              if (l != k)
                polynomial.factors[k] /= polynomial.places[k] - polynomial.places[l];
          }
        polynomials.push_back(polynomial);
      }
  }


  Row
  Row::of_planes(const std::vector<double> &planes, const Ends ends)
  {
    const int n_cells = planes.size() - 1;
    return ends == Ends::periodic ? Row(planes, 0, n_cells, planes.back() - planes.front())
                                  : Row(planes, 0, n_cells + 1, 0);
  }


  Row
  Row::of_centres(const std::vector<double> &planes, const Ends ends)
  {
    const bool          periodic = ends == Ends::periodic;
    const int           n_cells  = planes.size() - 1;
    const double        length   = planes.back() - planes.front();
    std::vector<double> centres;
    if (!periodic)
      centres.push_back(planes.front());
    for (int i = 0; i < n_cells; ++i)
      centres.push_back((planes[i] + planes[i + 1]) / 2);
    centres.push_back(periodic ? centres.front() + length : planes.back());
    return Row(std::move(centres), periodic ? 0 : -1, n_cells, periodic ? length : 0.);
  }


  double
  Row::position(const int index) const
  {
    if (length == 0)
      {
        AssertIndexRange(index - first, static_cast<int>(points.size()));
        return points[index - first];
      }
    const int point   = wrapped(index);
    const int periods = (index - point) / n;
    return points[point] + periods * length;
  }


  Row::PointsAround
  Row::points_around(double place) const
  {
    const int periods = move_into_period(place);
    return points_of(polynomial_at(place), periods);
  }


  Row::Stencil
  Row::stencil(double place) const
  {
    const int   periods    = move_into_period(place);
    const int   begin      = polynomial_at(place);
    const auto &polynomial = polynomials[begin];
    const auto  at         = std::clamp(place, points.front(), points.back());
    Stencil     result{points_of(begin, periods), polynomial.factors};
    const auto  weigh = [&](const unsigned int n) {
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          if (l != k)
            result.weights[k] *= at - polynomial.places[l];
    };
    if (result.n_points == 4) // of a known number the compiler makes far better code
      weigh(4);
    else
      weigh(result.n_points);
    return result;
  }
} // namespace undine
