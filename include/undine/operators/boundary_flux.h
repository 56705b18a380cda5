// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_boundary_flux_h
#define undine_operators_boundary_flux_h

#include <undine/cutting/cut_cells.h>
#include <undine/fluid/pressure/swept_volume_flux.h>
#include <undine/operators/cut_topology.h>
#include <undine/surface/surface.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace undine
{
  /// The operator B between the surfaces of bodies and the components of cut cells (I2):
  ///
  ///     (B u)_c = int_{Gamma_c} u.n dGamma   [m^dim/s],    n out of the fluid into the solid,
  ///
  /// the flux that the surface's velocity carries out of component c, for u linear on every facet,
  /// exactly; and its transpose J = B^T, the forces of the components' pressures in the nodes
  /// (Chentanez, Goktekin, Feldman & O'Brien, equations 1-4). Work is balanced to rounding: both
  /// use the same entries.
  ///
  /// Fragments that no fluid touches (CutCells::no_component) are left out.
  template <int dim>
  class BoundaryFlux
  {
  public:
    /// Row of B: a component of an owned cell, number in CutCells::components. Columns: all axes of
    /// a node.
    struct Entry
    {
      int                    component;
      unsigned int           node;
      dealii::Tensor<1, dim> value; ///< int_{Gamma_c} N_node n dGamma [m^(dim-1)]
    };

    /// B where the surface was cut. Not collective.
    BoundaryFlux(const CutCells<dim> &cut, const Surface<dim> &surface);

    /// The mean of B over a motion in which all nodes go straight on from `before` to `after`, each
    /// fragment with its facet, of which it is the part that it was when the surface was cut at
    /// `place`: with w = (after - before) / h, h B w is the volume that the surface sweeps,
    /// exactly. Positions [nodes] [m].
    BoundaryFlux(const CutCells<dim>                   &cut,
                 const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &place,
                 const std::vector<dealii::Point<dim>> &before,
                 const std::vector<dealii::Point<dim>> &after);

    /// The entries of B, one for each pair of component and node, sorted by component, then node.
    const std::vector<Entry> &
    entries() const
    {
      return all_entries;
    }

    /// B u, [CutCells::components] [m^dim/s], of `velocities` [nodes] [m/s]: of the components of
    /// owned cells; zero for the others.
    std::vector<double>
    flux(const std::vector<dealii::Tensor<1, dim>> &velocities) const;

    /// This rank's part of B^T p in all nodes, [nodes] [N], for pressures [CutCells::components]
    /// [Pa].
    std::vector<dealii::Tensor<1, dim>>
    local_forces(const std::vector<double> &pressures) const;

  private:
    /// The entries of all fragments that fluid touches; `area_vector(fragment)`: the integral of n.
    template <class AreaVector>
    void
    add_entries(const CutCells<dim> &cut,
                const Surface<dim>  &surface,
                const AreaVector    &area_vector);

    std::size_t        n_components;
    std::size_t        n_nodes;
    std::vector<Entry> all_entries;
  };


  /// The volume of fluid that leaves each component's place, as the surface gives way (negative
  /// where it pushes): its nodes were at `place` when it was cut and move straight from `before` by
  /// `increment` [m], each fragment with its facet; exact, [CutCells::components] [m^dim]. By it
  /// components grow. Zero in cells of the halo, unless asked for.
  template <int dim>
  std::vector<double>
  swept_volumes(const CutCells<dim>                       &cut,
                const Surface<dim>                        &surface,
                const std::vector<dealii::Point<dim>>     &place,
                const std::vector<dealii::Point<dim>>     &before,
                const std::vector<dealii::Tensor<1, dim>> &increment,
                bool                                       in_halo = false);

  /// The quantities that limit the accuracy of velocities in the nodes of a surface.
  struct StepAccuracy
  {
    double dt;                 ///< of the step from whose ends they have been computed [s]
    double largest_coordinate; ///< [m]
  };

  /// The swept-volume flux B u of the components of `parts.open->cells`, with the names of the
  /// bodies as in the surface. Its uncertainty is 1e-8 of the area times the speed, plus the effect
  /// of rounding of positions on both. Not collective.
  template <int dim>
  SweptVolumeFlux
  swept_volume_flux(const BoundaryFlux<dim>                   &boundary_flux,
                    const CutCells<dim>                       &cut,
                    const CutTopology<dim>                    &parts,
                    const Surface<dim>                        &surface,
                    const std::vector<dealii::Tensor<1, dim>> &velocities,
                    const StepAccuracy                        &accuracy);

  /// The area of the surface around each component, [CutCells::components] [m^(dim-1)], of those
  /// facets that belong to the first `n_nodes` nodes.
  template <int dim>
  std::vector<double>
  wetted_areas(const CutCells<dim> &cut, const Surface<dim> &surface, const std::size_t n_nodes);

  /// B^T p in all nodes of the surface, [nodes] [N], the same on all ranks, for pressures
  /// [CutCells::components] [Pa]. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  nodal_forces(const BoundaryFlux<dim>   &boundary_flux,
               const std::vector<double> &pressures,
               MPI_Comm                   communicator);

  /// int N_k p over the fluid's part of each facet for its node k, [facet * dim + k], over the
  /// facet's area, out of the fluid [Pa]: times the area vector of the facet, wherever that moves,
  /// the forces of `pressures` [CutCells::components] [Pa] in its nodes. The surface was cut at
  /// `place`. Collective.
  template <int dim>
  std::vector<double>
  pressures_on_facets(const CutCells<dim>                   &cut,
                      const Surface<dim>                    &surface,
                      const std::vector<dealii::Point<dim>> &place,
                      const std::vector<double>             &pressures,
                      MPI_Comm                               communicator);

  /// The forces of the weight that the reduced pressure leaves out (I4), [nodes] [N], the same on
  /// all ranks:
  ///
  ///     f_i = int rho (g.x) N_i n dGamma,
  ///
  /// since the pressure is p + rho g.x if p is the reduced one, with g.x = 0 at the origin; exact
  /// by the second moments of the fragments. `densities` [CutCells::components] [kg/m^3] of what
  /// fills each component: zero where the pressure is not a reduced one. Collective.
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  gravity_loads(const CutCells<dim>                   &cut,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions,
                const std::vector<double>             &densities,
                const dealii::Tensor<1, dim>          &gravity,
                MPI_Comm                               communicator);
} // namespace undine

#endif
