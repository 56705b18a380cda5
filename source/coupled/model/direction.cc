// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/direction.h>

namespace undine
{
  Direction
  read_direction(const Options &scene)
  {
    const auto  section = scene.section("Coupling");
    std::string name    = "two-way";
    section.add("Direction",
                name,
                "",
                Allowed::one_of({"two-way", "fluid to body", "body to fluid"}),
                "Who feels whom. 'fluid to body': the fluid flows around the bodies as they were "
                "at the start, and loads them; 'body to fluid': the bodies move as if there were "
                "no fluid, which follows them. Both are solved one after the other.");
    if (name == "two-way")
      return Direction::two_way;
    if (!scene.section("Fluid").given() || !scene.section("Bodies").given())
      throw section.error("Direction",
                          "says who feels whom, but the scene has not both a fluid and bodies",
                          "Remove it, or add a subsection 'Fluid' or 'Bodies'.");
    for (const auto &entry : scene.entries())
      if (entry.section == "Coupling/" && entry.key != "Direction" && section.given(entry.key))
        throw section.error(entry.key,
                            "is a key of the coupling in both directions",
                            "Remove it, or set 'Direction = two-way'.");
    return name == "fluid to body" ? Direction::fluid_to_body : Direction::body_to_fluid;
  }
} // namespace undine
