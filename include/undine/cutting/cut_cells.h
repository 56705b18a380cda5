// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_cells_h
#define undine_cutting_cut_cells_h

#include <undine/cutting/grid_block.h>
#include <undine/cutting/keyed_lists.h>
#include <undine/cutting/node_windings.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace undine
{
  /// The cells of a block that the boundaries of bodies cut: how their fluid is divided, exactly.
  /// Plain arrays, grouped by cell and by face; whatever is not listed is not cut.
  ///
  /// Pieces and fragments close around every component: sum of +- a e_axis over its pieces plus
  /// sum of N over its fragments = 0 to rounding, since both come from the same snapped vertices.
  ///
  /// Within a cell components, within a face pieces, have an order that depends on positions and
  /// facets only: neighbouring blocks list the cells and faces that they share alike, to the bit.
  template <int dim>
  struct CutCells
  {
    /// The ends of a piece that are not components. @{
    static constexpr int outside = -1; ///< the domain's outside, or cells that the block lacks
    static constexpr int uncut   = -2; ///< a cell that is fluid all over
    /// @}

    /// The component of fragments that no fluid touches (bodies in contact, debris).
    static constexpr int no_component = -1;

    /// A cut cell.
    struct Cell
    {
      GridIndex<dim> index;
      int            first_component; ///< up to that of the next cell
      int            first_fragment;
      unsigned int   flags; ///< CutFlag
    };

    /// A component, a connected part of the fluid in a cell: one pressure unknown.
    struct Component
    {
      int                cell;
      double             volume;   ///< [m^dim]
      dealii::Point<dim> centroid; ///< [m]
    };

    /// A face of a cut cell.
    struct Face
    {
      unsigned int   axis;
      GridIndex<dim> index; ///< as in Lattice: below cell `index`
      int            first_piece;
    };

    /// A piece, a connected open part of a face: one velocity unknown.
    struct Piece
    {
      int    face;
      double area; ///< a_f [m^(dim-1)]; below 0 where bodies overlap a little, so that
                   ///< closure stays exact: the cells there are flagged
      dealii::Point<dim> centroid; ///< [m]
      /// Below and above the face: a component, `uncut` or `outside`.
      std::array<int, 2> components;
      PieceShape<dim>    shape;
    };

    /// The part of a facet in one cell. For functions f, g linear on the facet with values f_i, g_j
    /// in its nodes:
    ///
    ///     integral of f n   = sum_i f_i mean[i] N
    ///     integral of f g n = sum_ij f_i g_j product(i, j) N
    struct Fragment
    {
      int                                    component;
      unsigned int                           facet;
      dealii::Tensor<1, dim>                 area_vector; ///< N, out of the fluid [m^(dim-1)]
      std::array<double, dim>                mean;        ///< of the barycentric coordinates
      std::array<double, dim *(dim - 1) / 2> products;    ///< means of products of the
                                                          ///< coordinates 01, 02, 12

      /// Mean of the product of barycentric coordinates i and j.
      double
      product(const unsigned int i, const unsigned int j) const;
    };

    /// Positions of the corners of fragments [m]: a polygon in 3D, a segment in 2D, in the order of
    /// the facet.
    struct Corners
    {
      std::vector<int>                first; ///< of each fragment, and one past the last
      std::vector<dealii::Point<dim>> points;
    };

    /// Counts of special cases met while cutting this block.
    struct Counts
    {
      int    sampled_cells   = 0; ///< not resolved exactly: see SampledRegions
      int    sampled_faces   = 0;
      int    reordered_edges = 0; ///< rounding ties, or walls as thin as rounding
      int    debris          = 0; ///< components that were dropped
      int    closed_pieces   = 0; ///< pieces too small to let fluid through
      double closure         = 0; ///< worst defect of closure, in units of a face, unflagged cells
    };

    explicit CutCells(const GridBlock<dim> &block)
      : block(block)
    {
    }

    /// The number of a cell in `cells`; -1 if it is not cut.
    int
    cut_cell(const GridIndex<dim> &cell) const
    {
      return cell_slots.find(block.key(cell));
    }

    /// The number of a face in `faces`; -1 if no cell at it is cut.
    int
    cut_face(const unsigned int axis, const GridIndex<dim> &face) const
    {
      return face_slots.find(block.key(face, axis));
    }

    /// True if an uncut cell lies in a body.
    bool
    in_solid(const GridIndex<dim> &uncut_cell) const
    {
      return windings[block.key(uncut_cell)] != 0;
    }

    /// One past the last component of a cell, by its number in `cells`.
    int
    end_component(const int cell) const
    {
      return cell + 1 < static_cast<int>(cells.size()) ? cells[cell + 1].first_component
                                                       : components.size();
    }

    /// One past the last fragment of a cell.
    int
    end_fragment(const int cell) const
    {
      return cell + 1 < static_cast<int>(cells.size()) ? cells[cell + 1].first_fragment
                                                       : fragments.size();
    }

    /// One past the last piece of a face, by its number in `faces`.
    int
    end_piece(const int face) const
    {
      return face + 1 < static_cast<int>(faces.size()) ? faces[face + 1].first_piece
                                                       : pieces.size();
    }

    /// Remove everything but the block and the windings.
    void
    clear();

    GridBlock<dim>         block;
    std::vector<Cell>      cells; ///< the first direction running fastest
    std::vector<Component> components;
    std::vector<Face>      faces;
    std::vector<Piece>     pieces;
    std::vector<Fragment>  fragments;
    Corners                corners;
    NodeWindings<dim>      windings;
    Counts                 counts;
    IndexMap               cell_slots, face_slots;
  };


  template <int dim>
  double
  CutCells<dim>::Fragment::product(const unsigned int i, const unsigned int j) const
  {
    // Coordinates sum to one, so that squares follow from the products of different ones.
    if (i != j)
      return products[i + j - 1];
    double result = mean[i];
    for (unsigned int k = 0; k < dim; ++k)
      if (k != i)
        result -= product(i, k);
    return result;
  }
} // namespace undine

#endif
