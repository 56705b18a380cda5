// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_turning_stress_h
#define undine_operators_turning_stress_h

#include <undine/surface/surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// Forces of the part mu (grad v)^T n of the viscous stress on bodies, which mu dv/dn leaves out
  /// and on which moments depend. No slip and incompressibility make it mu (G^T - tr G) n with the
  /// gradient G of the motion along the surface. For G stands the mean gradient of a body,
  ///
  ///     F_k = mu (G^T - tr G) N_k,   G_ij = 1/V sum_k u_ki N_kj    [N]                  (I10)
  ///
  /// with the area vectors N_k of nodes, out of the body, and the volume V that they bound: exact
  /// for bodies that turn, without resultant, symmetric in u. It takes bodies whose wet surface is
  /// closed: on others this part has a resultant, which the fluid would have to give at the
  /// domain's sides.
  template <int dim>
  class TurningStress
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// None.
    TurningStress() = default;

    /// Of the bodies on the first `n_body_nodes` nodes of `surface`, which lie at `positions` [m]
    /// and have the `areas` that are wet, as vectors into the bodies [m^(dim-1)]; mu: `viscosity`
    /// [Pa s]. Lists are the same on all ranks, and so are results.
    TurningStress(const Surface<dim>                    &surface,
                  unsigned int                           n_body_nodes,
                  const std::vector<dealii::Point<dim>> &positions,
                  const Vectors                         &areas,
                  double                                 viscosity);

    /// Adds `factor` times the forces at `velocities` [m/s] of all nodes to `forces` [N].
    void
    add_forces(Vectors &forces, const Vectors &velocities, double factor = 1) const;

    /// Are there no such bodies?
    bool
    empty() const
    {
      return bodies.empty();
    }

  private:
    struct Body
    {
      std::vector<unsigned int> nodes;
      double                    volume = 0; ///< [m^dim]
    };

    std::vector<Body> bodies;
    Vectors           normals; ///< N_k of all nodes
    double            viscosity = 0;
  };
} // namespace undine

#endif
