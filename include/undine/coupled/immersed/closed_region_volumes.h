// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_closed_region_volumes_h
#define undine_coupled_immersed_closed_region_volumes_h

#include <undine/base/core/stage.h>
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/fluid/pressure/closed_regions.h>

#include <vector>

namespace undine
{
  /// The volumes of the closed regions that bodies touch. The surface flux is B u at the end of a
  /// stage, with which volumes drift in second order of h. They are conserved to rounding if the
  /// surface flux out of the region c has the additional term
  ///
  ///     ( S_c + sum_j w_j q_c(t_j) ) / g - (B u)_c    [m^dim/s],                             (C3)
  ///
  /// spread over the bodies' surface there. S: what the region gains from the begin to the end t^e
  /// of the stage, the difference of its volumes: that where the grid is cut for the stage and that
  /// at the begin are exact, and from the former to the end is a displacement increment of second
  /// order in h, whose volume the fragments of facets sweep; q: what leaves through sides with a
  /// given velocity, at the earlier times t_j of whose rates w r is made, w_j being the time for
  /// which each counts; g: length of the stage.
  template <int dim>
  class ClosedRegionVolumes
  {
  public:
    using Positions = typename FluidGeometry<dim>::Positions;
    using Vectors   = typename FluidGeometry<dim>::Velocities;

    /// For a stage of the step from `time` = t^n, at whose begin the nodes of all surfaces were at
    /// `before`. The references must outlive it. Collective.
    ClosedRegionVolumes(const Models<dim>          &models,
                        const FluidGeometry<dim>   &geometry,
                        const PressureNumbers<dim> &numbers,
                        const Stage                &stage,
                        double                      time,
                        Positions                   before);

    /// Are there closed regions?
    bool
    empty() const
    {
      return regions.size() == 0;
    }

    /// (C3) in every component, [FluidTopology::cells] [m^dim/s], for surfaces whose displacement
    /// increment in the stage is `increment` [m], given `fluxes` B u of all components. Collective.
    std::vector<double>
    missing_fluxes(const std::vector<double> &fluxes, const Vectors &increment) const;

  private:
    /// S from the begin of the stage to where the grid is cut. Cuts it where the surfaces were
    /// then, too.
    std::vector<double>
    gained_until_cut(const Models<dim> &models) const;

    /// Volume swept out of each region while the nodes go straight on from `from` by `increment`
    /// [m^dim].
    std::vector<double>
    swept(const Positions &from, const Vectors &increment) const;

    const Surface<dim>       &surface;
    const FluidGeometry<dim> &geometry;
    const ClosedRegions<dim>  regions;
    const double              length; ///< g [s]
    const Positions           before;
    std::vector<double>       areas;        ///< of bodies, around each component [m^(dim-1)]
    std::vector<double>       region_areas; ///< of each region
    std::vector<double>       earlier;      ///< sum_j w_j q(t_j) of each region [m^dim]
    std::vector<double>       gained;       ///< S up to where the grid is cut [m^dim]
  };
} // namespace undine

#endif
