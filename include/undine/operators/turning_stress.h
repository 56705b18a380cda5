// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_turning_stress_h
#define undine_operators_turning_stress_h

#include <undine/surface/surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// Forces of the part mu (grad v)^T n of the viscous stress on bodies that turn, which mu dv/dn
  /// leaves out and on which moments depend: -mu W n where nothing slips, W being the antisymmetric
  /// matrix of the rotation. For a body it is that of the rigid motion next to its surface's,
  ///
  ///     sum_k a_k |u_k - u_mean - W r_k|^2 = min,   r_k from the centre of the surface,
  ///
  /// with the areas a_k of nodes, and the forces are those whose power is that of the stress on a
  /// body that turns so and bounds the volume V,
  ///
  ///     F_k . u_k, summed over k, = -mu V W : W    [W]                                  (I10)
  ///
  /// The moment of a body that turns is exact; there is no resultant, and they only take energy.
  /// What strains do has neither resultant nor moment. It takes bodies whose wet surface is closed:
  /// on others this part has a resultant, which the fluid would have to give at the domain's sides.
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
      std::vector<double>       areas;      ///< a_k [m^(dim-1)]
      Vectors                   arms;       ///< r_k along the principal axes [m]
      dealii::Tensor<2, dim>    axes;       ///< principal axes of the surface, in rows
      dealii::Tensor<1, dim>    moments;    ///< sum a r r^T along them [m^(dim+1)]
      double                    volume = 0; ///< [m^dim]
    };

    static Body
    measure(std::vector<unsigned int>              nodes,
            const std::vector<dealii::Point<dim>> &positions,
            const Vectors                         &areas);

    std::vector<Body> bodies;
    double            viscosity = 0;
  };
} // namespace undine

#endif
