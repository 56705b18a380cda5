// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/scheme/particle_scheme.h>
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


  namespace
  {
    void
    refuse_one_way(const Options &coupling)
    {
      std::string direction = "two-way";
      if (coupling.given("Direction"))
        coupling.add("Direction", direction, "", Allowed::anything(), "");
      if (direction != "two-way")
        coupling.mistake(coupling.error("Direction",
                                        "is '" + direction +
                                          "', but fluid and bodies of particles always push each "
                                          "other: they have one pressure",
                                        "Allowed: two-way. Try: 'Obstacles' in place of bodies "
                                        "that the fluid shall not move."));
    }
  } // namespace


  void
  refuse_keys_of_other_schemes(const Options &scene)
  {
    refuse_one_way(scene.section("Coupling"));
    const std::string of_elements = "belongs to bodies of finite elements, not of particles";
    const auto        bodies      = scene.section("Bodies");
    for (const auto &name : bodies.named_sections("beam"))
      refuse(bodies.section(name),
             {{"Plane state", "Remove it: plane bodies of particles are in plane strain."},
              {"Load", "Remove it: particles know 'Effects / gravity' only."}},
             of_elements);
  }


  void
  refuse_keys_of_particles(const Options &scene)
  {
    const std::string no_surface = "makes a free surface, which is not computed on a grid: there "
                                   "the fluid fills all that bodies and obstacles leave of the "
                                   "domain";
    const std::string particles  = "Try: 'Scheme = particle', which computes it.";
    refuse(scene.section("Fluid"), {{"Region", particles}, {"Shapes", particles}}, no_surface);
    refuse(scene.section("Fluid"),
           {{"Bulk modulus", "Remove it, or try: 'Scheme = particle'."}},
           "makes the fluid compressible, which it is not on a grid");
    refuse(scene.section("Domain"),
           {{"Open sides",
             "Try: 'Scheme = particle', or a boundary of 'Fluid / Boundaries' of 'Kind = outflow' "
             "or 'pressure' through which the fluid goes on."}},
           "lets the fluid have a free surface with air beyond it, which is not computed on a "
           "grid");
    refuse(scene.section("Domain"),
           {{"Periodic sides", "Try: a boundary of 'Fluid / Boundaries' of 'Kind = periodic'."}},
           "belongs to particles");
  }


  namespace
  {
    /// Leaves keys and sections unread, and notes those that the scene gives.
    class Skipped
    {
    public:
      std::vector<std::string> notes;

      void
      skip(const Options &section, const std::string &key, const std::string &instead)
      {
        const std::string what       = "is not read by this scheme";
        const auto        subsection = section.section(key);
        if (section.given(key))
          notes.push_back(section.error(key, what, instead).what());
        else if (subsection.given())
          notes.push_back(subsection.error("", what, instead).what());
        section.leave_unjudged(key);
      }

      void
      skip_all(const Options                  &section,
               const std::vector<std::string> &keys,
               const std::string              &instead)
      {
        for (const auto &key : keys)
          skip(section, key, instead);
      }
    };


    void
    skip_numbers_of_particles(Skipped &skipped, const Options &scene)
    {
      const std::string of_particles = "It is for 'Scheme = particle'.";
      skipped.skip(scene, "Particles", of_particles);
      skipped.skip(scene.section("Domain"), "Room beyond open sides", of_particles);
      skipped.skip(scene.section("Output"), "Walls", of_particles);
      const auto bodies = scene.section("Bodies");
      for (const auto &name : bodies.named_sections("beam"))
        skipped.skip_all(bodies.section(name),
                         {"Hourglass stiffness", "Bond damping", "Bulk damping", "Contact modulus"},
                         of_particles);
    }


    /// How a grid carries momentum and scalars.
    void
    skip_forms(Skipped &skipped, const Options &effects)
    {
      const std::string instead = "Particles carry what they have with them.";
      skipped.skip_all(effects.section("convection"), {"Form", "Method"}, instead);
      const auto transport = effects.section("scalar transport");
      skipped.skip_all(transport, {"Form", "Method"}, instead);
      for (const auto &field : transport.named_sections("field"))
        skipped.skip(transport.section(field), "Neglected variation", instead);
    }


    void
    skip_numbers_of_grids(Skipped &skipped, const Options &scene)
    {
      const auto        time = scene.section("Time"), output = scene.section("Output");
      const std::string sub_steps = "A frame has as many sub-steps as it needs.";
      skipped.skip(scene, "Solid numerics", "Of particles: 'Particles / Sub-steps'.");
      skipped.skip(scene, "Coupling", "Of particles: 'Particles / Pressure'.");
      skipped.skip_all(
        time,
        {"Tolerance", "Least displacement", "Maximum cuts", "Energy monitor", "Fallback"},
        sub_steps);
      skipped.skip_all(time, {"Spectral radius", "Gamma", "Theta"}, sub_steps);
      skipped.skip_all(time, {"Steady within", "Steady for"}, "The run goes on to 'Time / End'.");
      if (!seeks_equilibrium(scene))
        skipped.skip(time, "Integrator", sub_steps);
      skipped.skip_all(output,
                       {"Budget", "Energy account"},
                       "'statistics' has the energies and the momentum of particles.");
      skipped.skip_all(output,
                       {"Impulses", "Stability of splitting"},
                       "It is for fluids on a grid and bodies of finite elements.");
      skipped.skip(
        scene.section("Fluid"), "Pressure solver", "Of particles: 'Particles / Pressure'.");
      skipped.skip_all(
        scene.section("Domain"),
        {"Cells", "Grading x", "Grading y", "Grading z", "Planes x", "Planes y", "Planes z"},
        "How fine particles are: 'Particles / Spacing'.");
      skip_forms(skipped, scene.section("Effects"));
    }
  } // namespace


  std::vector<std::string>
  skip_numbers_of_other_methods(const Options &scene, const bool has_particles)
  {
    Skipped skipped;
    if (has_particles)
      skip_numbers_of_grids(skipped, scene);
    else
      skip_numbers_of_particles(skipped, scene);
    return skipped.notes;
  }
} // namespace undine
