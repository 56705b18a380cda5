// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_lattice_h
#define undine_fluid_grid_lattice_h

#include <undine/fluid/grid/blocks.h>
#include <undine/fluid/grid/ghost_layers.h>
#include <undine/fluid/grid/row.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace undine
{
  /// Where the values of a field sit on the staggered grid: in the cells' centres, or in the
  /// centres of the faces normal to one axis. The tensor product of `dim` rows of points.
  ///
  /// Face i along its axis lies below cell i and belongs to the rank that owns cell i; the last
  /// face, if not periodic, to the owner of the last cell.
  template <int dim>
  class Lattice
  {
  public:
    /// The value of normal_axis() for cell centres.
    static constexpr unsigned int no_axis = dim;

    /// `normal_axis` < dim: faces normal to it; no_axis: cells.
    Lattice(std::shared_ptr<const Blocks<dim>> blocks,
            const std::array<Row, dim>        &rows,
            const unsigned int                 normal_axis);

    /// The axis that the faces are normal to; no_axis for cells.
    unsigned int
    normal_axis() const
    {
      return axis;
    }

    const Blocks<dim> &
    blocks() const
    {
      return *block_structure;
    }

    /// The positions of the points along one direction.
    const Row &
    row(const unsigned int direction) const
    {
      return rows[direction];
    }

    /// Number of points in each direction over all ranks: the shape of the field in a file.
    GridIndex<dim>
    shape() const;

    /// Number of points over all ranks.
    dealii::types::global_dof_index
    n_points() const;

    /// Position of a point, of a boundary point or of an image [m].
    dealii::Point<dim>
    point(const GridIndex<dim> &index) const;

    /// The points that a rank owns.
    IndexBox<dim>
    owned(const unsigned int rank) const;

    /// The points that this rank owns.
    const IndexBox<dim> &
    owned() const
    {
      return mine;
    }

    /// The owned points of a rank and `width` more layers on either side, as far as there are
    /// points, boundary points or periodic images.
    IndexBox<dim>
    with_ghosts(const unsigned int rank, const GridIndex<dim> &width) const;

    /// Numbers of points for matrices: those of rank 0 first; within a rank the first direction
    /// runs fastest. Images have the number of their point. @{
    dealii::types::global_dof_index
    number(const GridIndex<dim> &index) const;

    dealii::IndexSet
    owned_numbers() const;
    /// @}

    /// The point of which `index` is an image.
    GridIndex<dim>
    wrapped(GridIndex<dim> index) const;

    /// Is it neither a point nor the image of one (see Row)?
    bool
    is_boundary_point(const GridIndex<dim> &index) const;

    /// How fields that store `stored` layers around the owned points fetch the inner `width`: made
    /// at the first call and kept. Collective.
    const GhostLayers<dim> &
    ghost_layers(const GridIndex<dim> &stored, const GridIndex<dim> &width) const;

  private:
    using Widths = std::pair<GridIndex<dim>, GridIndex<dim>>;

    std::shared_ptr<const Blocks<dim>>           block_structure;
    std::array<Row, dim>                         rows;
    unsigned int                                 axis;
    IndexBox<dim>                                mine;
    std::vector<dealii::types::global_dof_index> first_number; ///< of each rank
    mutable std::map<Widths, GhostLayers<dim>>   ghost_layers_of_widths;
  };
} // namespace undine

#endif
