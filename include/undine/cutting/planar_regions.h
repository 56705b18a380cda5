// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_planar_regions_h
#define undine_cutting_planar_regions_h

#include <array>
#include <limits>
#include <vector>

namespace undine
{
  /// A directed straight edge in a rectangle, with the fluid on its left: a chord of the surface,
  /// or a fluid interval of the rectangle's rim.
  struct PlanarEdge
  {
    int                   from, to; ///< a vertex, or -1 - key of a node
    int                   edge;     ///< edge number
    bool                  on_rim;
    std::array<double, 2> start, end;  ///< relative to the lower corner [m]
    int                   region = -1; ///< which this edge bounds: found by find_regions()
  };


  /// A connected part of the fluid in a rectangle. Its area may be of rounding size, also below 0.
  struct PlanarRegion
  {
    double                area = 0; ///< [m^2]
    std::array<double, 2> moment{}; ///< integral of the coordinates [m^3]
    std::array<double, 2> lower{{std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::max()}}; ///< bounding box [m]
    std::array<double, 2> upper{
      {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()}};
    bool debris = false; ///< off the rim and of rounding size: joins nothing

    /// [m]
    double
    centroid(const unsigned int direction) const
    {
      const double value =
        area != 0 ? moment[direction] / area : (lower[direction] + upper[direction]) / 2;
      return value < lower[direction]   ? lower[direction]
             : value > upper[direction] ? upper[direction]
                                        : value;
    }
  };


  /// The planar problem: a face of a cell in 3D, a cell in 2D. At every vertex one edge ends and
  /// one begins, so that the edges form loops. A loop around fluid is a region; a loop around
  /// solid is a hole in the region that encloses it. Areas and moments by Green's theorem.
  ///
  /// Loops off the rim with an area of rounding size are never attached to anything: to take a
  /// pocket for a hole would join the two sides of a wall; to take a hole for a pocket only leaves
  /// debris.
  class PlanarProblem
  {
  public:
    /// Find the regions of the rectangle bounded by edges begin..end of `edges`: sets their
    /// `region`, counted from 0. `rounding`: area below which a loop is noise [m^2]. Returns flags.
    unsigned int
    find_regions(std::vector<PlanarEdge> &edges,
                 const int                begin,
                 const int                end,
                 const double             rounding);

    /// The regions of the last call of find_regions(), by their numbers.
    const std::vector<PlanarRegion> &
    regions() const
    {
      return all_regions;
    }

  private:
    enum class LoopKind
    {
      outer,
      hole,
      debris
    };

    struct Loop
    {
      PlanarRegion region;
      LoopKind     kind;
      int          enclosing; ///< the loop in which a hole lies; -1: none
      int          number;    ///< of its region
    };

    unsigned int
    link(const std::vector<PlanarEdge> &edges, const int begin, const int end);

    unsigned int
    follow_loops(std::vector<PlanarEdge> &edges,
                 const int                begin,
                 const int                end,
                 const double             rounding);

    unsigned int
    attach_holes(const std::vector<PlanarEdge> &edges, const int begin, const int end);

    unsigned int
    number_regions();

    /// The loop that encloses hole `hole`: what a ray meets that leaves the hole to the right; -1
    /// if nothing.
    int
    enclosing_loop(const std::vector<PlanarEdge> &edges,
                   const int                      begin,
                   const int                      end,
                   const int                      hole) const;

    std::vector<int>          order, successors;
    std::vector<Loop>         loops;
    std::vector<PlanarRegion> all_regions;
  };


  /// The first of the edges begin..end, met by a ray in direction 0 from `start`, that has fluid on
  /// its lower side and of which `counts(edge)`; -1 if there is none.
  template <class Counts>
  int
  first_hit(const std::vector<PlanarEdge> &edges,
            const int                      begin,
            const int                      end,
            const std::array<double, 2>   &start,
            const Counts                  &counts)
  {
    int    hit  = -1;
    double best = std::numeric_limits<double>::max();
    for (int i = begin; i < end; ++i)
      {
        const auto &edge = edges[i];
        if (!(edge.start[1] <= start[1] && start[1] < edge.end[1]))
          continue;
        const double fraction = (start[1] - edge.start[1]) / (edge.end[1] - edge.start[1]);
        const double x        = edge.start[0] + fraction * (edge.end[0] - edge.start[0]);
        if (x >= start[0] && x < best && counts(edge))
          {
            best = x;
            hit  = i;
          }
      }
    return hit;
  }
} // namespace undine

#endif
