// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_surface_flux_h
#define undine_coupled_immersed_surface_flux_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/linear/block_system.h>
#include <undine/coupled/model/models.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/solid/step/solid_equations.h>

#include <memory>
#include <string>

namespace undine
{
  /// The surface flux: what the surfaces displace of the fluid in a stage, given the bodies'
  /// velocity u = u^{n+1} at its end, and by the transpose the forces of the pressure on the
  /// bodies. B belongs to the positions at which the grid was cut, or is its mean over the
  /// displacement increment from there (`swept`).
  template <int dim>
  class SurfaceFlux
  {
  public:
    using Vector = BlockSystem::Vector;
    using Matrix = BlockSystem::Matrix;

    virtual ~SurfaceFlux() = default;

    /// Let the bodies end the step with `velocity`. Collective.
    virtual void
    move(const Vector &velocity) = 0;

    /// k [1]: the derivative of fluxes() with respect to u is k B, if the dependence of B on u is
    /// neglected.
    virtual double
    factor() const = 0;

    /// By how much the means over the motion of the fluid's weight, of the pressures of void
    /// regions and of those outside of openings differ from the loads where the grid was cut, in
    /// the nodes of all surfaces [N]; empty: by nothing. Collective.
    virtual typename FluidGeometry<dim>::Velocities
    change_at_rest() const
    {
      return {};
    }

    /// Do nodal_forces(pressure) and change_at_rest() depend on u, by B?
    virtual bool
    has_stiffness() const
    {
      return false;
    }

    /// Subtract from `tangent` the derivative of both with respect to u: the stiffness of the
    /// pressure that surfaces turn in. Collective.
    virtual void
    subtract_stiffness(Matrix & /*tangent*/, const Field<dim> & /*pressure*/) const
    {
    }

    /// B [m^(dim-1)], with a row for each pressure and a column for each degree of freedom of the
    /// bodies, empty for fixed ones.
    const Matrix &
    matrix() const
    {
      return flux_matrix;
    }

    /// Velocities of all nodes that B is applied to [m/s].
    const typename FluidGeometry<dim>::Velocities &
    node_velocities() const
    {
      return velocities;
    }

    /// What they sweep in a step of dt [s], see FluidGeometry::swept_volume_flux().
    SweptVolumeFlux
    swept_volume_flux(const double dt) const
    {
      return geometry.swept_volume_flux(*flux_operator, velocities, dt);
    }

    /// The surface flux out of each component of the fluid, [FluidTopology::cells] [m^dim/s].
    std::vector<double>
    fluxes() const;

    /// What the pressure does to what is added to B u, (C3), for the volumes of closed regions:
    /// the sum of both over all components [W]. Collective.
    double
    power_beside_velocities(const Field<dim> &pressure) const;

    /// B^T p in all nodes [N]. Collective.
    typename FluidGeometry<dim>::Velocities
    nodal_forces(const Field<dim> &pressure) const;

    /// Forces in all nodes, as those of their degrees of freedom on the bodies, fixed ones included
    /// [N]: of nodal_forces() J p. Collective.
    Vector
    on_bodies(const typename FluidGeometry<dim>::Velocities &forces) const;

  protected:
    using Velocities = typename FluidGeometry<dim>::Velocities;

    SurfaceFlux(const Models<dim>          &models,
                const FluidGeometry<dim>   &geometry,
                const PressureNumbers<dim> &numbers);

    /// From now on this is B, which must live on.
    void
    use(const BoundaryFlux<dim> &new_operator);

    const Models<dim>          &models;
    const FluidGeometry<dim>   &geometry;
    const PressureNumbers<dim> &numbers;
    Velocities                  velocities; ///< of all nodes, to which B is applied [m/s]
    std::vector<double>         further;    ///< added to B times these [m^dim/s]; empty: nothing

  private:
    const BoundaryFlux<dim> *flux_operator = nullptr;
    Matrix                   flux_matrix;
  };


  /// Positions of the nodes at the begin of a stage and their displacement increments in it.
  template <int dim>
  struct BodiesInStage
  {
    /// For a stage of the step that begins at `time` = t^n [s]; the bodies in `state` are those at
    /// its start. Collective.
    BodiesInStage(const Models<dim> &models,
                  const State<dim>  &state,
                  const Stage       &stage,
                  double             time);

    const Stage  stage;
    const double time; ///< t^n [s]

    typename FluidGeometry<dim>::Positions before; ///< where all nodes were at its begin [m]

    /// Of bodies to the start of the stage, of obstacles to its end [m].
    typename FluidGeometry<dim>::Velocities increment;
  };


  /// The surface flux of a stage. For steps of one stage `kind` decides: with `initial` it is B u
  /// with B at d^n, and the volume of a closed region drifts in first order of h; with `swept` it
  /// is the mean of B over the displacement increment times (d^{n+1} - d^n) / h, and the volume is
  /// exact (BoundaryFlux). For stages that keep rates, whatever `kind`, it is B u at the end of the
  /// stage, with the correction (C3) that makes the volumes of closed regions exact
  /// (ClosedRegionVolumes). The references must outlive the result. Collective.
  template <int dim>
  std::unique_ptr<SurfaceFlux<dim>>
  make_surface_flux(const std::string          &kind,
                    const Models<dim>          &models,
                    const FluidGeometry<dim>   &geometry,
                    const PressureNumbers<dim> &numbers,
                    const SolidEquations<dim>  &solid,
                    const BodiesInStage<dim>   &bodies);
} // namespace undine

#endif
