// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fluid_patches.h>
#include <undine/output/solution_parts.h>

#include <fmt/format.h>

namespace undine
{
  template <int dim>
  std::vector<Patches<dim>>
  solution_parts(const Models<dim>  &models,
                 const State<dim>   &state,
                 const Configuration configuration)
  {
    std::vector<Patches<dim>> parts;
    if (models.solid)
      parts.push_back(body_patches(*models.solid, state.solid, configuration));
    if (models.fluid)
      parts.push_back(fluid_patches(*models.fluid, state.fluid, state.clock.time));
    return parts;
  }


  std::filesystem::path
  solution_file(const std::string &part, const Clock &clock, const std::string &extension)
  {
    return std::filesystem::path("solution") /
           fmt::format("{}_{:06d}.{}", part, clock.step, extension);
  }


  template std::vector<Patches<2>>
  solution_parts(const Models<2> &, const State<2> &, Configuration);
  template std::vector<Patches<3>>
  solution_parts(const Models<3> &, const State<3> &, Configuration);
} // namespace undine
