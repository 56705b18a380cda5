// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/scene/other_schemes.h>

namespace undine
{
  namespace
  {
    struct Replacement
    {
      std::string key;  ///< or section
      std::string hint; ///< what to do instead
    };


    void
    refuse(const Options                  &options,
           const std::vector<Replacement> &replacements,
           const std::string              &what)
    {
      for (const auto &[key, hint] : replacements)
        if (options.given(key) || options.section(key).given())
          {
            options.mistake(options.error(key, what, hint));
            options.leave_unjudged(key);
          }
    }
  } // namespace


  void
  refuse_keys_of_other_schemes(const Options &scene)
  {
    const std::string of_grid     = "belongs to a fluid on a grid, not to particles";
    const std::string of_elements = "belongs to bodies of finite elements, not of particles";
    const std::string spacing     = "Remove it: 'Particles / Spacing' says how fine particles are.";

    refuse(scene,
           {{"Coupling", "Remove it: see 'Particles / Pressure'."}},
           "belongs to other schemes than 'particle'");
    refuse(scene, {{"Solid numerics", "Remove it: see 'Particles / Sub-steps'."}}, of_elements);
    refuse(scene.section("Time"),
           {{"Maximum cuts", "Remove it: a frame is made of as many sub-steps as it needs."}},
           "belongs to other schemes than 'particle'");
    refuse(scene.section("Output"),
           {{"Budget", "Remove it: 'statistics' has the energies and the momentum."},
            {"Energy account", "Remove it: 'statistics' has the energies."}},
           "belongs to other schemes than 'particle'");
    refuse(scene.section("Domain"),
           {{"Cells", spacing},
            {"Grading x", spacing},
            {"Grading y", spacing},
            {"Grading z", spacing},
            {"Planes x", spacing},
            {"Planes y", spacing},
            {"Planes z", spacing}},
           of_grid);
    refuse(scene.section("Fluid"),
           {{"Pressure solver", "Remove it: see 'Particles / Pressure'."},
            {"Void regions", "Remove it: where there are no particles, there is nothing."}},
           of_grid);
    const auto bodies = scene.section("Bodies");
    for (const auto &name : bodies.named_sections("beam"))
      refuse(bodies.section(name),
             {{"Material", "Remove it: bodies of particles are elastic, with large rotations."},
              {"Plane state", "Remove it: plane bodies of particles are in plane strain."},
              {"Load", "Remove it: particles know 'Effects / gravity' only."},
              {"Initial displacement", "Remove it: try 'Initial velocity'."}},
             of_elements);
  }
} // namespace undine
