// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/fluid_patches.h>
#include <undine/output/fields/solution_parts.h>
#include <undine/output/fields/surface_patches.h>

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
      parts.push_back(fluid_patches(models, state));
    return parts;
  }


  template <int dim>
  std::vector<Patches<dim - 1, dim>>
  surface_parts(const Models<dim> &models, const State<dim> &state)
  {
    std::vector<Patches<dim - 1, dim>> parts;
    if (!models.fluid || !models.surface || state.surface_positions.empty())
      return parts;
    if (models.surface->obstacles().surface().n_nodes() > 0)
      parts.push_back(obstacle_patches(models, state));
    parts.push_back(cut_surface_patches(models, state));
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
  template std::vector<Patches<1, 2>>
  surface_parts(const Models<2> &, const State<2> &);
  template std::vector<Patches<2, 3>>
  surface_parts(const Models<3> &, const State<3> &);
} // namespace undine
