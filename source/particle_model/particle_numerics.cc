// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_numerics.h>

#include <map>

namespace undine
{
  namespace
  {
    /// A key whose value is one of some words, each of which stands for a value of the variable.
    template <class Choice>
    void
    add_choice(const Options                       &options,
               const std::string                   &key,
               Choice                              &variable,
               const std::map<std::string, Choice> &choices,
               const std::string                   &help)
    {
      std::vector<std::string> words;
      std::string              word;
      for (const auto &choice : choices)
        {
          words.push_back(choice.first);
          if (choice.second == variable)
            word = choice.first;
        }
      options.add(key, word, "", Allowed::one_of(words), help);
      variable = choices.at(word);
    }
  } // namespace


  ParticleNumerics::ParticleNumerics(const Options &scene)
  {
    const auto options = scene.section("Particles");
    options.require(
      "Spacing",
      spacing,
      "m",
      Allowed::positive(),
      "Between particles at the start, l0; a particle stands for a cube of this edge.");
    options.add(
      "Reach",
      numerics.reach,
      "spacings",
      Allowed::between(1.5, 2.8),
      "Effective radius r_e of the weight r_e / r - 1: particles are neighbours within it.");
    read_machine(options);
    read_sub_steps(options.section("Sub-steps"));
    read_pressure(options.section("Pressure"));
    read_free_surface(options.section("Free surface"));
    read_order(options.section("Order"));
  }


  void
  ParticleNumerics::read_machine(const Options &options)
  {
    const auto &registry = Registry<particles::EngineFactory<2>>::instance();
    options.add(
      "Executor",
      executor,
      "",
      Allowed::one_of(registry.names()),
      "Where it is computed. host: this machine's cores. device: a graphics card, by CUDA.");
    options.add("Device",
                device,
                "",
                Allowed::between(0, 1023),
                "Number of the graphics card, from 0 on, where there are several.");
    if (!options.is_reference())
      {
        const auto reason = registry.make(executor)->reason_not_available(device);
        if (!reason.empty())
          throw options.error(
            "Executor", "'" + executor + "' is not possible here", "Reason: " + reason);
      }
    using particles::Precision;
    add_choice<Precision>(
      options,
      "Precision",
      precision,
      {{"single", Precision::single_precision}, {"double", Precision::double_precision}},
      "Of the particles' places and velocities and of the pressure equation.");
    unsigned int threads = numerics.threads;
    options.add("Threads",
                threads,
                "",
                Allowed::between(0, 4096),
                "Of the host; 0: as many as there are cores.");
    numerics.threads = threads;
  }


  void
  ParticleNumerics::read_sub_steps(const Options &options)
  {
    using particles::PositionUpdate;
    options.add("Largest",
                numerics.largest_sub_step,
                "s",
                Allowed::not_negative(),
                "No sub-step is longer. 0: as long as the step of the scene, Time / Step.");
    options.add("Speed share",
                numerics.speed_share,
                "1",
                Allowed::between(1e-3, 1),
                "Share of the spacing that the fastest particle may cross in a sub-step.");
    options.add(
      "Wave share",
      numerics.wave_share,
      "1",
      Allowed::between(1e-3, 10),
      "Sub-steps are at most this times l0 / sqrt(g H), H the fluid's depth at the start.");
    options.add("Carry share",
                numerics.carry_share,
                "1",
                Allowed::between(0, 1),
                "Share of a body's pressure that its elasticity takes over in a sub-step.");
    options.add("Elastic share",
                numerics.elastic_share,
                "1",
                Allowed::between(1e-3, 1),
                "Bodies are advanced in explicit steps of at most this times l0 / c_p, c_p the "
                "speed of their pressure waves.");
    unsigned int most = numerics.most_elastic_steps;
    options.add(
      "Implicit above",
      most,
      "",
      Allowed::between(0, 1e6),
      "If bodies need more explicit steps than this in a sub-step, they take one implicit "
      "step instead: faster for stiff bodies, and without their fast vibrations. 0: "
      "always explicit.");
    numerics.most_elastic_steps = most;
    add_choice<PositionUpdate>(
      options,
      "Position update",
      numerics.position_update,
      {{"end velocity", PositionUpdate::end_velocity},
       {"mean velocity", PositionUpdate::mean_velocity}},
      "With what velocity fluid goes through a sub-step. end velocity: that at its end, which "
      "dampens swinging. mean velocity: the mean of those at its start and end, with which waves "
      "and "
      "vortices go on; beside bodies first peaks of impacts are then higher and scatter more.");
  }


  void
  ParticleNumerics::read_pressure(const Options &options)
  {
    using particles::Coupling;
    using particles::PairForce;
    using particles::Source;
    add_choice<Source>(options,
                       "Source",
                       numerics.source,
                       {{"divergence", Source::divergence},
                        {"density", Source::density},
                        {"relaxed", Source::relaxed}},
                       "What the pressure corrects. divergence: that of the velocity, and a share "
                       "of the density's error. density: the whole error of the density. relaxed: "
                       "a share of it.");
    options.add(
      "Density share",
      numerics.density_share,
      "1",
      Allowed::between(0, 1),
      "Share of the density's error that a sub-step corrects (not with 'density', nor with "
      "gravity unless 'Relaxation time' is zero).");
    options.add(
      "Relaxation time",
      numerics.relaxation_time,
      "sqrt(l0 / g)",
      Allowed::not_negative(),
      "With gravity errors of the density fade in this time. 0: 'Density share' a sub-step.");
    options.add("Crowd excess",
                numerics.crowd_excess,
                "1",
                Allowed::not_negative(),
                "Particles crowd where their density is higher than the full one by more than this "
                "share; what is beyond is corrected faster.");
    options.add("Crowd share",
                numerics.crowd_share,
                "1",
                Allowed::between(0, 1),
                "Share of what is beyond 'Crowd excess' that a sub-step corrects.");
    add_choice<PairForce>(
      options,
      "Pair force",
      numerics.pair_force,
      {{"balanced", PairForce::balanced},
       {"corrected", PairForce::corrected},
       {"minimum", PairForce::minimum},
       {"conserving", PairForce::conserving}},
      "How pressures push. balanced: equal and opposite, and nothing where the "
      "pressure is constant. corrected: exact for linear pressures. minimum: "
      "every pair repels. conserving: equal and opposite, noisy in deep fluid.");
    add_choice<Coupling>(
      options,
      "Coupling",
      numerics.coupling,
      {{"simultaneous", Coupling::simultaneous}, {"surface pressure", Coupling::surface_pressure}},
      "How bodies take part in the pressure equation. simultaneous: as fluid of "
      "another density. surface pressure: only by the pressure of their "
      "elasticity at their surface, for comparisons.");
    read_solver(options);
  }


  void
  ParticleNumerics::read_solver(const Options &options)
  {
    using Preconditioner = particles::Numerics::Preconditioner;
    options.add("Tolerance",
                numerics.tolerance,
                "1",
                Allowed::between(1e-12, 1e-1),
                "The solver stops at this part of the residual.");
    options.add("Faces tolerance",
                numerics.faces_tolerance,
                "1",
                Allowed::between(1e-12, 1e-1),
                "The same for the faces between particles that the balanced pair force needs; at "
                "most 0.001 in a full domain with openings or obstacles that move.");
    unsigned int iterations = numerics.max_iterations;
    options.add("Maximum iterations",
                iterations,
                "",
                Allowed::between(1, 1e6),
                "Of conjugate gradients in a sub-step.");
    numerics.max_iterations = iterations;
    add_choice<Preconditioner>(options,
                               "Preconditioner",
                               numerics.preconditioner,
                               {{"automatic", Preconditioner::automatic},
                                {"Jacobi", Preconditioner::jacobi},
                                {"multigrid", Preconditioner::multigrid}},
                               "Of conjugate gradients; automatic: the faster one for the number "
                               "of particles.");
  }


  void
  ParticleNumerics::read_free_surface(const Options &options)
  {
    options.add(
      "Density",
      numerics.surface_density,
      "1",
      Allowed::between(0, 1),
      "Particles with less than this share of the full number density are at the surface.");
    options.add(
      "Body surface density",
      numerics.body_surface_density,
      "1",
      Allowed::between(0, 1),
      "The same for the particles of bodies; flat faces of bodies in air have 0.68 (2D) or "
      "0.73 (3D).");
    options.add("One-sided density",
                numerics.one_sided_density,
                "1",
                Allowed::between(0, 1.5),
                "So are those with less than this share whose neighbours are on one side of them.");
    options.add("One-sidedness",
                numerics.surface_one_sidedness,
                "1",
                Allowed::between(0, 1),
                "What counts as one side: length of the weights' vector sum as share of the full "
                "number density.");
    options.add(
      "Fade",
      numerics.surface_fade,
      "1",
      Allowed::positive(),
      "Being at the surface begins by so much above these three limits and is complete by "
      "so much beyond them.");
    options.add("Air",
                numerics.air,
                "1",
                Allowed::not_negative(),
                "Weight with which neighbours that particles at the surface lack hold the pressure "
                "of the air, zero. 0: their pressure is zero.");
  }


  void
  ParticleNumerics::read_order(const Options &options)
  {
    options.add("Collision distance",
                numerics.collision_distance,
                "spacings",
                Allowed::between(0, 1),
                "Particles that are closer and approach each other collide.");
    options.add("Restitution",
                numerics.restitution,
                "1",
                Allowed::between(0, 1),
                "Speed after a collision over that before.");
    options.add("Shifting",
                numerics.shifting,
                "1",
                Allowed::between(0, 1),
                "Strength with which particles are moved to where there are fewer; 0: not.");
    options.add("Shifting limit",
                numerics.shifting_limit,
                "spacings",
                Allowed::between(0, 0.5),
                "Longest such way in a sub-step.");
  }
} // namespace undine
