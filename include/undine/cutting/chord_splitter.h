// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_chord_splitter_h
#define undine_cutting_chord_splitter_h

#include <undine/cutting/grid_block.h>
#include <undine/cutting/node_windings.h>
#include <undine/cutting/split_surface.h>
#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// Barycentric coordinates of a vertex in a facet that it belongs to.
  template <int dim>
  std::array<double, dim>
  barycentric(const Surface<dim>   &surface,
              const unsigned int    facet,
              const CutVertex<dim> &vertex,
              const int             vertex_number);


  /// Splits straight edges by the planes of one axis after the other, and stores the resulting
  /// vertices, chords and crossings with the grid's edges. All decisions are integers: slabs of
  /// coordinates that are monotone along every edge, because interpolation is clamped to its ends.
  template <int dim>
  class ChordSplitter
  {
  public:
    /// A vertex where an edge is split and the slab that it enters there.
    struct SplitPoint
    {
      int vertex;
      int slab;
    };

    /// A piece of a chord, by its edge number, and the vertex at its end.
    struct Link
    {
      int edge;
      int vertex;
    };

    ChordSplitter(const GridBlock<dim> &block,
                  const Surface<dim>   &surface,
                  SplitSurface<dim>    &split,
                  NodeWindings<dim>    &windings);

    /// Append the vertices where the segment between two vertices on a ridge meets planes of
    /// `axis`.
    void
    split_ridge(std::vector<SplitPoint> &parts,
                const int                from,
                const int                to,
                const unsigned int       axis,
                const unsigned int       ridge);

    /// Split the chord from -> to of `facet` on a face normal to `normal` at `place` by the planes
    /// of all axes from `axis` on; in 2D the facet itself, normal = 2. Appends its pieces to
    /// `links`. `place` has the plane along `normal` and the slabs along axes below `axis`.
    void
    split_chord(std::vector<Link> &links,
                const unsigned int facet,
                const unsigned int normal,
                const unsigned int axis,
                GridIndex<dim>     place,
                const int          from,
                const int          to);

    /// Whether a part in slab `slab` of `axis` matters here: in the block, or below it along axis
    /// 0 at the domain's side, where only crossings count.
    bool
    matters(const unsigned int axis, const int slab) const
    {
      return slab < block.cells().upper[axis] &&
             (slab >= block.cells().lower[axis] || (axis == 0 && block.at_lower_end(0)));
    }

  private:
    template <class Complete>
    void
    split_segment(std::vector<SplitPoint> &parts,
                  const int                from,
                  const int                to,
                  const unsigned int       axis,
                  const Complete          &complete);

    void
    split_in_facet(std::vector<SplitPoint> &parts,
                   const int                from,
                   const int                to,
                   const unsigned int       axis,
                   const unsigned int       facet);

    CutVertex<dim>
    vertex_between(const CutVertex<dim> &from,
                   const CutVertex<dim> &to,
                   const unsigned int    axis,
                   const int             plane,
                   const double          fraction) const;

    /// Store a piece of a chord; returns its edge number.
    int
    add_chord(const unsigned int    facet,
              const unsigned int    normal,
              const GridIndex<dim> &place,
              const int             from,
              const int             to);

    /// Store that a chord normal to `normal` crosses a plane of `axis` at `vertex`, upwards or
    /// downwards: there it crosses an edge of the grid along the third axis.
    void
    add_crossing(const unsigned int    facet,
                 const unsigned int    normal,
                 const unsigned int    axis,
                 const GridIndex<dim> &place,
                 const int             vertex,
                 const int             direction);

    const GridBlock<dim>                    &block;
    const Surface<dim>                      &surface;
    SplitSurface<dim>                       &split;
    NodeWindings<dim>                       &windings;
    std::array<std::vector<SplitPoint>, dim> scratch;
  };
} // namespace undine

#endif
