// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/body.h>

namespace undine
{
  namespace
  {
    template <int dim>
    std::vector<BodyBoundary<dim>>
    read_boundaries(const Options &section)
    {
      std::vector<BodyBoundary<dim>> result;
      for (const auto &name : section.named_sections("root"))
        section.section(name).attempt([&] { result.emplace_back(name, section.section(name)); });
      return result;
    }
  } // namespace


  template <int dim>
  Body<dim>::Body(const std::string &name, const Options &options)
    : name(name)
    , options(options)
    , shape(options.choose<BodyShape<dim>>("Shape", "box", "The shape at rest."))
    , has_map(options.given("Map"))
  {
    options.add("Map",
                map,
                "m",
                Allowed::constant_in_time(),
                "Where each vertex of the refined shape is at rest, as a function of where the "
                "shape has it; not given: there.");
    options.add("Refinements",
                refinements,
                "1",
                Allowed::between(0, 12),
                "How often each cell of the shape is split in two along every direction.");
    options.require("Density", density, "kg/m^3", Allowed::positive(), "Mass per volume at rest.");
    material =
      options.choose<Material>("Material", "neo-Hookean", "The law between strain and stress.");
    kinematics = choose_kinematics<dim>(options);
    options.add("Load", load, "N/m^3", Allowed::anything(), "Dead force per volume at rest.");
    options.add("Initial displacement",
                displacement,
                "m",
                Allowed::constant_in_time(),
                "At t = 0, of the point that rests at x.");
    options.add("Initial velocity",
                velocity,
                "m/s",
                Allowed::constant_in_time(),
                "At t = 0, of the point that rests at x.");
    boundaries = read_boundaries<dim>(options.section("Boundaries"));
  }


  template <int dim>
  std::vector<Body<dim>>
  read_bodies(const Options &bodies)
  {
    std::vector<Body<dim>> result;
    for (const auto &name : bodies.named_sections("beam"))
      bodies.section(name).attempt([&] { result.emplace_back(name, bodies.section(name)); });
    return result;
  }


  template struct Body<2>;
  template struct Body<3>;
  template std::vector<Body<2>>
  read_bodies(const Options &);
  template std::vector<Body<3>>
  read_bodies(const Options &);
} // namespace undine
