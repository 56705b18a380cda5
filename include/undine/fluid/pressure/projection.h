// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_projection_h
#define undine_fluid_pressure_projection_h

#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/pressure/backflow_stabilisation.h>
#include <undine/fluid/pressure/closed_regions.h>
#include <undine/fluid/pressure/pressure_balance.h>
#include <undine/fluid/pressure/pressure_gradient.h>
#include <undine/fluid/pressure/swept_volume_flux.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

namespace undine
{
  /// Makes a velocity divergence-free:
  ///
  ///     v^{n+1} = v* + h (rho V)^-1 D^T p,    D v^{n+1} = 0,    i.e.  h L p = -D v*
  ///
  /// with L = D (rho V)^-1 D^T (F4), (F5), (F6), see build_pressure_matrix(). p acts as one impulse
  /// h p; the unknown is h p, so that matrix and multigrid hierarchy serve all step sizes.
  /// Conjugate gradients with multigrid (CellPreconditioner), started from the last pressure;
  /// repeated on the remaining divergence until that is below the tolerance in every single cell.
  template <int dim>
  class Projection
  {
  public:
    /// The result of a projection.
    struct Report
    {
      unsigned int iterations = 0;
      double       divergence = 0; ///< max |div v| dx / max |v| afterwards [1]

      /// After project(): v* with the velocity on walls and inflows, and the openings with the
      /// pressures that have acted.
      Velocity<dim>              before;
      std::vector<OpenFace<dim>> openings;

      /// The balance of energy and momentum of the projection that led to `state`. Collective.
      PressureBalance<dim>
      balance(const FluidModel<dim> &model, const FluidState<dim> &state) const;
    };

    /// The model must outlive the projection. Nothing is assembled before the first use.
    explicit Projection(const FluidModel<dim> &model);

    /// v* in `state` becomes v^{n+1} at `time` = t^{n+1}, its pressure p. Sets the velocity on
    /// walls and inflows first. Throws InputError if a region without opening has a net inflow,
    /// SolveError if the solver does not converge. Collective.
    ///
    /// `advecting` = v^n is a first guess of the backflow through outflows; v* is none: friction
    /// adds h grad p^n / rho to it, which may point inwards in a steady outflow. `swept`: the
    /// swept-volume flux of surfaces.
    Report
    project(FluidState<dim>       &state,
            const Velocity<dim>   &advecting,
            const double           time,
            const double           dt,
            const SweptVolumeFlux &swept = {});

    /// The same with v* in the place of v^n and without surfaces. Collective.
    Report
    project(FluidState<dim> &state, const double time, const double dt);

    /// After project(): the mean pressures of closed regions, which are zero then, become those of
    /// the pressure `before` [Pa]. Collective.
    void
    keep_levels(Field<dim> &pressure, const Field<dim> &before) const;

    /// The velocity becomes the nearest divergence-free one, with the velocity on walls and inflows
    /// at `time` [s]; the pressure becomes zero. Throws as project() does. Collective.
    Report
    make_divergence_free(FluidState<dim>       &state,
                         const double           time,
                         const SweptVolumeFlux &swept = {});

    /// The velocity becomes the nearest one that lets as much fluid into cells and components as
    /// they grow by, `growth` [m^dim/s], with the velocity on walls and inflows at `time` [s]. What
    /// closed regions cannot take is spread over them; up to the root of the divergence tolerance.
    /// Returns the iterations of the solver. Throws SolveError. Collective.
    unsigned int
    fit_to_growth(Velocity<dim> &velocity, const Field<dim> &growth, const double time);

  private:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// Build matrix and multigrid hierarchy for this topology of the fluid, unless they are there.
    void
    prepare(const std::shared_ptr<const FluidTopology<dim>> &topology);

    /// impulse := L^-1 right_side up to `tolerance` in the Euclidean norm, `stabilised` being L
    /// with the backflow stabilisation.
    unsigned int
    solve(Vector               &impulse,
          const Vector         &right_side,
          const BackflowMatrix &stabilised,
          const double          tolerance) const;

    void
    balance_openings(Vector               &impulse,
                     const Vector         &right_side,
                     const BackflowMatrix &stabilised) const;

    /// Add impulses h p to the velocity until its divergence, in a cell and relative to the speed,
    /// is at most `tolerance`, beginning with those in `impulse`, which becomes the sum of all
    /// [Pa s]. The openings hold impulses in the place of pressures; they are used up.
    Report
    remove_divergence(Velocity<dim>              &velocity,
                      Field<dim>                 &impulse,
                      std::vector<OpenFace<dim>> &openings,
                      const std::vector<double>  &body_fluxes,
                      double                      tolerance);

    /// The same to the scene's tolerance at the end of a step dt, with openings that hold
    /// pressures, and with backflow stabilisation, see stabilise_backflow(). Where there is
    /// backflow, its speeds are found by rounds that are less accurate.
    Report
    remove_divergence_with_openings(Velocity<dim>             &velocity,
                                    Field<dim>                &impulse,
                                    std::vector<OpenFace<dim>> openings,
                                    const double               dt,
                                    const std::vector<double> &body_fluxes);

    const FluidModel<dim>                                  &model;
    std::unique_ptr<const PressureNumbers<dim>>             numbers;
    std::unique_ptr<const ClosedRegions<dim>>               closed_regions;
    std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix> matrix; ///< none without fluid
    std::unique_ptr<CellPreconditioner>                     multigrid;
    double                                                  smallest_area = 0; ///< [m^(dim-1)]
  };
} // namespace undine

#endif
