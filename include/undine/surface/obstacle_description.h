// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_obstacle_description_h
#define undine_surface_obstacle_description_h

#include <undine/surface/shape_boundary.h>

#include <string>
#include <vector>

namespace undine
{
  /// The description of one obstacle in a scene, on grids and for particles.
  template <int dim>
  struct Obstacle
  {
    /// Read the keys of the section `name`. Throws InputError.
    Obstacle(const std::string &name, const Options &options)
      : description(name, options)
    {
      options.add("Displacement",
                  displacement,
                  "m",
                  Allowed::anything(),
                  "At time t, of the point that rests at x: a prescribed motion.");
    }

    ShapeDescription<dim> description;
    Expression<dim, dim>  displacement; ///< [m]
  };


  /// All that section 'Obstacles' names; throws InputError with section and key.
  template <int dim>
  std::vector<Obstacle<dim>>
  read_obstacles(const Options &scene)
  {
    const auto                 section = scene.section("Obstacles");
    std::vector<Obstacle<dim>> result;
    for (const auto &name : section.named_sections("pillar"))
      section.section(name).attempt([&] { result.emplace_back(name, section.section(name)); });
    return result;
  }
} // namespace undine

#endif
