// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_pressure_equations_h
#define undine_fluid_pressure_pressure_equations_h

#include <undine/base/multigrid/cell_equations.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/pressure/backflow_stabilisation.h>
#include <undine/fluid/pressure/closed_regions.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace undine
{
  /// The fluid's part of the equations of a step, D v* + B u + h L p = 0 (I3), in which B u is the
  /// swept-volume flux of surfaces, and what follows for the velocity.
  template <int dim>
  class PressureEquations
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    using Number = typename PressureNumbers<dim>::Number;

    /// `compliant`: owned pressures at compliant bodies. The references must outlive it.
    /// Collective.
    PressureEquations(const FluidModel<dim>      &model,
                      const PressureNumbers<dim> &numbers,
                      const std::vector<Number>  &compliant,
                      const double                dt);

    /// Begin with v* in `velocity`, which gets the velocity on walls and inflows at `time` [s], the
    /// end of the step. `advecting` = v^n is a first guess of the backflow through outflows.
    /// `swept`: the swept-volume flux of all surfaces, of which those that are not compliant must
    /// conserve the volume of closed regions. Collective. Throws InputError if a closed region has
    /// a net inflow.
    void
    start(Velocity<dim>         &velocity,
          const Velocity<dim>   &advecting,
          const double           time,
          const SweptVolumeFlux &swept);

    /// Add to `velocity` = v*, as start() left it, the impulse of the pressures on openings, given
    /// the speed of the backflow there, and compute predicted_flux() and matrix(). Collective.
    void
    open(Velocity<dim> &velocity);

    /// Take the speed of the backflow through outflows from v^{n+1}. Returns by how much that would
    /// change v^{n+1}, relative to its largest speed, if the step were solved again from open() on
    /// [1]. Collective.
    double
    update_backflow(const Velocity<dim> &velocity);

    const PressureNumbers<dim> &
    numbers() const
    {
      return all_numbers;
    }

    /// Where the pressures of this rank sit.
    const CellsOfUnknowns &
    places() const
    {
      return cells;
    }

    /// Is there an outflow, or another opening with a given pressure, on any rank?
    bool
    has_openings() const
    {
      return opens;
    }

    /// D v* of every pressure, with what openings do [m^dim/s].
    const Vector &
    predicted_flux() const
    {
      return flux;
    }

    /// h L [m^dim / (s Pa)]
    const dealii::TrilinosWrappers::SparseMatrix &
    matrix() const
    {
      return hL;
    }

    const ClosedRegions<dim> &
    closed_regions() const
    {
      return regions;
    }

    /// With the pressures that have acted, after update_backflow().
    const std::vector<OpenFace<dim>> &
    open_faces() const
    {
      return openings;
    }

    /// A number for each pressure from one for each component of the fluid; zero in whole cells.
    Vector
    from_components(const std::vector<double> &values) const;

    /// The field of these pressures, without ghost values.
    Field<dim>
    field(const Vector &pressure) const;

    /// v* += h (rho V)^-1 D^T p. Collective.
    void
    accelerate(Velocity<dim> &velocity, const Vector &pressure) const;

    /// max |D v + B u| per face of a cell and speed [1]. Collective.
    double
    divergence(const Velocity<dim> &velocity, const std::vector<double> &body_fluxes) const;

  private:
    const FluidModel<dim>                 &model;
    const double                           dt;
    const PressureNumbers<dim>            &all_numbers;
    const CellsOfUnknowns                  cells;
    const ClosedRegions<dim>               regions;
    dealii::TrilinosWrappers::SparseMatrix L, hL;
    Vector                                 flux;
    bool                                   opens = false;
    std::vector<OpenFace<dim>> openings, closed_openings; ///< with pressures and without
  };
} // namespace undine

#endif
