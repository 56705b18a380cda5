// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_facet_splitter_h
#define undine_cutting_facet_splitter_h

#include <undine/cutting/chord_splitter.h>

namespace undine
{
  /// Splits facets into the parts that lie in single cells.
  template <int dim>
  class FacetSplitter;


  /// A segment is a chord of the cells that it passes.
  template <>
  class FacetSplitter<2>
  {
  public:
    FacetSplitter(const GridBlock<2> &block,
                  const Surface<2>   &surface,
                  SplitSurface<2>    &split,
                  NodeWindings<2>    &windings);

    void
    split_facet(const unsigned int facet);

  private:
    const Surface<2>                   &surface;
    ChordSplitter<2>                    chord_splitter;
    std::vector<ChordSplitter<2>::Link> links;
  };


  /// A triangle is sliced into slabs by the planes of axis 0, the slices by those of axis 1, and
  /// these by those of axis 2. Every coordinate is monotone along ridges and chords, and so rises
  /// once and falls once around a slice; a plane meets its rim exactly twice, whatever the
  /// rounding.
  template <>
  class FacetSplitter<3>
  {
  public:
    FacetSplitter(const GridBlock<3> &block,
                  const Surface<3>   &surface,
                  SplitSurface<3>    &split,
                  NodeWindings<3>    &windings);

    void
    split_facet(const unsigned int facet);

  private:
    using Corner  = SplitSurface<3>::Corner;
    using Polygon = std::vector<Corner>; ///< each corner with the edge that leaves it

    /// The vertices between the ends of a ridge, in its direction: `begin`..`end` in
    /// chain_vertices. Edge number i leads to vertex i.
    struct Chain
    {
      int begin = -1, end = -1; ///< begin < 0: not split yet
      int first_edge = -1;
    };

    const Chain &
    chain(const unsigned int ridge);

    /// The rim of a facet with all the vertices of its ridges.
    void
    collect_rim(const unsigned int facet);

    /// Slice polygons[axis] by the planes of `axis` and pass the slices on.
    void
    slice(const unsigned int axis, const GridIndex<3> &place);

    /// Cut what lies below `plane` off polygons[axis] into lower_parts[axis]. False if the plane
    /// does not meet the rim twice.
    bool
    cut_off(const unsigned int axis, const int plane, const GridIndex<3> &place);

    /// +1 if the corners strictly between positions a and b lie above `plane`, -1 below, 0 if
    /// there are none that could tell.
    int
    side(const unsigned int axis, const int plane, const std::size_t a, const std::size_t b) const;

    void
    pass_on(const unsigned int axis, const Polygon &slice, const int slab, GridIndex<3> place);

    const GridBlock<3>                       &block;
    const Surface<3>                         &surface;
    SplitSurface<3>                          &split;
    ChordSplitter<3>                          chord_splitter;
    unsigned int                              current_facet = 0;
    std::vector<Chain>                        chains; ///< of each ridge
    std::vector<int>                          chain_vertices;
    std::array<Polygon, 3>                    polygons, lower_parts, upper_parts;
    std::vector<int>                          ridge_vertices, finer_vertices;
    std::vector<ChordSplitter<3>::SplitPoint> parts;
    std::vector<ChordSplitter<3>::Link>       links;
  };


  /// Split all facets of `surface` that come near `block`. `split` and `windings` (crossings only,
  /// not summed up) are overwritten. Positions must be finite, but may be far outside the grid.
  template <int dim>
  void
  split_surface(SplitSurface<dim>                     &split,
                NodeWindings<dim>                     &windings,
                const GridBlock<dim>                  &block,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions);

  /// The numbers of the facets that cutting a block needs, ascending.
  template <int dim>
  std::vector<unsigned int>
  facets_near(const GridBlock<dim>                  &block,
              const Surface<dim>                    &surface,
              const std::vector<dealii::Point<dim>> &positions);
} // namespace undine

#endif
