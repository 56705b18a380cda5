// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_no_slip_surfaces_h
#define undine_fluid_boundary_no_slip_surfaces_h

#include <undine/fluid/grid/face_place.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace undine
{
  /// The part of the rim of a face's piece that lies on one side of the face: an interval of a grid
  /// edge in 3D, in 2D a node.
  struct Rim
  {
    double length = 0; ///< [m^(dim-2)]: in 2D 1 if the piece reaches the node, else 0
    double middle = 0; ///< coordinate along the edge [m]; 0 in 2D
  };

  /// The rims of a piece: [2 d + end], the one on the side normal to d. Those along the face's axis
  /// are empty.
  template <int dim>
  using Rims = std::array<Rim, 2 * dim>;

  /// What friction needs to know of the shape of a face's piece.
  template <int dim>
  struct PieceShape
  {
    Rims<dim> rims;

    /// [d]: its area in the half of the face that is lower along d [m^(dim-1)].
    std::array<double, dim> lower_half{};
  };

  /// Of all pieces: [axis][number in FluidTopology::faces].
  template <int dim>
  using PieceShapes = std::array<std::vector<PieceShape<dim>>, dim>;

  /// How fluid flows past the edge of a body beside a piece of a face, of which a part lies in
  /// front of a wall that ends there: in the rest of the piece, on average with the velocity
  ///
  ///     factor v - (factor - 1) u,      u = sum_k weights[k] u_nodes[k]                     (I14)
  ///
  /// if v is that of the piece, and that of the surface is u where the fluid is held back.
  template <int dim>
  struct FlowPastEdge
  {
    double                            factor    = 1; ///< of areas [1]; 1: there is no edge
    unsigned int                      direction = 0; ///< from wall to rest, along which it narrows
    dealii::Tensor<1, dim>            shift;         ///< of its middle, from the centroid [m]
    std::array<unsigned int, dim + 1> nodes{};       ///< of the surface
    std::array<double, dim + 1>       weights{};
  };

  /// What the friction of a fluid needs to know of the surfaces in it, besides the topology that
  /// they leave of the grid.
  template <int dim>
  struct NoSlipSurfaces
  {
    /// What of the surface bounds the fluid that moves with a piece of a face, on one of its sides.
    struct Contact
    {
      FacePlace<dim>                piece;
      double                        area;     ///< projected onto the normal in the face [m^(dim-1)]
      double                        distance; ///< from the piece's centroid, in the plane [m]
      std::array<unsigned int, dim> nodes;    ///< of the surface
      std::array<double, dim>       weights;  ///< of their velocities at the contact
    };

    /// Where the fluid of two pieces touches around the end of a body: of one face, in a component
    /// that both bound. Or where the end of a body is between two pieces that are neighbours.
    struct Passage
    {
      std::array<FacePlace<dim>, 2> pieces;
      double                        area;     ///< below 0 if the body is between them [m^(dim-1)]
      double                        distance; ///< of their centroids [m]
    };

    /// An entry of B (BoundaryFlux): int_{Gamma_c} N_node n dGamma [m^(dim-1)].
    struct Patch
    {
      int                    component; ///< number in FluidTopology::cells
      unsigned int           node;
      dealii::Tensor<1, dim> area;
    };

    PieceShapes<dim> shapes;

    /// Likewise; empty if there are no surfaces.
    std::array<std::vector<FlowPastEdge<dim>>, dim> past_edges;

    /// nullptr if there is no edge beside the piece.
    const FlowPastEdge<dim> *
    past_edge(const unsigned int axis, const FacePlace<dim> &place) const
    {
      if (place.part < 0 || past_edges[axis].empty())
        return nullptr;
      const auto &result = past_edges[axis][place.part];
      return result.factor > 1 ? &result : nullptr;
    }

    /// Of the area over which the fluid of a piece touches what is beside it along `d`: that of
    /// what flows past an edge in another direction [1].
    double
    share_beside(const unsigned int axis, const FacePlace<dim> &place, const unsigned int d) const
    {
      const auto *edge = past_edge(axis, place);
      return edge && edge->direction != d ? 1 / edge->factor : 1;
    }

    /// The mean of two of them [1].
    double
    share_between(const unsigned int    axis,
                  const FacePlace<dim> &one,
                  const FacePlace<dim> &other,
                  const unsigned int    d) const
    {
      return (share_beside(axis, one, d) + share_beside(axis, other, d)) / 2;
    }

    std::array<std::vector<Contact>, dim> contacts; ///< by axis, of this rank's faces
    std::array<std::vector<Passage>, dim> passages; ///< likewise
    std::vector<Patch>                    patches;  ///< of this rank's components, in their order

    unsigned int n_nodes = 0; ///< of the surfaces
  };

  /// The friction of a fluid on no-slip surfaces and boundaries, along one axis or all.
  template <class Force>
  struct FrictionForces
  {
    std::vector<Force> on_nodes; ///< of the surfaces in the fluid [N]
    std::vector<Force>
      on_boundaries; ///< of the domain: sides, and faces whose velocity is prescribed [N]
  };
} // namespace undine

#endif
