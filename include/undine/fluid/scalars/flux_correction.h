// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_flux_correction_h
#define undine_fluid_scalars_flux_correction_h

#include <undine/fluid/scalars/scalar_bounds.h>

#include <vector>

namespace undine
{
  /// Amounts that are to move between cells and components, and through sides of the domain, on top
  /// of values that are within their bounds: flux-corrected transport (Boris, Book 1973; Zalesak
  /// 1979).
  ///
  /// All of them move but those at places that would leave their bounds by all that move, which are
  /// sought until none is added. Of the rest, so much moves as bounds allow whichever of the
  /// amounts at a place come together (FluxLimiter), in rounds. What does not come near the bounds
  /// is unlimited so, even where large amounts that nearly cancel each other go through a place, as
  /// those of diffusion do in long steps.
  template <int dim>
  class FluxCorrection
  {
  public:
    /// The references must outlive this; `volumes` [m^dim].
    FluxCorrection(const ScalarFluxes<dim> &fluxes,
                   const ScalarBounds<dim> &bounds,
                   const Field<dim>        &volumes)
      : fluxes(fluxes)
      , bounds(bounds)
      , volumes(volumes)
    {
    }

    /// Of the next link of ScalarFluxes::for_each(), out of its first place, in units of values
    /// times volumes.
    void
    add(const double amount)
    {
      of_links.push_back(amount);
    }

    /// Out of a place through a side of the domain.
    void
    add_at_side(const PressurePlace<dim> &place, const double amount)
    {
      CellLink<dim> side{};
      side.from = place;
      at_sides.push_back({side, amount, true});
    }

    /// To owned values; the amounts are used up. Collective.
    void
    move(Field<dim> &values);

  private:
    /// Out of the first place of a link, or through a side there.
    struct Amount
    {
      CellLink<dim> link;
      double        amount;
      bool          at_side;
    };

    std::vector<Amount>
    move_all_that_can(Field<dim> &values) const;
    void
    move_within_bounds(Field<dim> &values, std::vector<Amount> &amounts) const;
    bool
    is_fixed(const PressurePlace<dim> &place) const;
    bool
    is_outside(const PressurePlace<dim> &place, const double value) const;

    const ScalarFluxes<dim> &fluxes;
    const ScalarBounds<dim> &bounds;
    const Field<dim>        &volumes;
    std::vector<double>      of_links;
    std::vector<Amount>      at_sides;
  };
} // namespace undine

#endif
