// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_follower_pressure_h
#define undine_coupled_immersed_follower_pressure_h

#include <undine/surface/immersed_surface.h>

#include <vector>

namespace undine
{
  /// Forces by which the level of the fluid's pressure follows bodies from where the grid was cut
  /// to where they end the stage (C5). B^T p there has the normals of the first place: a load that
  /// keeps its direction. All around a body such a pressure p is not in equilibrium with itself as
  /// soon as the body turns or bends, and takes p times its volume from the stiffness, so that
  /// where a body comes to would depend on where the grid is cut far more than it does.
  ///
  /// With one level for each closed part of the surface these forces have no resultant, and are
  /// the gradient of a potential. They vanish where the grid is cut where the bodies come to.
  template <int dim>
  class FollowerPressure
  {
  public:
    using Positions = std::vector<dealii::Point<dim>>;
    using Vectors   = std::vector<dealii::Tensor<1, dim>>;
    using Matrix    = typename SolidModel<dim>::Matrix;
    using Vector    = typename SolidModel<dim>::Vector;

    /// No forces at all.
    explicit FollowerPressure(const ImmersedSurface<dim> &surface)
      : surface(surface)
    {
    }

    /// The grid was cut where all nodes were at `cut_at` [m]. Each closed part of the surface has
    /// the pressure of which the virial is that of `loads` [N], so that all of them have in sum no
    /// stiffness against turning about its centroid: a light body has little inertia to oppose it.
    /// It is no less and no more than those on its nodes are, however thin it is. Where some nodes
    /// are dry it is that nearest to the normal parts of the loads on the others. The surface must
    /// outlive it.
    FollowerPressure(const ImmersedSurface<dim> &surface,
                     const Positions            &cut_at,
                     const Vectors              &loads);

    /// Can there be forces?
    bool
    is_on() const
    {
      return !pressures.empty();
    }

    /// Of nodes of bodies, the same in all of a closed part of the surface [Pa].
    const std::vector<double> &
    levels() const
    {
      return pressures;
    }

    /// In all nodes [N], if bodies end at `displacement` [m]; zero in those of obstacles.
    /// Collective.
    Vectors
    forces(const Vector &displacement) const;

    /// Subtract `factor` times the derivative of the forces with respect to the displacement, whose
    /// entries must be in the pattern of `tangent`. Collective.
    void
    subtract_stiffness(Matrix &tangent, double factor, const Vector &displacement) const;

  private:
    const ImmersedSurface<dim> &surface;
    Vectors                     where_cut; ///< area vectors of nodes there [m^(dim-1)]
    std::vector<double>         pressures; ///< of nodes of bodies [Pa]
  };
} // namespace undine

#endif
