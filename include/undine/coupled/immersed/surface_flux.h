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
  /// How the bodies push the fluid in a step, and by the transpose the fluid the bodies, given the
  /// bodies' velocity u = u^{n+1} at its end. B belongs to where the grid was cut, d^n.
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

    /// k: the derivative of fluxes() with respect to u is k B, but for what u does to B.
    virtual double
    factor() const = 0;

    /// B with a column for each degree of freedom of the bodies, empty for fixed ones.
    const Matrix &
    matrix() const
    {
      return flux_matrix;
    }

    /// Of all nodes, as the fluid meets them [m/s].
    const typename FluidGeometry<dim>::Velocities &
    node_velocities() const
    {
      return velocities;
    }

    /// What all surfaces push out of each component of the fluid [m^dim/s].
    std::vector<double>
    fluxes() const;

    /// B^T p in all nodes [N]. Collective.
    typename FluidGeometry<dim>::Velocities
    nodal_forces(const Field<dim> &pressure) const;

    /// J p = B^T p over the bodies' degrees of freedom, fixed ones included [N]. Collective.
    Vector
    forces(const Field<dim> &pressure) const;

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
    Velocities                  velocities; ///< of all nodes, as the fluid meets them [m/s]
    std::vector<double>         further;    ///< added to B times these [m^dim/s]; empty: nothing

  private:
    const BoundaryFlux<dim> *flux_operator = nullptr;
    Matrix                   flux_matrix;
  };


  /// Where the bodies are when a stage starts, and how they came there.
  template <int dim>
  struct BodiesInStage
  {
    /// Of a stage of the step that begins at `time` = t^n; the bodies in `state` are those at its
    /// start. Collective.
    BodiesInStage(const Models<dim> &models,
                  const State<dim>  &state,
                  const Stage       &stage,
                  double             time);

    const Stage  stage;
    const double time; ///< t^n [s]

    /// Of all nodes, if the stage keeps rates. @{
    typename FluidGeometry<dim>::Positions before; ///< where they were at t^n [m]
    typename FluidGeometry<dim>::Velocities
      increment; ///< of bodies to the start, of others to the end [m]
    /// @}
  };


  /// Those that there are. For steps of one stage: `initial`, B u with B at d^n, which the volume
  /// of a closed chamber obeys to first order in h; `swept`, the mean of B on the way times
  /// (d^{n+1} - d^n) / h, which it obeys exactly (BoundaryFlux). For stages that keep rates,
  /// whatever `kind`: B u at the end of the stage, where chambers obey exactly (ChamberVolumes).
  /// The references must outlive the result.
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
