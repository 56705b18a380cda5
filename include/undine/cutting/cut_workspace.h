// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_workspace_h
#define undine_cutting_cut_workspace_h

#include <undine/cutting/cut_cell_cache.h>
#include <undine/cutting/cut_cells.h>
#include <undine/cutting/grid_edges.h>
#include <undine/cutting/planar_regions.h>
#include <undine/cutting/split_surface.h>
#include <undine/surface/surface.h>

namespace undine
{
  /// The data that the stages of cutting pass on to each other; it lives from step to step to save
  /// allocations, and for the cached cells.
  template <int dim>
  struct CutWorkspace
  {
    /// Further data of the face with the same number in CutCells::faces.
    struct FaceRecord
    {
      int          first_planar = 0, end_planar = 0; ///< in `planar_edges`, 3D only
      int          end_piece = 0;
      unsigned int flags     = 0; ///< CutFlag
    };

    void
    clear()
    {
      grid_edges.clear();
      planar_edges.clear();
      face_records.clear();
      debris_piece.clear();
      closure_defects.clear();
    }

    SplitSurface<dim>                   split;
    GridEdges<dim>                      grid_edges;
    PlanarProblem                       planar;
    std::vector<PlanarEdge>             planar_edges; ///< of all faces in 3D
    std::vector<FaceRecord>             face_records;
    std::vector<char>                   debris_piece;    ///< of each piece: PlanarRegion::debris
    std::vector<dealii::Tensor<1, dim>> closure;         ///< of each component of one cell
    std::vector<double>                 closure_defects; ///< of each cell
    CutCellCache<dim>                   cache;
  };


  /// A surface and the positions of its nodes.
  template <int dim>
  struct PlacedSurface
  {
    const Surface<dim>                    &surface;
    const std::vector<dealii::Point<dim>> &positions; ///< of its nodes [m]
  };


  /// Append the edges of the planar problem in a rectangle normal to `normal` (a face in 3D; a cell
  /// in 2D, normal = 2) that begins at `corner`: its chords in order, then the fluid intervals of
  /// its sides, counter-clockwise from the lower one. Returns the flags of these.
  template <int dim>
  unsigned int
  collect_rectangle(std::vector<PlanarEdge>  &edges,
                    CutWorkspace<dim>        &work,
                    const CutCells<dim>      &cut,
                    const PlacedSurface<dim> &placed,
                    const unsigned int        normal,
                    const GridIndex<dim>     &corner);

  /// The number of a face in cut.faces; at the first call its pieces are found, still without
  /// components.
  template <int dim>
  int
  find_face(CutCells<dim>            &cut,
            CutWorkspace<dim>        &work,
            const PlacedSurface<dim> &placed,
            const unsigned int        axis,
            const GridIndex<dim>     &index);

  /// What find_face() does in 2D and in 3D: append the pieces of the last face. @{
  void
  solve_face(CutCells<2> &cut, CutWorkspace<2> &work, const PlacedSurface<2> &placed);
  void
  solve_face(CutCells<3> &cut, CutWorkspace<3> &work, const PlacedSurface<3> &placed);
  /// @}
} // namespace undine

#endif
