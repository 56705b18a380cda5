// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/void_cubes.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  VoidCubes<dim>::VoidCubes(const Options &fluid)
    : options(fluid.section("Void regions"))
  {
    for (const auto &name : options.named_sections("air"))
      {
        const auto section = options.section(name);
        Region     region{name, {}};
        double     pressure = 0;
        section.require("Seed",
                        region.seed,
                        "m",
                        Allowed::anything(),
                        "A place of the room that is left empty at the start, as far as bodies, "
                        "obstacles and walls close it.");
        section.add("Pressure",
                    pressure,
                    "Pa",
                    Allowed::anything(),
                    "0: where there are no particles, there is no pressure.");
        if (pressure != 0)
          throw section.error("Pressure",
                              "is not zero, but where there are no particles, there is no pressure",
                              "Allowed: 0. Try: 'Scheme = simultaneous', which knows others.");
        regions.push_back(region);
      }
  }


  template <int dim>
  std::size_t
  VoidCubes<dim>::number(const dealii::Point<dim> &place) const
  {
    std::size_t result = 0, stride = 1;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto k =
          static_cast<std::size_t>((place[axis] - domain->lower[axis]) / domain->spacing);
        result += std::min<std::size_t>(k, domain->cells[axis] - 1) * stride;
        stride *= domain->cells[axis];
      }
    return result;
  }


  template <int dim>
  void
  VoidCubes<dim>::fill(const ParticleDomain<dim>                             &domain_,
                       const std::function<bool(const dealii::Point<dim> &)> &taken)
  {
    if (regions.empty())
      return;
    domain = &domain_;
    domain->for_each_cell([&](const dealii::Point<dim> &place) {
      cubes.push_back(taken(place) ? Cube::taken : Cube::open);
    });
    for (const auto &region : regions)
      flood(region);
    if (std::find(cubes.begin(), cubes.end(), Cube::open) == cubes.end())
      throw options.error("",
                          "take all that bodies, obstacles and walls leave of the domain; there is "
                          "no fluid left",
                          "Try: close the gap around them with bodies of two spacings or more.");
  }


  template <int dim>
  void
  VoidCubes<dim>::for_each_neighbour(const std::size_t                             cube,
                                     const std::function<void(const std::size_t)> &action) const
  {
    std::size_t rest = cube, stride = 1;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const std::size_t n = domain->cells[axis], k = rest % n, first = cube - k * stride;
        rest /= n;
        if (k > 0 || domain->periodic(axis))
          action(first + (k + n - 1) % n * stride);
        if (k < n - 1 || domain->periodic(axis))
          action(first + (k + 1) % n * stride);
        stride *= n;
      }
  }


  template <int dim>
  void
  VoidCubes<dim>::flood(const Region &region)
  {
    const auto section = options.section(region.name);
    if (!domain->contains(region.seed))
      throw section.error("Seed", "lies outside the domain", "Try: a place inside.");
    std::vector<std::size_t> found{number(region.seed)};
    if (cubes[found[0]] == Cube::taken)
      throw section.error("Seed",
                          "lies in a body, an obstacle or a wall, or closer to one than a spacing",
                          "Try: a place in the middle of the room that is to be empty.");
    if (cubes[found[0]] == Cube::empty)
      throw section.error("Seed",
                          "lies in the same room as that of another void region",
                          "Try: one void region, or close the gap between them.");
    cubes[found[0]] = Cube::empty;
    while (!found.empty())
      {
        const std::size_t cube = found.back();
        found.pop_back();
        for_each_neighbour(cube, [&](const std::size_t next) {
          if (cubes[next] != Cube::open)
            return;
          cubes[next] = Cube::empty;
          found.push_back(next);
        });
      }
  }


  template <int dim>
  bool
  VoidCubes<dim>::contain(const dealii::Point<dim> &place) const
  {
    return !cubes.empty() && cubes[number(place)] == Cube::empty;
  }


  template class VoidCubes<2>;
  template class VoidCubes<3>;
} // namespace undine
