// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_cell_cache_h
#define undine_cutting_cut_cell_cache_h

#include <undine/cutting/cut_cells.h>
#include <undine/cutting/split_surface.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace undine
{
  template <int dim>
  struct CutWorkspace;
  template <int dim>
  struct PlacedSurface;

  /// A cache of cut cells that do not change, such as those of fixed obstacles and of bodies at
  /// rest beside others that move. The result for a cell depends on the facets in it and on which
  /// of its corners lie in bodies; while neither changes it is copied instead, identical to the
  /// bit. No cell is cached while anything unusual is met on this rank.
  template <int dim>
  class CutCellCache
  {
  public:
    /// Find which of the remembered cells have not changed since remember(), now that the surface
    /// has been split and windings are known: these are the cached cells.
    void
    compare(const CutCells<dim>      &cut,
            const SplitSurface<dim>  &split,
            const PlacedSurface<dim> &placed);

    /// Is the cell with this key a cached cell?
    bool
    hold(const std::int64_t key) const
    {
      const int slot = slots.find(key);
      return slot != IndexMap::none && cells[slot].is_cached;
    }

    /// Number of cached cells.
    int
    n_cached() const
    {
      return n_cached_cells;
    }

    /// Find the faces of a cached cell: by find_face() if a cell that is not cached shares them,
    /// which needs more than their pieces.
    void
    find_faces(CutCells<dim>            &cut,
               CutWorkspace<dim>        &work,
               const PlacedSurface<dim> &placed,
               const std::int64_t        key) const;

    /// Append a cached cell, after its faces. Returns its defect of closure [1].
    double
    add_cell(CutCells<dim> &cut, const std::int64_t key) const;

    /// Remember the cells in which no facet has moved since last time, before debris is dropped.
    void
    remember(const CutCells<dim>      &cut,
             const CutWorkspace<dim>  &work,
             const PlacedSurface<dim> &placed);

    /// [bytes]
    std::size_t
    memory_consumption() const;

  private:
    static constexpr unsigned int n_sides   = 2 * dim;
    static constexpr unsigned int n_corners = 1 << dim;

    using Windings = std::array<int, n_corners>;

    struct Cell
    {
      bool                                 is_cached = false;
      Windings                             windings;
      double                               closure_defect;
      std::array<std::size_t, 2>           components; ///< the first; one past the last
      std::array<std::size_t, 2>           fragments;
      std::array<std::size_t, n_sides + 1> pieces; ///< the first of each side; one past all
    };

    struct Piece
    {
      typename CutCells<dim>::Piece piece;
      bool                          is_debris;
      int                           component; ///< of the cell's
    };

    struct Fragment
    {
      typename CutCells<dim>::Fragment fragment; ///< with the number of the cell's component
      std::array<std::size_t, 2>       corners;  ///< the first; one past the last
    };

    static Windings
    windings_around(const CutCells<dim> &cut, const GridIndex<dim> &cell);

    /// Are these the surface and the block that were remembered? If not, they are now.
    bool
    knows(const CutCells<dim> &cut, const PlacedSurface<dim> &placed);

    /// Append the pieces of a face as a cell has them on one of its sides.
    void
    add_face(CutCells<dim>        &cut,
             CutWorkspace<dim>    &work,
             const Cell           &cell,
             const unsigned int    side,
             const GridIndex<dim> &face) const;

    void
    remember_cell(const CutCells<dim> &cut, const CutWorkspace<dim> &work, const int number);

    std::optional<GridBlock<dim>>                  block;
    std::vector<std::array<unsigned int, dim>>     facets;
    std::vector<dealii::Point<dim>>                positions; ///< last time [m]
    std::vector<char>                              has_moved; ///< since then, of each facet
    int                                            n_cached_cells = 0;
    IndexMap                                       slots;
    std::vector<Cell>                              cells; ///< by slot
    std::vector<typename CutCells<dim>::Component> components;
    std::vector<Fragment>                          fragments;
    std::vector<dealii::Point<dim>>                corners;
    std::vector<Piece>                             pieces;
  };
} // namespace undine

#endif
