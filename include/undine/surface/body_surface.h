// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_body_surface_h
#define undine_surface_body_surface_h

#include <undine/solid/mesh/part_of_bodies.h>
#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// The boundaries of all deformable bodies: their nodes are the nodes of the finite elements on
  /// the boundary, their facets the faces of the cells (see face_facets()).
  ///
  /// Replicated: every rank knows all facets, and positions and velocities of all nodes. Numbers do
  /// not depend on the number of ranks: bodies in their order, nodes as a loop over the cells meets
  /// them first.
  template <int dim>
  class BodySurface
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Index  = typename SolidModel<dim>::Index;

    /// Collective.
    explicit BodySurface(const SolidModel<dim> &model);

    /// The same nodes and facets, of which only those of some bodies move: vectors are those of
    /// `part`. The other nodes stay at their positions under `displacement` [m], of all bodies.
    /// Collective.
    BodySurface(const BodySurface &all, const PartOfBodies<dim> &part, const Vector &displacement);

    /// The same where no body moves, whatever the vectors. Collective.
    BodySurface(const BodySurface &all, const Vector &displacement);

    /// Facets and bodies of all nodes, those that do not move included.
    const Surface<dim> &
    surface() const
    {
      return all_facets;
    }

    /// Number of nodes of all bodies, the same on all ranks.
    unsigned int
    n_nodes() const
    {
      return dofs.size();
    }

    /// Does the node have degrees of freedom?
    bool
    moves(const unsigned int node) const
    {
      return dofs[node][0] != dealii::numbers::invalid_dof_index;
    }

    /// The degrees of freedom of a node that moves, one for each axis.
    const std::array<Index, dim> &
    dofs_of_node(const unsigned int node) const
    {
      return dofs[node];
    }

    /// The values of a vector over the locally owned degrees of freedom in all nodes, [nodes], in
    /// its unit, on every rank; zero in nodes that do not move. Collective.
    std::vector<dealii::Tensor<1, dim>>
    gather(const Vector &vector) const;

    /// Positions X + d of the nodes [m], on every rank. Collective.
    std::vector<dealii::Point<dim>>
    positions(const Vector &displacement) const;

    /// Add values in the nodes, such as forces [N], the same on all ranks, to a vector over the
    /// locally owned degrees of freedom. Collective.
    void
    add(Vector &vector, const std::vector<dealii::Tensor<1, dim>> &values) const;

  private:
    /// A component of a node.
    struct Slot
    {
      unsigned int node, axis;
    };

    explicit BodySurface(const SolidModel<dim>              &model,
                         std::vector<std::array<Index, dim>> dofs,
                         const Surface<dim>                 &facets);

    static BodySurface
    collect(const SolidModel<dim> &model);

    void
    share_out(const dealii::IndexSet &owned);

    std::vector<std::array<Index, dim>> dofs; ///< of each node
    Surface<dim>                        all_facets;
    std::vector<dealii::Point<dim>>     rest_positions; ///< of nodes that do not move: their place
    MPI_Comm                            communicator;
    std::vector<Slot>                   slots;  ///< those that rank 0 owns, then rank 1, ...
    std::vector<int>                    counts; ///< of slots of each rank
    std::vector<int>                    first;  ///< slot of each rank
  };
} // namespace undine

#endif
