// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/closed_region_volumes.h>
#include <undine/coupled/immersed/facet_stiffness.h>
#include <undine/coupled/immersed/surface_flux.h>
#include <undine/operators/flux_matrix.h>

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


    /// B u with B of the end of the stage, corrected so that the volumes of closed regions are
    /// exact.
    template <int dim>
    class FluxAtEnd : public SurfaceFlux<dim>
    {
    public:
      using Vector = typename SurfaceFlux<dim>::Vector;

      FluxAtEnd(const Models<dim>          &models,
                const FluidGeometry<dim>   &geometry,
                const PressureNumbers<dim> &numbers,
                const SolidEquations<dim>  &solid,
                const BodiesInStage<dim>   &bodies)
        : SurfaceFlux<dim>(models, geometry, numbers)
        , solid(solid)
        , increment(bodies.increment)
        , volumes(models, geometry, numbers, bodies.stage, bodies.time, bodies.before)
      {
        this->use(geometry.boundary_flux());
      }

      void
      move(const Vector &velocity) override
      {
        const auto &surface = *this->models.surface;
        this->velocities    = surface.with_bodies(velocity, this->velocities);
        if (volumes.empty())
          return;
        auto       whole_increment = increment;
        const auto further         = surface.with_bodies(
          solid.increment(velocity), typename FluidGeometry<dim>::Velocities(increment.size()));
        for (std::size_t node = 0; node < increment.size(); ++node)
          whole_increment[node] += further[node];
        this->further.clear();
        this->further = volumes.missing_fluxes(this->fluxes(), whole_increment);
      }

      double
      factor() const override
      {
        return 1;
      }

    private:
      const SolidEquations<dim>                    &solid;
      const typename FluidGeometry<dim>::Velocities increment; ///< to the start of the stage [m]
      const ClosedRegionVolumes<dim>                volumes;
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
                const BodiesInStage<dim>   &bodies)
        : SurfaceFlux<dim>(models, geometry, numbers)
        , solid(solid)
        , dt(bodies.stage.length)
      {
        // Their own way, not that by which B where they begin keeps their volume.
        for (std::size_t node = models.surface->n_body_nodes(); node < bodies.increment.size();
             ++node)
          this->velocities[node] = bodies.increment[node] / dt;
        const double time    = bodies.time + bodies.stage.end;
        const auto   gravity = models.requests_of_effects().gravity;
        outside              = geometry.outside_pressures_on_facets(gravity, time);
        pressures_at_rest    = geometry.void_pressures(time);
        if (gravity.norm() > 0)
          {
            const auto of_fluid =
              geometry.cut_topology().of_cut_cells(geometry.static_pressures(gravity));
            pressures_at_rest.resize(of_fluid.size(), 0.);
            for (std::size_t c = 0; c < of_fluid.size(); ++c)
              pressures_at_rest[c] += of_fluid[c];
          }
        if (models.void_regions || gravity.norm() > 0)
          forces_at_rest = undine::nodal_forces(
            geometry.boundary_flux(), pressures_at_rest, models.communicator());
      }

      void
      move(const Vector &velocity) override
      {
        // Not from d^{n+1}: near rest its rounding is more than what Newton's method may leave.
        Vector mean_velocity = solid.increment(velocity);
        mean_velocity *= 1 / dt;
        this->velocities   = this->models.surface->with_bodies(mean_velocity, this->velocities);
        const auto &before = this->geometry.surface_positions();
        after              = before;
        for (std::size_t node = 0; node < after.size(); ++node)
          after[node] += dt * this->velocities[node];
        mean = std::make_unique<const BoundaryFlux<dim>>(this->geometry.cut_cells(),
                                                         this->models.surface->surface(),
                                                         this->geometry.cut_positions(),
                                                         before,
                                                         after);
        this->use(*mean);
      }

      double
      factor() const override
      {
        return solid.displacement_factor() / dt;
      }

      /// The reduced pressure, which acts by the mean of B, holds up the weight of the fluid: were
      /// that, the pressures of void regions and those outside of openings to act by the areas at
      /// the begin, the level of the pressure would move bodies.
      typename FluidGeometry<dim>::Velocities
      change_at_rest() const override
      {
        typename FluidGeometry<dim>::Velocities forces(after.size());
        if (!forces_at_rest.empty())
          {
            forces = undine::nodal_forces(*mean, pressures_at_rest, this->models.communicator());
            for (std::size_t node = 0; node < forces.size(); ++node)
              forces[node] -= forces_at_rest[node];
          }
        const auto &surface = this->models.surface->surface();
        for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
          for (unsigned int k = 0; k < dim; ++k)
            if (const double pressure = outside[facet * dim + k]; pressure != 0)
              forces[surface.facets()[facet][k]] +=
                pressure *
                (mean_area_vector(surface, facet, this->geometry.surface_positions(), after) -
                 area_vector(surface, facet, this->geometry.cut_positions()));
        return forces;
      }

      bool
      has_stiffness() const override
      {
        return true;
      }

      void
      subtract_stiffness(typename SurfaceFlux<dim>::Matrix &tangent,
                         const Field<dim>                  &pressure) const override
      {
        auto pressures = this->geometry.cut_topology().of_cut_cells(pressure.parts());
        for (std::size_t c = 0; c < pressures_at_rest.size(); ++c)
          pressures[c] += pressures_at_rest[c];
        const auto &immersed = *this->models.surface;
        const auto &surface  = immersed.surface();
        const auto &before   = this->geometry.surface_positions();
        auto        loads    = pressures_on_facets(this->geometry.cut_cells(),
                                         surface,
                                         this->geometry.cut_positions(),
                                         pressures,
                                         this->models.communicator());
        for (std::size_t k = 0; k < loads.size(); ++k)
          loads[k] += outside[k];
        add_facet_stiffness(
          tangent,
          immersed,
          after,
          [&](const unsigned int facet, const auto &positions) {
            return mean_area_vector(surface, facet, before, positions);
          },
          [&](const unsigned int facet, const unsigned int k) {
            return -solid.displacement_factor() * loads[facet * dim + k];
          });
      }

    private:
      const SolidEquations<dim>               &solid;
      const double                             dt;
      std::unique_ptr<const BoundaryFlux<dim>> mean;
      std::vector<dealii::Point<dim>>          after; ///< where nodes are at the end [m]

      /// Of the fluid at rest and of void regions [CutCells::components] [Pa], and their forces by
      /// B at the begin [N]; empty without gravity and void regions. @{
      std::vector<double>                     pressures_at_rest;
      typename FluidGeometry<dim>::Velocities forces_at_rest;
      /// @}
      std::vector<double> outside; ///< of openings, FluidGeometry::outside_pressures_on_facets()
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
      flux_matrix, new_operator, geometry.cut_topology(), numbers, *models.surface, *models.solid);
  }


  template <int dim>
  std::vector<double>
  SurfaceFlux<dim>::fluxes() const
  {
    auto result = geometry.cut_topology().of_fluid_topology(flux_operator->flux(velocities));
    for (std::size_t c = 0; c < further.size(); ++c)
      result[c] += further[c];
    return result;
  }


  template <int dim>
  double
  SurfaceFlux<dim>::power_beside_velocities(const Field<dim> &pressure) const
  {
    double result = 0;
    for (std::size_t c = 0; c < further.size(); ++c)
      result += further[c] * pressure.parts()[c];
    return dealii::Utilities::MPI::sum(result, models.communicator());
  }


  template <int dim>
  typename FluidGeometry<dim>::Velocities
  SurfaceFlux<dim>::nodal_forces(const Field<dim> &pressure) const
  {
    return undine::nodal_forces(*flux_operator,
                                geometry.cut_topology().of_cut_cells(pressure.parts()),
                                models.solid->communicator());
  }


  template <int dim>
  typename SurfaceFlux<dim>::Vector
  SurfaceFlux<dim>::on_bodies(const typename FluidGeometry<dim>::Velocities &forces) const
  {
    auto result = models.solid->vector();
    models.surface->add_to_bodies(result, forces);
    return result;
  }


  template <int dim>
  BodiesInStage<dim>::BodiesInStage(const Models<dim> &models,
                                    const State<dim>  &state,
                                    const Stage       &stage,
                                    const double       time)
    : stage(stage)
    , time(time)
  {
    const auto &surface = *models.surface;
    before =
      surface.positions(stage.keeps_rates() ? state.stage_begin : state.solid, time + stage.begin);
    const auto arrived = surface.positions(state.solid, time + stage.end);
    increment.resize(before.size());
    for (std::size_t node = surface.n_body_nodes(); node < increment.size(); ++node)
      increment[node] = arrived[node] - before[node];
    if (!stage.keeps_rates())
      return;
    auto of_bodies = state.mean_velocity;
    of_bodies *= stage.going_on();
    increment = surface.with_bodies(of_bodies, increment);
  }


  template <int dim>
  std::unique_ptr<SurfaceFlux<dim>>
  make_surface_flux(const std::string          &kind,
                    const Models<dim>          &models,
                    const FluidGeometry<dim>   &geometry,
                    const PressureNumbers<dim> &numbers,
                    const SolidEquations<dim>  &solid,
                    const BodiesInStage<dim>   &bodies)
  {
    if (bodies.stage.keeps_rates())
      return std::make_unique<FluxAtEnd<dim>>(models, geometry, numbers, solid, bodies);
    if (kind == "swept")
      return std::make_unique<SweptFlux<dim>>(models, geometry, numbers, solid, bodies);
    return std::make_unique<InitialFlux<dim>>(models, geometry, numbers);
  }


#define UNDINE_INSTANTIATE(dim)                                                              \
  template class SurfaceFlux<dim>;                                                           \
  template struct BodiesInStage<dim>;                                                        \
  template std::unique_ptr<SurfaceFlux<dim>> make_surface_flux(const std::string &,          \
                                                               const Models<dim> &,          \
                                                               const FluidGeometry<dim> &,   \
                                                               const PressureNumbers<dim> &, \
                                                               const SolidEquations<dim> &,  \
                                                               const BodiesInStage<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
