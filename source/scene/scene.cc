// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/scene/other_schemes.h>
#include <undine/scene/scene.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    void
    read_title(const Options &options, std::string &title)
    {
      title = std::filesystem::path(options.file().name()).stem().string();
      options.add("Title", title, "", Allowed::anything(), "What the scene shows.");
    }


    Clock
    read_clock(const Options &options)
    {
      Clock      clock;
      const auto time = options.section("Time");
      time.require("End", clock.end_time, "s", Allowed::positive(), "Simulated time at the end.");
      time.add("Maximum steps",
               clock.maximum_steps,
               "",
               Allowed::positive(),
               "Stop after this many steps even if the end is not reached.");
      return clock;
    }


    /// Every effect is asked whether the rest of the scene lets it act.
    template <int dim>
    void
    check_effects(const Scene<dim> &scene, const Options &options)
    {
      typename Effect<dim>::Surroundings surroundings{
        scene.models.fluid.get(),
        scene.models.solid.get(),
        scene.models.surface != nullptr,
        {},
        {},
        scene.models.particles && scene.models.particles->has_fluid(),
        scene.models.particles && !scene.models.particles->body_names().empty()};
      for (const auto &effect : scene.models.effects)
        {
          surroundings.effects.push_back(effect->name);
          for (const auto &scalar : effect->scalars())
            surroundings.scalars.push_back(scalar);
        }
      for (const auto &effect : scene.models.effects)
        options.attempt(
          [&] { effect->check(options.section("Effects").section(effect->name), surroundings); });
    }


    /// What the boundaries of the fluid must fit: the effects and, at the start, each other.
    template <int dim>
    void
    check_boundaries(const Scene<dim> &scene, const Options &options)
    {
      const auto &model      = *scene.models.fluid;
      const auto  boundaries = options.section("Fluid").section("Boundaries");
      const auto  wall       = model.boundaries().wall_that_needs_viscosity();
      if (!wall.empty() && !scene.models.has_friction())
        throw boundaries.section(wall).error(
          "Kind",
          "fluid without viscosity does not stick to a wall",
          "Try: 'slip wall', or add a subsection 'viscosity' to 'Effects'.");
      if (scene.models.surface)
        return; // obstacles take part in the balance, which the projection checks
      auto velocity = model.initial_state().velocity;
      set_boundary_velocity(velocity, model.boundaries(), 0.);
      const auto complaint = net_flux_complaint(model.boundaries(), velocity);
      if (!complaint.empty())
        throw boundaries.error(
          "",
          complaint,
          "Try: make one boundary an 'outflow' or of the kind 'pressure', or balance the inflows.");
    }


    template <int dim>
    void
    read_outputs(Scene<dim> &scene, const Options &options)
    {
      const auto  section  = options.section("Output");
      const auto &registry = Registry<Output<dim>>::instance();

      std::string directory =
        "output/" + std::filesystem::path(options.file().name()).stem().string();
      section.add("Directory", directory, "", Allowed::anything(), "Folder for the results.");
      scene.directory = directory;
      section.add("Interval",
                  scene.clock.landing_interval,
                  "s",
                  Allowed::not_negative(),
                  "Simulated time between pictures; steps are shortened to land on its multiples. "
                  "0: only the first and the last time.");
      section.add("Report",
                  scene.has_report,
                  "",
                  Allowed::anything(),
                  "Write 'report.html' into the folder, a page about the run: at its end, and anew "
                  "at times of outputs, for which at most 2 % of the run's time is taken. The "
                  "environment variable UNDINE_REPORT=off overrides it.");
      std::vector<std::string> parts{"vtu", "checkpoint"};
      section.add("Parts",
                  parts,
                  "",
                  Allowed::one_of(registry.names()),
                  "What is written besides the file 'statistics', which always is.");
      if (options.is_reference())
        parts = registry.names();
      // First: checkpoints say which of its rows they belong to. They come last: a run that goes on
      // from one does not write again what belongs to the same time.
      parts.erase(std::remove(parts.begin(), parts.end(), "statistics"), parts.end());
      parts.insert(parts.begin(), "statistics");
      if (!options.is_reference())
        std::stable_partition(
          parts.begin(), parts.end(), [](const std::string &name) { return name != "checkpoint"; });
      for (const auto &name : parts)
        if (registry.contains(name))
          {
            scene.outputs.push_back(registry.make(name));
            scene.outputs.back()->add_options(section);
          }
    }


    template <int dim>
    void
    read_probes(Scene<dim> &scene, const Options &options)
    {
      const auto section = options.section("Probes");
      for (const auto &name : section.named_sections("probe"))
        {
          const auto probe      = section.section(name);
          const auto registered = Registry<Probe<dim>>::instance().joined_names();
          probe.attempt([&] {
            if (!options.is_reference() && !probe.given("Kind"))
              throw probe.error("Kind", "must be given", "Allowed: " + registered);
            scene.probes.push_back(probe.template choose<Probe<dim>>(
              "Kind", Registry<Probe<dim>>::instance().names().front(), "What is measured."));
          });
        }
    }


    /// Everything but the models, which cost time and memory.
    template <int dim>
    Scene<dim>
    read_without_models(const Options &options)
    {
      Scene<dim>   scene;
      unsigned int dimension = dim; // is the scene's: read_dimension() chose this instance
      read_title(options, scene.title);
      options.require("Dimension", dimension, "", Allowed::between(2, 3), "Of space.");
      std::string folder = options.file().folder().string();
      options.add(
        "Folder of files",
        folder,
        "",
        Allowed::anything(),
        "Where relative names of files, such as meshes, begin, itself seen from the scene's "
        "own folder; that folder if not given.");
      scene.clock  = read_clock(options);
      scene.scheme = options.choose<Scheme<dim>>("Scheme", "simultaneous", "How time advances.");
      scene.models.effects = read_effects<dim>(options.section("Effects"));
      read_outputs(scene, options);
      read_probes(scene, options);
      return scene;
    }


    /// Nothing but particles: their model reads fluid, bodies and obstacles itself.
    template <int dim>
    void
    make_particles(Scene<dim> &scene, const Options &options, const MPI_Comm communicator)
    {
      scene.models.particles =
        std::make_unique<const ParticleModel<dim>>(options, scene.models.effects, communicator);
    }


    /// A grid for the fluid and elements for the bodies.
    template <int dim>
    void
    make_grid_and_elements(Scene<dim> &scene, const Options &options, const MPI_Comm communicator)
    {
      if (options.section("Bodies").given())
        scene.models.solid = std::make_unique<const SolidModel<dim>>(options, communicator);
      if (options.section("Fluid").given())
        scene.models.fluid = std::make_unique<const FluidModel<dim>>(options, communicator);
      scene.models.direction   = read_direction(options);
      const bool has_obstacles = options.section("Obstacles").given();
      if (scene.models.fluid && (scene.models.solid || has_obstacles))
        {
          scene.models.surface = std::make_unique<const ImmersedSurface<dim>>(
            options, scene.models.solid.get(), scene.models.fluid->grid());
          const auto &fluid = *scene.models.fluid;
          auto        voids =
            std::make_unique<const VoidRegions<dim>>(options, fluid.grid(), fluid.boundaries());
          if (!voids->empty())
            scene.models.void_regions = std::move(voids);
        }
    }


    /// "Bodies/", "Fluid/Boundaries/", ...: the sections that a scene may have, but for the names
    /// that its author chooses.
    template <int dim>
    std::vector<std::string>
    all_sections()
    {
      const auto reference = Options::for_reference();
      declare_scene<dim>(reference);
      std::vector<std::string> sections;
      for (const auto &entry : reference.entries())
        sections.push_back(entry.section.substr(0, entry.section.find('<')));
      return sections;
    }
  } // namespace


  template <int dim>
  std::vector<std::string>
  check_sections(const Options &options)
  {
    const auto scene = read_without_models<dim>(options);
    const auto given = [&](const std::string &section) { return options.section(section).given(); };
    const auto attempt = [&](const auto &declare, const std::vector<std::string> &sections) {
      options.attempt([&] { declare(options); }, sections);
    };
    const auto refuse = [&](const std::string &section, const auto &...why) {
      options.mistake(options.error(section, why...));
      options.leave_unjudged(section);
    };
    if (!given("Bodies") && !given("Fluid"))
      options.mistake(options.error("",
                                    "the scene has neither a fluid nor a body",
                                    "Try: add a subsection 'Fluid' or a subsection 'Bodies'."));
    const bool has_particles = scene.scheme->method() == Scheme<dim>::Method::particles;
    auto       notes         = skip_numbers_of_other_methods(options, has_particles);
    if (has_particles)
      {
        refuse_keys_of_other_schemes(options);
        attempt(ParticleModel<dim>::declare,
                {"Particles", "Domain", "Fluid", "Bodies", "Obstacles", "Output"});
      }
    else
      {
        refuse_keys_of_particles(options);
        if (given("Bodies"))
          attempt(SolidModel<dim>::declare, {"Bodies", "Solid numerics"});
        if (given("Fluid"))
          {
            attempt(FluidModel<dim>::declare, {"Domain", "Fluid"});
            attempt(Obstacles<dim>::declare, {"Obstacles"});
            attempt(VoidRegions<dim>::declare, {"Fluid"});
          }
        else if (given("Obstacles"))
          refuse("Obstacles",
                 "obstacles stand in a fluid, but the scene has none",
                 "Try: add a subsection 'Fluid' or remove the obstacles.");
        options.attempt([&] { read_direction(options); }, {"Coupling"});
      }
    options.assert_all_used(all_sections<dim>());
    options.throw_mistakes();
    return notes;
  }


  unsigned int
  read_dimension(const Options &options)
  {
    unsigned int dimension = 2;
    options.require("Dimension", dimension, "", Allowed::between(2, 3), "Of space.");
    return dimension;
  }


  template <int dim>
  Scene<dim>
  read_scene(const Options &options, const MPI_Comm communicator)
  {
    check_sections<dim>(options);
    auto scene = read_without_models<dim>(options);
    if (scene.scheme->method() == Scheme<dim>::Method::particles)
      make_particles(scene, options, communicator);
    else
      make_grid_and_elements(scene, options, communicator);
    options.assert_all_used();
    check_effects(scene, options);
    if (scene.models.fluid)
      options.attempt([&] { check_boundaries(scene, options); });
    const auto probes      = options.section("Probes");
    const auto probe_names = probes.named_sections("probe");
    for (unsigned int p = 0; p < scene.probes.size(); ++p)
      options.attempt([&] {
        scene.probes[p]->start(probe_names[p], probes.section(probe_names[p]), scene.models);
      });
    options.throw_mistakes();
    return scene;
  }


  template <int dim>
  void
  declare_scene(const Options &options)
  {
    read_without_models<dim>(options);
    read_direction(options);
    SolidModel<dim>::declare(options);
    FluidModel<dim>::declare(options);
    Obstacles<dim>::declare(options);
    VoidRegions<dim>::declare(options);
  }


  template std::vector<std::string>
  check_sections<2>(const Options &);
  template std::vector<std::string>
  check_sections<3>(const Options &);
  template Scene<2>
  read_scene(const Options &, MPI_Comm);
  template Scene<3>
  read_scene(const Options &, MPI_Comm);
  template void
  declare_scene<2>(const Options &);
  template void
  declare_scene<3>(const Options &);
} // namespace undine
