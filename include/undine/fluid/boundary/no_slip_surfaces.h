// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_no_slip_surfaces_h
#define undine_fluid_boundary_no_slip_surfaces_h

#include <undine/fluid/grid/index_box.h>

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

  /// What the friction of a fluid needs to know of the surfaces in it, besides the topology that
  /// they leave of the grid.
  template <int dim>
  struct NoSlipSurfaces
  {
    /// Where a plane of faces meets the surface next to a piece.
    struct Contact
    {
      GridIndex<dim>                face;
      int                           part; ///< number in FluidTopology::faces; -1: the face is whole
      double                        length;   ///< of the intersection [m^(dim-2)], 1 in 2D
      double                        distance; ///< from the piece's centroid, in the plane [m]
      std::array<unsigned int, dim> nodes;    ///< of the surface
      std::array<double, dim>       weights;  ///< of their velocities at the contact
    };

    /// An entry of B (BoundaryFlux): int_{Gamma_c} N_node n dGamma [m^(dim-1)].
    struct Patch
    {
      int                    component; ///< number in FluidTopology::cells
      unsigned int           node;
      dealii::Tensor<1, dim> area;
    };

    std::array<std::vector<Rims<dim>>, dim> rims;     ///< [axis][number in FluidTopology::faces]
    std::array<std::vector<Contact>, dim>   contacts; ///< by axis, of this rank's faces
    std::vector<Patch>                      patches;  ///< of this rank's components, in their order

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
