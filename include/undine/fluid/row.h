// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_row_h
#define undine_fluid_row_h

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

    Row() = default;

    /// All planes. A periodic row has no point of its own at the last plane.
    static Row
    of_planes(const std::vector<double> &planes, const bool periodic);

    /// Midway between the planes.
    static Row
    of_centres(const std::vector<double> &planes, const bool periodic);

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

    /// A place beyond the ends of a row that is not periodic counts as the end.
    Bracket
    locate(double place) const;

  private:
    Row(std::vector<double> points, const int first, const int n, const double length);

    /// Position in `points` of the last point not above `place`, found in O(1) on uniform rows.
    int
    find(const double place) const;

    std::vector<double> points;              ///< from index `first`; periodic: up to index n
    int                 first           = 0; ///< -1 if there are boundary points
    int                 n               = 0;
    double              length          = 0; ///< period [m]; 0: not periodic
    double              inverse_spacing = 0; ///< [1/m]; 0: spacing not uniform
  };
} // namespace undine

#endif
