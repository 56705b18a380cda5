// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/solid/mesh/solid_model.h>

#include <fmt/format.h>

namespace undine
{
  /// Bodies repel each other, themselves, walls and obstacles without friction, by a barrier that
  /// begins at a small distance (BodyContact), and never overlap.
  template <int dim>
  class ContactEffect : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      settings.emplace(ContactSettings<dim>{options});
      options.add(
        "Activation distance",
        settings->activation_distance,
        "m",
        Allowed::not_negative(),
        "Distance below which contact acts, by forces that grow without bound as surfaces "
        "approach each other. 0: a tenth of the size of the bodies' facets, where that is least.");
      options.add(
        "Stiffness",
        settings->stiffness,
        "Pa",
        Allowed::not_negative(),
        "Pressure at 0.53 of the activation distance. 0: the P-wave modulus of the softest body.");
      options.add("Domain walls",
                  settings->at_domain,
                  "",
                  Allowed::anything(),
                  "Bodies do not pass sides of the fluid's domain through which no fluid flows.");
      const auto walls = options.section("Walls");
      for (const auto &name : walls.named_sections("wall"))
        read_wall(name, walls.section(name));
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.solid)
        throw options.error("",
                            "contact acts on bodies, but the scene has none on a mesh",
                            "Remove the section or add a subsection to 'Bodies'. Particles need "
                            "no such section.");
      if (around.solid->numerics().newton.fixed_iterations > 0)
        throw options.error("",
                            "contact needs a converged Newton's method",
                            "Remove 'Solid numerics / Newton iterations'.");
    }

    std::pair<std::string, std::string>
    reason_not_for_particles() const override
    {
      return {"bodies of particles always keep off each other, walls and obstacles; "
              "the effect's own walls are of finite elements",
              "Remove the section; walls are those of 'Domain' and 'Obstacles', "
              "stiffness is 'Contact modulus' of a body."};
    }

    std::string
    summary() const override
    {
      const auto given = [](const double value, const std::string &unit) {
        return value > 0 ? fmt::format("{:.4g} {}", value, unit) : std::string("by the mesh");
      };
      if (!settings)
        return "";
      return fmt::format("without friction, activation distance {}, {} walls of the scene",
                         given(settings->activation_distance, "m"),
                         settings->walls.size());
    }

    typename Effect<dim>::Work
    work() const override
    {
      return {0, 0, true};
    }

    void
    affect(SolidEnvironment<dim> &environment) const override
    {
      environment.contact_settings = settings;
    }

  private:
    void
    read_wall(const std::string &name, const Options &options)
    {
      ContactWall<dim> wall;
      wall.name = name;
      options.require("Point", wall.point, "m", Allowed::anything(), "Of the plane.");
      options.require("Normal",
                      wall.normal,
                      "1",
                      Allowed::anything(),
                      "Of the plane, to the side where bodies are; of any length.");
      if (options.is_reference())
        return;
      if (!(wall.normal.norm() > 0))
        throw options.error("Normal", "has no direction", "Allowed: any vector but zero.");
      wall.normal /= wall.normal.norm();
      settings->walls.push_back(wall);
    }

    std::optional<ContactSettings<dim>> settings;
  };


  namespace
  {
    const RegisterForDimensions<Effect, ContactEffect>
      registered_contact("contact",
                         "Bodies touch walls, obstacles and each other without friction.");
  }
} // namespace undine
