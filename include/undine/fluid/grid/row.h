// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_row_h
#define undine_fluid_grid_row_h

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace undine
{
  /// The positions of a lattice's points along one direction [m], in ascending order: the planes
  /// between the cells, or the cells' centres. Points have the indices 0 <= i < size().
  ///
  /// A row of centres that is not periodic is extended by the two ends of the domain, with indices
  /// -1 and size(), so that every place in the domain lies between two points ("boundary points").
  /// A periodic row goes on for ever: point i + size() is the image of point i.
  class Row
  {
  public:
    /// Between which points a place lies: weight (1 - w) for `lower`, w for `lower` + 1.
    struct Bracket
    {
      int    lower;
      double weight;
    };

    /// The (up to) four points around a place.
    struct PointsAround
    {
      int          first;
      unsigned int n_points; ///< fewer than 4 only if the row has no more
    };

    /// Four points and the weights of the polynomial through them.
    struct Stencil : PointsAround
    {
      std::array<double, 4> weights;
    };

    /// What a row comes to at its two ends.
    enum class Ends
    {
      bounded, ///< it stops there
      periodic ///< it goes on at the other one
    };

    Row() = default;

    /// The row of all planes [m]. If it is periodic, it has no point of its own at the last plane.
    static Row
    of_planes(const std::vector<double> &planes, const Ends ends);

    /// The row of the points midway between the planes [m].
    static Row
    of_centres(const std::vector<double> &planes, const Ends ends);

    /// Number of points, without boundary points and images.
    int
    size() const
    {
      return n;
    }

    bool
    periodic() const
    {
      return length > 0;
    }

    /// True if the indices -1 and size() are boundary points.
    bool
    has_boundary_points() const
    {
      return first < 0;
    }

    /// Index of the point of which `index` is an image; itself if the row is not periodic.
    int
    wrapped(const int index) const
    {
      if (length == 0)
        return index;
      const int rest = index % n;
      return rest < 0 ? rest + n : rest;
    }

    /// Position of a point, of a boundary point or of an image [m].
    double
    position(const int index) const;

    /// The points between which a place [m] lies. Beyond the ends of a row that is not periodic it
    /// counts as the end.
    Bracket
    locate(double place) const
    {
      const int    periods = move_into_period(place);
      const int    i       = find(place);
      const double weight  = (place - points[i]) * inverse_gaps[i];
      return {i + first + periods * n, std::clamp(weight, 0., 1.)};
    }

    /// The points that stencil() takes, for a place [m].
    PointsAround
    points_around(double place) const;

    /// The stencil of cubic interpolation (Lagrange) at a place [m], exact for cubic polynomials on
    /// graded rows too. Next to an end of the row the points are those nearest to the end.
    Stencil
    stencil(double place) const;

  private:
    /// Four points in a row and prod_{l != k} 1 / (x_k - x_l) for each of them.
    struct Polynomial
    {
      std::array<double, 4> places;
      std::array<double, 4> factors;
    };

    Row(std::vector<double> points, const int first, const int n, const double length);

    /// Position in `polynomials` for a place moved into the row.
    int
    polynomial_at(const double place) const
    {
      const int i = find(place);
      return periodic() ? i : std::clamp(i - 1, 0, int(polynomials.size()) - 1);
    }

    /// The points of a polynomial, so many periods away.
    PointsAround
    points_of(const int polynomial, const int periods) const
    {
      return {polynomial + first + periods * n - (periodic() ? 1 : 0),
              periodic() ? 4 : std::min<unsigned int>(4, points.size())};
    }

    void
    set_up_polynomials();

    /// Position in `points` of the last point not above `place`, found in O(1) on uniform rows.
    int
    find(const double place) const
    {
      const int last = points.size() - 2;
      if (inverse_spacing == 0)
        {
          const auto above = std::upper_bound(points.begin(), points.end(), place);
          return std::clamp(int(above - points.begin()) - 1, 0, last);
        }
      // The distance from a boundary point to the next point is another one.
      int guess = std::clamp(int((place - points[-first]) * inverse_spacing) - first, 0, last);
      while (guess > 0 && place < points[guess])
        --guess;
      while (guess < last && place >= points[guess + 1])
        ++guess;
      return guess;
    }

    /// Move a place by whole periods into the row; returns by how many.
    int
    move_into_period(double &place) const
    {
      if (!periodic())
        return 0;
      const int periods = std::floor((place - points[0]) / length);
      place -= periods * length;
      return periods;
    }

    std::vector<double>     points;       ///< from index `first`; periodic: up to index n
    std::vector<double>     inverse_gaps; ///< 1 / distance from each point to the next [1/m]
    std::vector<Polynomial> polynomials;  ///< by position of the first point; periodic: less one
    int                     first           = 0; ///< -1 if there are boundary points
    int                     n               = 0;
    double                  length          = 0; ///< period [m]; 0: not periodic
    double                  inverse_spacing = 0; ///< [1/m]; 0: spacing not uniform
  };
} // namespace undine

#endif
