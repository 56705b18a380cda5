// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/surface_flux.h>
#include <undine/interface/flux_matrix.h>

namespace undine
{
  namespace
  {
    /// B u.
    template <int dim>
    class InitialFlux : public SurfaceFlux<dim>
    {
    public:
      using Vector = typename SurfaceFlux<dim>::Vector;

      InitialFlux(const Models<dim>          &models,
                  const FluidGeometry<dim>   &geometry,
                  const PressureNumbers<dim> &numbers)
        : SurfaceFlux<dim>(models, geometry, numbers)
      {
        this->use(geometry.boundary_flux());
      }

      void
      move(const Vector &velocity) override
      {
        this->velocities = this->models.surface->with_bodies(velocity, this->velocities);
      }

      double
      factor() const override
      {
        return 1;
      }
    };


    /// The mean of B between d^n and d^{n+1}, times (d^{n+1} - d^n) / h.
    template <int dim>
    class SweptFlux : public SurfaceFlux<dim>
    {
    public:
      using Vector = typename SurfaceFlux<dim>::Vector;

      SweptFlux(const Models<dim>          &models,
                const FluidGeometry<dim>   &geometry,
                const PressureNumbers<dim> &numbers,
                const SolidEquations<dim>  &solid,
                const double                dt)
        : SurfaceFlux<dim>(models, geometry, numbers)
        , solid(solid)
        , dt(dt)
      {
      }

      void
      move(const Vector &velocity) override
      {
        // Not from d^{n+1}: near rest its rounding is more than what Newton's method may leave.
        Vector mean_velocity = solid.increment(velocity);
        mean_velocity *= 1 / dt;
        this->velocities   = this->models.surface->with_bodies(mean_velocity, this->velocities);
        const auto &before = this->geometry.surface_positions();
        auto        after  = before;
        for (std::size_t node = 0; node < after.size(); ++node)
          after[node] += dt * this->velocities[node];
        mean = std::make_unique<const BoundaryFlux<dim>>(
          this->geometry.cut_cells(), this->models.surface->surface(), before, after);
        this->use(*mean);
      }

      double
      factor() const override
      {
        return solid.displacement_factor() / dt;
      }

    private:
      const SolidEquations<dim>               &solid;
      const double                             dt;
      std::unique_ptr<const BoundaryFlux<dim>> mean;
    };
  } // namespace


  template <int dim>
  SurfaceFlux<dim>::SurfaceFlux(const Models<dim>          &models,
                                const FluidGeometry<dim>   &geometry,
                                const PressureNumbers<dim> &numbers)
    : models(models)
    , geometry(geometry)
    , numbers(numbers)
    , velocities(geometry.surface_velocities())
  {
  }


  template <int dim>
  void
  SurfaceFlux<dim>::use(const BoundaryFlux<dim> &new_operator)
  {
    flux_operator = &new_operator;
    build_flux_matrix(
      flux_matrix, new_operator, geometry.cut_parts(), numbers, *models.surface, *models.solid);
  }


  template <int dim>
  std::vector<double>
  SurfaceFlux<dim>::fluxes() const
  {
    return geometry.cut_parts().of_open_parts(flux_operator->flux(velocities));
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  SurfaceFlux<dim>::nodal_forces(const Field<dim> &pressure) const
  {
    return undine::nodal_forces(*flux_operator,
                                geometry.cut_parts().of_cut_cells(pressure.parts()),
                                models.solid->communicator());
  }


  template <int dim>
  typename SurfaceFlux<dim>::Vector
  SurfaceFlux<dim>::forces(const Field<dim> &pressure) const
  {
    auto result = models.solid->vector();
    models.surface->add_to_bodies(result, nodal_forces(pressure));
    return result;
  }


  template <int dim>
  std::unique_ptr<SurfaceFlux<dim>>
  make_surface_flux(const std::string          &kind,
                    const Models<dim>          &models,
                    const FluidGeometry<dim>   &geometry,
                    const PressureNumbers<dim> &numbers,
                    const SolidEquations<dim>  &solid,
                    const double                dt)
  {
    if (kind == "swept")
      return std::make_unique<SweptFlux<dim>>(models, geometry, numbers, solid, dt);
    return std::make_unique<InitialFlux<dim>>(models, geometry, numbers);
  }


  template class SurfaceFlux<2>;
  template class SurfaceFlux<3>;
  template std::unique_ptr<SurfaceFlux<2>>
  make_surface_flux(const std::string &,
                    const Models<2> &,
                    const FluidGeometry<2> &,
                    const PressureNumbers<2> &,
                    const SolidEquations<2> &,
                    const double);
  template std::unique_ptr<SurfaceFlux<3>>
  make_surface_flux(const std::string &,
                    const Models<3> &,
                    const FluidGeometry<3> &,
                    const PressureNumbers<3> &,
                    const SolidEquations<3> &,
                    const double);
} // namespace undine
