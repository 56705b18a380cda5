// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_split_surface_h
#define undine_cutting_split_surface_h

#include <undine/cutting/keyed_lists.h>
#include <undine/fluid/grid/index_box.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace undine
{
  /// A node of the surface, or a place where the surface meets a plane of the grid.
  template <int dim>
  struct CutVertex
  {
    enum class Kind : signed char
    {
      node,     ///< of the surface
      on_ridge, ///< inside an edge between two triangles
      in_facet
    };

    dealii::Point<dim> position; ///< [m]; the coordinate along `axis` is that of the plane

    /// On a ridge: first its position on the segment from the lower node, 0..1. In a facet: the
    /// barycentric coordinates of its nodes 1, 2, ...
    std::array<double, dim - 1> parameters;

    GridIndex<dim> slabs; ///< in which it lies, clamped to the block
    int            ridge; ///< on which it lies
    int            plane; ///< that it lies on
    signed char    axis;  ///< of that plane; -1 for a node
    Kind           kind;
  };


  /// The surface after it has been split by all planes of a block: integers and snapped vertices.
  ///
  /// Everything that two neighbours share has one *edge number*: the parts of ridges and chords
  /// here, the fluid intervals of the grid's edges later. Numbers are used to find partners only;
  /// no result depends on their order.
  template <int dim>
  struct SplitSurface
  {
    /// Where the surface crosses an edge of the grid.
    struct Crossing
    {
      int vertex;
      int sign; ///< +1 if the solid begins there along the axis
      int facet;
    };

    /// A straight edge that the surface leaves on a face of a cell in 3D or in a cell in 2D,
    /// with the fluid on its left.
    struct Chord
    {
      int from, to; ///< vertices
      int edge;
      int facet;
    };

    /// A vertex of a fragment and the edge that leaves it.
    struct Corner
    {
      int vertex;
      int edge;
    };

    /// The part of a triangle in one cell: its corners in the order of the triangle. In 2D the
    /// chords are all there is.
    struct Fragment
    {
      int facet;
      int begin, end; ///< in `corners`
    };

    void
    clear();

    /// The next edge number.
    int
    new_edge()
    {
      return n_edges++;
    }

    std::vector<CutVertex<dim>> vertices;
    std::vector<Crossing>       crossings;
    KeyedLists                  crossings_on; ///< by edge of the grid, GridBlock::key(node, axis)
    std::vector<Chord>          chords;
    KeyedLists                  chords_on; ///< by face in 3D, key(node, axis); by cell in 2D
    std::vector<Corner>         corners;
    std::vector<Fragment>       fragments;
    KeyedLists                  fragments_in; ///< by cell, key(node)
    int                         n_edges = 0;
    int failures = 0; ///< facets that could not be split; not known to happen
  };


  template <int dim>
  void
  SplitSurface<dim>::clear()
  {
    vertices.clear();
    crossings.clear();
    crossings_on.clear();
    chords.clear();
    chords_on.clear();
    corners.clear();
    fragments.clear();
    fragments_in.clear();
    n_edges  = 0;
    failures = 0;
  }
} // namespace undine

#endif
