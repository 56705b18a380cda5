// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_void_regions_h
#define undine_operators_void_regions_h

#include <undine/base/options/options.h>
#include <undine/fluid/boundary/boundary_map.h>
#include <undine/fluid/grid/fluid_regions.h>
#include <undine/fluid/visibility/obstruction.h>
#include <undine/operators/cut_topology.h>

#include <string>
#include <vector>

namespace undine
{
  /// Parts of space outside all bodies that hold no fluid, such as the air behind a plate: their
  /// pressure is given and acts on the bodies, nothing flows. A scene declares them in subsections
  /// of `Fluid/Void regions` by a place in each, the seed; a void region is what one can reach from
  /// there without crossing a body.
  ///
  /// They are found anew for every position of the bodies:
  ///
  ///     const auto all   = make_cut_topology(grid, cut);
  ///     const auto voids = void_regions.find(cut, all, obstruction, last_voids);
  ///     const auto parts = make_cut_topology(grid, cut, voids);
  template <int dim>
  class VoidRegions
  {
  public:
    /// Declare the keys without building anything.
    static void
    declare(const Options &scene);

    /// The references must outlive it. Throws InputError if a seed lies outside the domain.
    VoidRegions(const Options &scene, const MacGrid<dim> &grid, const BoundaryMap<dim> &boundaries);

    /// True if the scene has none.
    bool
    empty() const
    {
      return regions.empty();
    }

    /// The void regions, given the topology `all` that the surfaces of bodies and obstacles leave
    /// of the grid. `last` is the mask before the bodies moved, empty at the start. Throws
    /// SolveError, naming the region, if the seed lies in a body or too near to one, if two regions
    /// join each other, or if the region is connected with fluid: if it has an inflow or an
    /// opening, holds cells that held fluid, or leaves no fluid at all. Collective.
    VoidMask
    find(const CutCells<dim>    &cut,
         const CutTopology<dim> &all,
         const Obstruction<dim> &obstruction,
         const VoidMask         &last) const;

    /// For each of CutCells::components the pressure of the void region that it belongs to at
    /// `time` [s], [Pa]; zero if it is fluid. It is the whole pressure, not the reduced one, so
    /// that there are no gravity_loads() there.
    std::vector<double>
    pressures(const VoidMask &voids, const double time) const;

  private:
    struct Region
    {
      std::string        name;
      dealii::Point<dim> seed;
      Expression<dim>    pressure; ///< [Pa]
    };

    static std::vector<Region>
    read(const Options &scene);

    PressurePlace<dim>
    place_of_seed(const Region             &region,
                  const FluidTopology<dim> &open,
                  const Obstruction<dim>   &obstruction) const;

    std::vector<int>
    void_of_each_region(const FluidRegions<dim>    &fluid_regions,
                        const PressureNumbers<dim> &numbers,
                        const Obstruction<dim>     &obstruction) const;

    void
    check_boundaries(const Field<dim> &marks) const;

    void
    check_last(const VoidMask &voids, const VoidMask &last, const CutCells<dim> &cut) const;

    const MacGrid<dim>       &grid;
    const BoundaryMap<dim>   &boundaries;
    const std::vector<Region> regions;
  };
} // namespace undine

#endif
