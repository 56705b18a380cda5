// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_closed_regions_h
#define undine_fluid_closed_regions_h

#include <undine/fluid/fluid_model.h>
#include <undine/fluid/pressure_numbers.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace undine
{
  /// The regions of the fluid on whose boundary the pressure is given nowhere and nothing gives
  /// way: there it is known up to a constant, and what flows in must flow out.
  template <int dim>
  class ClosedRegions
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    using Number = typename PressureNumbers<dim>::Number;

    /// `yielding`: owned pressures at surfaces of bodies that move as pressure makes them. The
    /// references must outlive it. Collective.
    ClosedRegions(const FluidModel<dim>      &model,
                  const PressureNumbers<dim> &numbers,
                  const std::vector<Number>  &yielding = {});

    /// One pressure of each closed region, if this rank owns it.
    const std::vector<Number> &
    pinned() const
    {
      return pins;
    }

    /// Throws InputError if volume enters or leaves a closed region: through held faces of
    /// `velocity`, or pushed by bodies (`body_fluxes` [component], (B u)_c [m^dim/s], may be
    /// empty).
    void
    check_net_flux(const Velocity<dim>       &velocity,
                   const std::vector<double> &body_fluxes,
                   const double               time) const;

    /// Make the entries of each closed region sum to zero, by changes in proportion to volume.
    void
    balance(Vector &right_side) const;

    /// Make the mean of the pressure over each closed region zero.
    void
    remove_means(Field<dim> &pressure) const;

  private:
    static constexpr int open_region = -1;

    /// Sum over the closed regions of what each pressure of this rank contributes, in the order of
    /// PressureNumbers.
    template <class Contribution>
    std::vector<double>
    sums(const Contribution &contribution) const;

    const FluidModel<dim>      &model;
    const PressureNumbers<dim> &numbers;
    std::vector<int>            regions; ///< closed one of each pressure
    std::vector<double>         volumes; ///< of each pressure [m^dim]
    std::vector<double>         region_volumes;
    std::vector<Number>         pins;
  };
} // namespace undine

#endif
