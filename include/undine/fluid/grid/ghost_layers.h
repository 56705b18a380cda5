// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_ghost_layers_h
#define undine_fluid_grid_ghost_layers_h

#include <undine/fluid/grid/index_box.h>

#include <deal.II/base/mpi_noncontiguous_partitioner.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace undine
{
  template <int dim>
  class Lattice;


  /// Where the values of the ghost points of a field come from: other ranks, or, by periodicity,
  /// points of this one. Depends on the lattice and the widths only, so that a lattice keeps it
  /// (Lattice::ghost_layers()).
  template <int dim>
  class GhostLayers
  {
  public:
    /// Of fields that store `stored` layers around the owned points, of which the inner `width`
    /// are fetched. Collective; both must be the same on all ranks.
    GhostLayers(const Lattice<dim>   &lattice,
                const GridIndex<dim> &stored,
                const GridIndex<dim> &width);

    /// Fill the ghost points of `values`: those of Lattice::with_ghosts(rank, stored), the first
    /// direction running fastest. Collective.
    template <typename Number>
    void
    update(const dealii::ArrayView<Number> &values) const;

  private:
    dealii::Utilities::MPI::NoncontiguousPartitioner partitioner;
    std::vector<std::pair<std::size_t, std::size_t>> images; ///< position to copy from, and to
  };
} // namespace undine

#endif
