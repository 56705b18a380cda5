// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/point_text.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/operators/pressure_place_at.h>
#include <undine/operators/void_regions.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace undine
{
  namespace
  {
  } // namespace


  template <int dim>
  std::vector<typename VoidRegions<dim>::Region>
  VoidRegions<dim>::read(const Options &scene)
  {
    const auto          section = scene.section("Fluid").section("Void regions");
    std::vector<Region> result;
    for (const auto &name : section.named_sections("air"))
      {
        Region     region;
        const auto options = section.section(name);
        region.name        = name;
        options.require("Seed",
                        region.seed,
                        "m",
                        Allowed::anything(),
                        "A place that always lies in the void region, not in a body.");
        options.add("Pressure",
                    region.pressure,
                    "Pa",
                    Allowed::anything(),
                    "What acts on the bodies there; taken at the seed.");
        result.push_back(region);
      }
    return result;
  }


  template <int dim>
  void
  VoidRegions<dim>::declare(const Options &scene)
  {
    read(scene);
  }


  template <int dim>
  VoidRegions<dim>::VoidRegions(const Options          &scene,
                                const MacGrid<dim>     &grid,
                                const BoundaryMap<dim> &boundaries)
    : grid(grid)
    , boundaries(boundaries)
    , regions(read(scene))
  {
    for (const auto &region : regions)
      for (unsigned int d = 0; d < dim; ++d)
        if (!(region.seed[d] > grid.lower()[d] && region.seed[d] < grid.upper()[d]))
          throw scene.section("Fluid")
            .section("Void regions")
            .section(region.name)
            .error("Seed", "lies outside the domain", "Try: a place inside.");
  }


  /// Where the pressure of a seed's region would sit, if this rank owns the seed's cell.
  template <int dim>
  PressurePlace<dim>
  VoidRegions<dim>::place_of_seed(const Region             &region,
                                  const FluidTopology<dim> &open,
                                  const Obstruction<dim>   &obstruction) const
  {
    try
      {
        return pressure_place_at(region.seed, grid, &open, &obstruction);
      }
    catch (const SolveError &error)
      {
        throw SolveError(fmt::format("The seed of the void region '{}' at {} {}. Try: a seed "
                                     "farther away from the bodies, or a smaller time step.",
                                     region.name,
                                     text_of(region.seed),
                                     error.what()));
      }
  }


  /// For each region of the fluid the number of its void region, or VoidMask::fluid.
  template <int dim>
  std::vector<int>
  VoidRegions<dim>::void_of_each_region(const FluidRegions<dim>    &fluid_regions,
                                        const PressureNumbers<dim> &numbers,
                                        const Obstruction<dim>     &obstruction) const
  {
    std::vector<int> result(fluid_regions.size(), VoidMask::fluid);
    std::vector<int> others(fluid_regions.size(), -static_cast<int>(regions.size()));
    std::string      complaint;
    for (unsigned int r = 0; r < regions.size(); ++r)
      if (complaint.empty() && grid.cells()->owned().contains(grid.cell_at(regions[r].seed)))
        try
          {
            const auto seed  = place_of_seed(regions[r], *numbers.topology(), obstruction);
            const auto local = numbers.owned().index_within_set(numbers.of(seed));
            const auto k     = fluid_regions.of_pressures()[local];
            result[k]        = std::max(result[k], static_cast<int>(r));
            others[k]        = std::max(others[k], -static_cast<int>(r));
          }
        catch (const SolveError &error)
          {
            complaint = error.what();
          }
    throw_together(complaint, grid.communicator());
    dealii::Utilities::MPI::max(result, grid.communicator(), result);
    dealii::Utilities::MPI::max(others, grid.communicator(), others);
    for (std::size_t k = 0; k < result.size(); ++k)
      if (result[k] >= 0 && result[k] != -others[k])
        throw SolveError(fmt::format("The void regions '{}' and '{}' join each other. Try: one "
                                     "void region, or close the gap in the bodies between them.",
                                     regions[-others[k]].name,
                                     regions[result[k]].name));
    if (!result.empty() && *std::min_element(result.begin(), result.end()) >= 0)
      throw SolveError(
        fmt::format("The void region '{}' takes all that bodies leave of the domain; "
                    "there is no fluid left. Try: close the gap in the bodies around it; those "
                    "that end in a side of the domain have none if they reach through it.",
                    regions[result.front()].name));
    return result;
  }


  /// `marks`: the number of the void region of each pressure, or VoidMask::fluid.
  template <int dim>
  void
  VoidRegions<dim>::check_boundaries(const Field<dim> &marks) const
  {
    const auto &open = *marks.topology();
    std::string complaint;
    const auto  check =
      [&](const unsigned int axis, const GridIndex<dim> &face, const auto &inside) {
        const int   number   = static_cast<int>(value_at(marks, inside));
        const auto &boundary = boundaries.at({axis, face[axis] > 0 ? 1u : 0u}, inside.cell);
        if (number >= 0 && boundary.lets_fluid_pass())
          complaint = fmt::format("The void region '{}' joins the boundary '{}' of the fluid. Try: "
                                  "close the gap in the bodies around it, or make that part of the "
                                  "boundary a wall.",
                                  regions[number].name,
                                  boundary.name);
      };
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto inside = [&](const GridIndex<dim> &face) {
          return face[axis] > 0 ? moved<dim>(face, axis, -1) : face;
        };
        for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
          if (grid.at_boundary(axis, face) &&
              open.faces[axis].kind(face) == SubLattice<dim>::Kind::whole)
            check(axis, face, PressurePlace<dim>{inside(face), -1});
        });
        for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
          if (const auto &face = open.faces[axis].all()[k].index;
              open.faces[axis].owns(k) && grid.at_boundary(axis, face))
            check(axis,
                  face,
                  PressurePlace<dim>{inside(face),
                                     open.pieces[axis][k].components[face[axis] > 0 ? 0 : 1]});
      }
    throw_together(complaint, grid.communicator());
  }


  template <int dim>
  void
  VoidRegions<dim>::check_last(const VoidMask      &voids,
                               const VoidMask      &last,
                               const CutCells<dim> &cut) const
  {
    std::string complaint;
    for_each(cut.block.cells(), [&](const GridIndex<dim> &cell) {
      const auto position = cut.block.cells().position(cell);
      if (voids.cells[position] >= 0 && !last.cells.empty() &&
          last.cells[position] == VoidMask::fluid)
        complaint = fmt::format("The void region '{}' has joined the fluid, which has been at {}. "
                                "Try: close the gap in the bodies around it.",
                                regions[voids.cells[position]].name,
                                text_of(grid.cells()->point(cell)));
    });
    throw_together(complaint, grid.communicator());
  }


  template <int dim>
  VoidMask
  VoidRegions<dim>::find(const CutCells<dim>    &cut,
                         const CutTopology<dim> &all,
                         const Obstruction<dim> &obstruction,
                         const VoidMask         &last) const
  {
    VoidMask result;
    if (empty())
      return result;
    const PressureNumbers<dim> numbers(grid, all.open);
    const FluidRegions<dim>    fluid_regions(grid, numbers);
    const auto                 voids = void_of_each_region(fluid_regions, numbers, obstruction);

    Field<dim>  marks(grid.cells(), all.open);
    std::size_t next = 0;
    for_each_value(marks, [&](double &mark, const auto &, const auto &) {
      mark = voids[fluid_regions.of_pressures()[next++]];
    });
    marks.exchange(1);
    check_boundaries(marks);

    result.components.assign(cut.components.size(), VoidMask::fluid);
    for (std::size_t c = 0; c < cut.components.size(); ++c)
      if (all.open_components[c] >= 0)
        result.components[c] = static_cast<int>(marks.parts()[all.open_components[c]]);
    const auto &block = cut.block.cells();
    result.cells.assign(block.size(), VoidMask::not_whole);
    for_each(block, [&](const GridIndex<dim> &cell) {
      if (all.open->cells.kind(cell) == SubLattice<dim>::Kind::whole)
        result.cells[block.position(cell)] = static_cast<int>(marks(cell));
    });
    check_last(result, last, cut);
    return result;
  }


  template <int dim>
  std::vector<double>
  VoidRegions<dim>::pressures(const VoidMask &voids, const double time) const
  {
    std::vector<double> of_regions;
    for (const auto &region : regions)
      of_regions.push_back(region.pressure.value(region.seed, time));
    std::vector<double> result(voids.components.size(), 0.);
    for (std::size_t c = 0; c < result.size(); ++c)
      if (voids.components[c] >= 0)
        result[c] = of_regions[voids.components[c]];
    return result;
  }


  template class VoidRegions<2>;
  template class VoidRegions<3>;
} // namespace undine
