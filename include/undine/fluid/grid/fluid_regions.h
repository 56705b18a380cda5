// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_fluid_regions_h
#define undine_fluid_grid_fluid_regions_h

#include <undine/fluid/grid/pressure_numbers.h>

#include <vector>

namespace undine
{
  /// The connected regions of the fluid: cells and components between which one can go through open
  /// faces. Numbered by their lowest pressure number.
  template <int dim>
  class FluidRegions
  {
  public:
    /// Collective.
    FluidRegions(const MacGrid<dim> &grid, const PressureNumbers<dim> &numbers);

    /// Number of regions, the same on all ranks.
    unsigned int
    size() const
    {
      return first_numbers.size();
    }

    /// The region of each pressure of this rank, in the order of PressureNumbers.
    const std::vector<unsigned int> &
    of_pressures() const
    {
      return regions;
    }

    /// The lowest pressure number of each region.
    const std::vector<typename PressureNumbers<dim>::Number> &
    lowest_numbers() const
    {
      return first_numbers;
    }

  private:
    std::vector<unsigned int>                          regions;
    std::vector<typename PressureNumbers<dim>::Number> first_numbers;
  };


  /// Call `action(below, above)` for the pressures (PressurePlace) on both sides of every open face
  /// between cells, whole or piece, with one side or both on this rank.
  template <int dim, class Action>
  void
  for_each_connection(const MacGrid<dim> &grid, const FluidTopology<dim> *open, Action &&action)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        // Those above the last cells belong to the next rank.
        auto faces = grid.cells()->owned();
        faces.upper[axis] += 1;
        for_each(faces, [&](const GridIndex<dim> &face) {
          if (!grid.at_boundary(axis, face) &&
              (!open || open->faces[axis].kind(face) == SubLattice<dim>::Kind::whole))
            action(PressurePlace<dim>{moved<dim>(face, axis, -1), -1},
                   PressurePlace<dim>{face, -1});
        });
        for (std::size_t k = 0; open && k < open->pieces[axis].size(); ++k)
          {
            const auto &ends = open->pieces[axis][k].components;
            if (ends[0] != FluidTopology<dim>::outside && ends[1] != FluidTopology<dim>::outside)
              action(end_of_piece(*open, axis, k, 0), end_of_piece(*open, axis, k, 1));
          }
      }
  }
} // namespace undine

#endif
