// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/registry.h>
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/stability/added_mass.h>
#include <undine/fluid/grid/places_of_pressures.h>
#include <undine/fluid/pressure/closed_regions.h>
#include <undine/fluid/pressure/pressure_matrix.h>
#include <undine/operators/flux_matrix.h>

#include <deal.II/lac/solver_cg.h>

namespace undine
{
  namespace
  {
    constexpr double of_residual = 1e-8; // at which the pressure is good enough
  }


  template <int dim>
  AddedMass<dim>::AddedMass(const Models<dim> &models, const State<dim> &state)
    : maximum_iterations(models.fluid->pressure_solver().maximum_iterations)
  {
    const auto                &fluid    = *models.fluid;
    const auto                 geometry = geometry_of(models, state);
    const auto                &parts    = geometry->cut_topology();
    const PressureNumbers<dim> numbers(fluid.grid(), geometry->bodies().topology);
    build_flux_matrix(B, geometry->boundary_flux(), parts, numbers, *models.surface, *models.solid);
    const ClosedRegions<dim> all(fluid, numbers);
    const ClosedRegions<dim> without_bodies(fluid, numbers, filled_rows(B));
    no_region_is_closed = all.size() == without_bodies.size();
    build_pressure_matrix(L, fluid, numbers, all.pinned());
    multigrid = Registry<CellPreconditioner>::instance().make(fluid.pressure_solver().multigrid);
    multigrid->initialize(L, L, places_of_pressures(fluid.grid(), numbers));
  }


  template <int dim>
  void
  AddedMass<dim>::vmult(Vector &result, const Vector &u) const
  {
    Vector flux(L.locally_owned_range_indices(), L.get_mpi_communicator()), pressure(flux);
    B.vmult(flux, u);
    dealii::SolverControl control(maximum_iterations, of_residual * flux.l2_norm());
    try
      {
        dealii::SolverCG<Vector>(control).solve(L, pressure, flux, *multigrid);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        throw SolveError("the fluid's pressure did not converge when its added mass was computed. "
                         "Try a larger 'Fluid/Pressure solver/Maximum iterations'.");
      }
    B.Tvmult(result, pressure);
  }


  template class AddedMass<2>;
  template class AddedMass<3>;
} // namespace undine
