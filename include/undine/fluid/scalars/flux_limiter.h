// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_flux_limiter_h
#define undine_fluid_scalars_flux_limiter_h

#include <undine/fluid/grid/cell_links.h>

#include <algorithm>

namespace undine
{
  /// The shares of fluxes that can be added to values without leaving given bounds, whichever of
  /// them come together: flux-corrected transport (Zalesak 1979),
  ///
  ///     R+ = min(1, V (max - s) / sum of what enters)
  ///     R- = min(1, V (s - min) / sum of what leaves)
  ///
  /// of which a flux has the smaller one, R- of where it leaves and R+ of where it enters.
  template <int dim>
  class FluxLimiter
  {
  public:
    /// `values` s within `lower` and `upper`, volumes V [m^dim].
    FluxLimiter(const Field<dim> &values,
                const Field<dim> &lower,
                const Field<dim> &upper,
                const Field<dim> &volumes)
      : rise(values)
      , fall(values)
      , entering(values.shared_lattice(), values.topology())
      , leaving(entering)
    {
      for_each_cell_place(values, [&](const PressurePlace<dim> &place) {
        const double value = value_at(values, place), volume = value_at(volumes, place);
        value_at(rise, place) = std::max(0., volume * (value_at(upper, place) - value));
        value_at(fall, place) = std::max(0., volume * (value - value_at(lower, place)));
      });
    }

    /// Of all that leaves an owned place; negative: enters it.
    void
    count(const PressurePlace<dim> &place, const double amount)
    {
      value_at(amount > 0 ? leaving : entering, place) += std::abs(amount);
    }

    /// After all have been counted. Collective.
    void
    finish()
    {
      for_each_cell_place(leaving, [&](const PressurePlace<dim> &place) {
        const auto set_share = [&](double &room, const double wanted) {
          room = room < wanted ? room / wanted : 1.;
        };
        set_share(value_at(rise, place), value_at(entering, place));
        set_share(value_at(fall, place), value_at(leaving, place));
      });
      rise.exchange(1);
      fall.exchange(1);
    }

    /// Of `amount` that leaves `from`, or enters it if negative: through a side of the domain, or
    /// to the other place. @{
    double
    share(const PressurePlace<dim> &from, const double amount) const
    {
      return value_at(amount > 0 ? fall : rise, from);
    }

    double
    share(const CellLink<dim> &link, const double amount) const
    {
      return std::min(share(link.from, amount), share(link.to, -amount));
    }
    /// @}

  private:
    Field<dim> rise, fall; ///< room, then shares
    Field<dim> entering, leaving;
  };
} // namespace undine

#endif
