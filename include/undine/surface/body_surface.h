// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_body_surface_h
#define undine_surface_body_surface_h

#include <undine/solid/mesh/part_of_bodies.h>
#include <undine/surface/surface.h>

#include <array>
#include <vector>

namespace undine
{
  /// The boundaries of all deformable bodies: their facets are the faces of the cells (see
  /// facets_of_element()), with a node for each node of the finite elements on the boundary.
  ///
  /// Corners of cells are nodes as they are. Of quadratic elements the nodes between corners, in
  /// edges and faces, are moved on from the mean of these corners by a third of their distance from
  /// it (I12): with the nodes of the finite elements for corners, facets would enclose less than
  /// the curved sides do, and a uniform pressure on them would load the corners of a side too much
  /// and its middle too little, which bends the element. With the nodes moved on, a uniform
  /// pressure on a plane side has the nodal forces of the finite elements, and in 2D every side
  /// encloses exactly what the parabola does. Faces of linear elements in 3D have a node in their
  /// middle, the mean of the corners, to the same end. A node is therefore a linear combination of
  /// nodes of the finite elements (Share), by which forces in it come to these.
  ///
  /// Replicated: every rank knows all facets, and positions and velocities of all nodes. Numbers do
  /// not depend on the number of ranks: bodies in their order, nodes as a loop over the cells meets
  /// them first.
  template <int dim>
  class BodySurface
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;
    using Index  = typename SolidModel<dim>::Index;

    /// How a node follows a node of the finite elements, and how much of a force in it that gets.
    struct Share
    {
      std::array<Index, dim> dofs; ///< of that node
      double                 weight;
    };

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
      return !all_shares[node].empty();
    }

    /// Is the node where a node of the finite elements is, or moved on from there? The others are
    /// means of corners.
    bool
    has_own(const unsigned int node) const
    {
      return own_weights[node] != 0;
    }

    /// The shares of a node, of sum 1: first its own node of the finite elements, if there is one,
    /// then the corners that lie around it. Empty if it does not move.
    const std::vector<Share> &
    shares(const unsigned int node) const
    {
      return all_shares[node];
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

    /// [k][m]: how the force in the k-th node of a facet changes as its m-th node moves [N/m].
    using FacetMatrices = std::array<std::array<dealii::Tensor<2, dim>, dim>, dim>;

    /// Add these to the rows of this rank, of nodes that do not move nothing; the entries must be
    /// in the pattern. Not collective.
    void
    add_derivatives(Matrix                              &matrix,
                    const std::array<unsigned int, dim> &nodes,
                    const FacetMatrices                 &changes) const;

  private:
    using Corners = std::vector<unsigned int>; ///< those around a node; of corners none

    /// A component of a node.
    struct Slot
    {
      unsigned int node, axis;
    };

    explicit BodySurface(const SolidModel<dim>              &model,
                         std::vector<std::array<Index, dim>> dofs,
                         std::vector<Corners>                corners,
                         const Surface<dim>                 &facets);

    /// Is the node one of the finite elements that has degrees of freedom?
    bool
    has_dofs(const unsigned int node) const
    {
      return dofs[node][0] != dealii::numbers::invalid_dof_index;
    }

    static BodySurface
    collect(const SolidModel<dim> &model);

    void
    find_shares();
    void
    share_out(const dealii::IndexSet &owned);
    template <class Value>
    dealii::Tensor<1, dim>
    mean_of_corners(unsigned int node, const std::vector<Value> &values) const;

    std::vector<std::array<Index, dim>> dofs;    ///< of each node's own
    std::vector<Corners>                corners; ///< around each node
    std::vector<double>                 own_weights;
    std::vector<std::vector<Share>>     all_shares;
    Surface<dim>                        all_facets;
    std::vector<dealii::Point<dim>>     rest_positions; ///< of nodes that do not move: their place
    MPI_Comm                            communicator;
    std::vector<Slot>                   slots;  ///< those that rank 0 owns, then rank 1, ...
    std::vector<int>                    counts; ///< of slots of each rank
    std::vector<int>                    first;  ///< slot of each rank
  };
} // namespace undine

#endif
