// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_closed_regions_h
#define undine_fluid_pressure_closed_regions_h

#include <undine/base/core/errors.h>
#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/pressure/swept_volume_flux.h>

#include <deal.II/lac/trilinos_vector.h>

#include <string>
#include <vector>

namespace undine
{
  /// More fluid flows into a region without outlet than out of it.
  class NoOutletError : public InputError
  {
  public:
    using InputError::InputError;
  };


  /// The closed regions of the fluid, which have no opening, but for those with compliant surfaces:
  /// there the pressure is known up to a constant, and what flows in must flow out.
  template <int dim>
  class ClosedRegions
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    using Number = typename PressureNumbers<dim>::Number;

    /// `compliant`: owned pressures at surfaces of bodies that the pressure can move. The
    /// references must outlive it. Collective.
    ClosedRegions(const FluidModel<dim>      &model,
                  const PressureNumbers<dim> &numbers,
                  const std::vector<Number>  &compliant = {});

    /// Are there any, on whatever rank?
    bool
    exist() const
    {
      return !region_volumes.empty();
    }

    /// The lowest pressure number of every closed region, as far as this rank owns them.
    const std::vector<Number> &
    pinned() const
    {
      return pins;
    }

    /// The swept-volume fluxes of bodies, [FluidTopology::cells] [m^dim/s], changed within their
    /// uncertainties so that the volume of each closed region is conserved; compliant
    /// surfaces move as far as that takes. Throws InputError (NoOutletError, if something is cut)
    /// if more than the uncertainty enters or leaves a region through faces with a given velocity
    /// and through surfaces. Collective.
    std::vector<double>
    balanced_fluxes(const Velocity<dim>   &velocity,
                    const SweptVolumeFlux &swept,
                    const double           time) const;

    /// Shift the pressures of each closed region so that its pinned one is zero. Corrections of
    /// balanced residuals leave that so: pinning then changes nothing. Collective.
    void
    fix_pressure_level(Vector &pressure) const;

    /// Make the entries of each closed region sum to zero, by changes in proportion to volume.
    /// Collective.
    void
    balance(Vector &right_side) const;

    /// Make the mean of the pressure over each closed region zero. Collective.
    void
    remove_means(Field<dim> &pressure) const;

    /// Make it that of the pressure `before`, on the same topology. Collective.
    void
    keep_means(Field<dim> &pressure, const Field<dim> &before) const;

    /// Number of closed regions.
    std::size_t
    size() const
    {
      return region_volumes.size();
    }

    /// The volume of each closed region [m^dim].
    const std::vector<double> &
    volumes_of_regions() const
    {
      return region_volumes;
    }

    /// The centroid of the largest cell or component of each closed region [m]. Collective.
    std::vector<dealii::Point<dim>>
    places_within() const;

    /// The volume flux out of each closed region through walls and inflows at `time` [s],
    /// [m^dim/s]. Collective.
    std::vector<double>
    prescribed_outflow(const double time) const;

    /// Sums over each closed region of `values` [FluidTopology::cells]. Collective.
    std::vector<double>
    sums_on_components(const std::vector<double> &values) const;

    /// The number of the closed region of each of FluidTopology::cells; negative: none. Not
    /// collective.
    std::vector<int>
    of_components() const;

  private:
    Field<dim>
    prescribed_fluxes(const double time) const;

    static constexpr int open_region = -1;

    /// The closed region of each pressure of this rank.
    Field<dim>
    regions_of_pressures() const;

    /// Sum over the closed regions of what each pressure of this rank contributes, in the order of
    /// PressureNumbers.
    template <class Contribution>
    std::vector<double>
    sums(const Contribution &contribution) const;

    /// The same of a function of the field's values.
    template <class Function>
    std::vector<double>
    sums_of(const Field<dim> &field, const Function &function) const;

    /// A message: where a region lies, and the fluxes out of it through the surface of each body
    /// and through boundaries. Collective.
    std::string
    describe(const int region, const SweptVolumeFlux &swept, const double through_boundaries) const;

    const FluidModel<dim>      &model;
    const PressureNumbers<dim> &numbers;
    std::vector<int>            regions; ///< closed one of each pressure
    std::vector<double>         volumes; ///< of each pressure [m^dim]
    std::vector<double>         region_volumes;
    std::vector<Number>         pins;
  };
} // namespace undine

#endif
