// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_solution_parts_h
#define undine_output_fields_solution_parts_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/fields/body_patches.h>
#include <undine/output/fields/patches.h>

#include <filesystem>
#include <string>
#include <vector>

namespace undine
{
  /// Functions that all formats of pictures use. @{

  /// The parts that the scene has: bodies, then fluid. Collective.
  template <int dim>
  std::vector<Patches<dim>>
  solution_parts(const Models<dim> &models,
                 const State<dim>  &state,
                 Configuration      configuration = Configuration::rest);

  /// The surfaces in the fluid, if there are any: of obstacles, and as cells cut them. Collective.
  template <int dim>
  std::vector<Patches<dim - 1, dim>>
  surface_parts(const Models<dim> &models, const State<dim> &state);

  /// "solution/fluid_000120.vtu", within the folder of the run.
  std::filesystem::path
  solution_file(const std::string &part, const Clock &clock, const std::string &extension);
  /// @}
} // namespace undine

#endif
