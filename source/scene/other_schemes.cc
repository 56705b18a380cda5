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
    const std::string of_elements = "belongs to bodies of finite elements, not of particles";
    refuse(scene.section("Output"),
           {{"Budget", "Remove it: 'statistics' has the energies and the momentum."},
            {"Energy account", "Remove it: 'statistics' has the energies."}},
           "belongs to other schemes than 'particle'");
    refuse(scene.section("Fluid"),
           {{"Void regions", "Remove it: where there are no particles, there is nothing."}},
           "belongs to a fluid on a grid, not to particles");
    const auto bodies = scene.section("Bodies");
    for (const auto &name : bodies.named_sections("beam"))
      refuse(bodies.section(name),
             {{"Plane state", "Remove it: plane bodies of particles are in plane strain."},
              {"Load", "Remove it: particles know 'Effects / gravity' only."}},
             of_elements);
  }


  std::vector<std::string>
  skip_numbers_of_other_methods(const Options &scene, const bool has_particles)
  {
    std::vector<std::string> notes;
    const auto               skip =
      [&](const Options &section, const std::string &key, const std::string &instead) {
        const std::string what       = "is not read by this scheme";
        const auto        subsection = section.section(key);
        if (section.given(key))
          notes.push_back(section.error(key, what, instead).what());
        else if (subsection.given())
          notes.push_back(subsection.error("", what, instead).what());
        section.leave_unjudged(key);
      };
    if (!has_particles)
      {
        skip(scene, "Particles", "It is for 'Scheme = particle'.");
        return notes;
      }
    skip(scene, "Solid numerics", "Of particles: 'Particles / Sub-steps'.");
    skip(scene, "Coupling", "Of particles: 'Particles / Pressure'.");
    skip(scene.section("Time"), "Maximum cuts", "A frame has as many sub-steps as it needs.");
    skip(scene.section("Fluid"), "Pressure solver", "Of particles: 'Particles / Pressure'.");
    for (const std::string key :
         {"Cells", "Grading x", "Grading y", "Grading z", "Planes x", "Planes y", "Planes z"})
      skip(scene.section("Domain"), key, "How fine particles are: 'Particles / Spacing'.");
    return notes;
  }
} // namespace undine
