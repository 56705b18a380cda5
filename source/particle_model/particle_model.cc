// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/fluid_parts.h>
#include <undine/particle_model/particle_model.h>
#include <undine/particle_model/plain_vector.h>
#include <undine/particle_model/void_cubes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double inside = 0.25; // deeper in another body is on it [spacings]


    const Options &
    only_one_rank(const Options &scene, const MPI_Comm communicator)
    {
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      if (n_ranks > 1 && !scene.is_reference())
        throw scene.error(
          "Scheme",
          fmt::format("particles are computed by one rank, but {} were started", n_ranks),
          "Try: start it without mpirun; it uses all cores by threads, see "
          "'Particles / Threads'.");
      return scene;
    }


    bool
    read_shows_walls(const Options &scene)
    {
      bool result = false;
      scene.section("Output").add("Walls",
                                  result,
                                  "",
                                  Allowed::anything(),
                                  "Whether pictures contain the particles of walls.");
      return result;
    }


    /// Is what is clamped so deep in walls that nothing there sees it? It is left out.
    template <int dim>
    bool
    is_buried(const ParticleBody<dim> &body, const std::size_t k, const ParticleDomain<dim> &box)
    {
      return body.is_fixed(k) && box.distance_outside(body.starts[k]) > box.layers * box.spacing;
    }


    template <int dim>
    void
    check_is_seen(const ParticleBody<dim> &body, const ParticleDomain<dim> &box)
    {
      for (std::size_t k = 0; k < body.places.size(); ++k)
        if (!is_buried(body, k, box))
          return;
      throw body.options.error("",
                               "the body is outside the domain at (" +
                                 write_value(body.places.front()) + ")",
                               "Try: a larger domain; what is clamped may reach into walls, but "
                               "something must be within " +
                                 write_value(box.layers * box.spacing) + " m of the domain.");
    }


    template <int dim>
    void
    check_place(const ParticleBody<dim>      &body,
                const std::size_t             k,
                const ParticleDomain<dim>    &box,
                const ParticleObstacles<dim> &obstacles)
    {
      const auto place = "(" + write_value(body.starts[k]) + ")";
      if (!body.is_fixed(k) && box.distance_outside(body.starts[k]) > 0)
        throw body.options.error(
          "",
          "the body is outside the domain at " + place,
          "Try: a larger domain; only what is clamped may reach into walls.");
      if (!body.is_fixed(k) && obstacles.contain(body.starts[k]))
        throw body.options.error(
          "",
          "the body is in an obstacle at " + place,
          "Try: move one of them; only what is clamped may be in obstacles.");
    }


    template <int dim>
    std::string
    volume_remark(const ParticleBody<dim> &body, const double spacing)
    {
      const double particles = body.places.size() * std::pow(spacing, dim);
      if (std::abs(particles / body.volume - 1) < 0.02)
        return "";
      return fmt::format("body '{}' has a volume of {:.4g} m^{}, its {} particles have {:.1f} % of "
                         "it; lengths that are whole numbers of spacings fit exactly",
                         body.name,
                         body.volume,
                         dim,
                         body.places.size(),
                         100 * particles / body.volume);
    }
  } // namespace


  template <int dim>
  ParticleModel<dim>::ParticleModel(const Options      &scene,
                                    const Effects<dim> &effects,
                                    const MPI_Comm      communicator)
    : ranks(communicator)
    , particle_numerics(only_one_rank(scene, communicator))
    , box(scene, particle_numerics.spacing, particle_numerics.numerics.reach)
    , walls_are_shown(read_shows_walls(scene))
    , occupied(particle_numerics.spacing)
  {
    auto                              bodies = read_particle_bodies<dim>(scene);
    std::optional<ParticleFluid<dim>> fluid;
    if (scene.section("Fluid").given())
      fluid.emplace(scene);
    if (fluid && fluid->may_have_surface())
      open_to_air(fluid->openings, box);
    auto obstacles = read_particle_obstacles(scene, box);
    moving         = std::move(obstacles.moving);

    constants.spacing  = box.spacing;
    constants.lower    = plain<dim>(box.outermost_lower());
    constants.upper    = plain<dim>(box.outermost_upper());
    constants.numerics = particle_numerics.numerics;
    for (unsigned int axis = 0; axis < dim; ++axis)
      constants.periodic[axis] = box.periodic(axis);
    constants.has_fluid = fluid.has_value();
    if (fluid)
      {
        constants.fluid_density      = fluid->density;
        constants.fluid_bulk_modulus = fluid->bulk_modulus;
        if (fluid->bulk_modulus > 0 && constants.numerics.source != particles::Source::divergence)
          throw scene.section("Fluid").error(
            "Bulk modulus",
            "needs 'Particles/Pressure/Source = divergence': other sources take what a fluid is "
            "compressed by for an error",
            "Remove one of the keys.");
      }
    apply(effects, scene);

    place_bodies(bodies, obstacles);
    add_moving_walls(bodies);
    auto                            walls = box.wall_particles();
    std::vector<LayerParticle<dim>> layers;
    if (fluid)
      layers = open_walls(walls, fluid->openings, box);
    place_walls(walls, bodies, obstacles);
    if (fluid)
      add_fluid(*fluid, layers, obstacles);
    add_walls(walls);
    surfaces = std::move(obstacles.surfaces);
  }


  template <int dim>
  void
  ParticleModel<dim>::declare(const Options &scene)
  {
    std::optional<ParticleNumerics> numerics;
    scene.attempt([&] { numerics.emplace(scene); }, {"Particles"});
    if (numerics && numerics->spacing > 0) // else a mistake has been noted
      scene.attempt(
        [&] { ParticleDomain<dim>(scene, numerics->spacing, numerics->numerics.reach); },
        {"Domain"});
    else
      scene.leave_unjudged("Domain");
    read_shows_walls(scene);
    read_particle_bodies<dim>(scene);
    if (scene.is_reference() || scene.section("Fluid").given())
      {
        scene.attempt([&] { ParticleFluid<dim>{scene}; }, {"Fluid"});
        scene.attempt([&] { VoidCubes<dim>{scene.section("Fluid")}; }, {"Fluid"});
      }
    declare_particle_obstacles<dim>(scene);
  }


  template <int dim>
  void
  ParticleModel<dim>::apply(const Effects<dim> &effects, const Options &scene)
  {
    for (const auto &effect : effects)
      if (!effect->affect_particles(constants))
        {
          const auto [reason, hint] = effect->reason_not_for_particles();
          throw scene.section("Effects").section(effect->name).error("", reason, hint);
        }
  }


  template <int dim>
  void
  ParticleModel<dim>::place_bodies(std::vector<ParticleBody<dim>> &bodies,
                                   const ParticleObstacles<dim>   &obstacles)
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        auto &body = bodies[b];
        body.fill(box.spacing);
        check_is_seen(body, box);
        for (std::size_t k = 0; k < body.places.size(); ++k)
          {
            if (is_buried(body, k, box))
              continue;
            const auto &place = body.starts[k];
            check_place(body, k, box, obstacles);
            occupied.for_each_near(place, overlap * box.spacing, [&](const std::size_t other) {
              throw body.options.error("",
                                       "the body lies on the body '" +
                                         names[constants.body_of[other]] + "' at (" +
                                         write_value(place) + ")",
                                       "Try: move them apart.");
            });
            for (unsigned int other = 0; other < b; ++other)
              if (bodies[other].surface->box().point_inside(place) &&
                  bodies[other].surface->nearest(place).distance < -inside * box.spacing)
                throw body.options.error("",
                                         "the body is in the body '" + names[other] + "' at (" +
                                           write_value(place) + ")",
                                         "Try: move them apart.");
          }
        add_body(body);
      }
  }


  template <int dim>
  void
  ParticleModel<dim>::add_body(const ParticleBody<dim> &body)
  {
    const int number = names.size();
    names.push_back(body.name);
    constants.bodies.push_back(body.setup);
    for (std::size_t k = 0; k < body.places.size(); ++k)
      {
        if (is_buried(body, k, box))
          continue;
        occupied.add(body.starts[k]);
        constants.reference.push_back(plain<dim>(body.places[k]));
        constants.body_of.push_back(number);
        constants.clamped.push_back(body.clamped[k]);
        add(body.starts[k],
            body.velocities[k],
            particles::Tag::of(particles::Kind::solid, number + 1));
      }
    const auto remark = volume_remark(body, box.spacing);
    if (!remark.empty())
      remarks.push_back(remark);
  }


  template <int dim>
  void
  ParticleModel<dim>::add_moving_walls(const std::vector<ParticleBody<dim>> &bodies)
  {
    using particles::Kind;
    for (const auto &obstacle : moving)
      for (const auto &wall : obstacle.at_start())
        {
          occupied.for_each_near(wall.place, overlap * box.spacing, [&](const std::size_t k) {
            throw bodies[constants.body_of[k]].options.error(
              "",
              "the body reaches into an obstacle that moves at (" + write_value(occupied[k]) + ")",
              "Try: move it away by a spacing.");
          });
          add(wall.place,
              dealii::Tensor<1, dim>(),
              particles::Tag::of(wall.layer == 0 ? Kind::wall : Kind::dummy,
                                 particles::moving_material));
          ++constants.n_moving;
        }
  }


  template <int dim>
  void
  ParticleModel<dim>::place_walls(std::vector<WallParticle<dim>>       &walls,
                                  const std::vector<ParticleBody<dim>> &bodies,
                                  const ParticleObstacles<dim>         &obstacles)
  {
    walls.insert(walls.end(), obstacles.particles.begin(), obstacles.particles.end());
    std::vector<WallParticle<dim>> result;
    for (const auto &wall : walls)
      {
        bool room = true; // what is clamped in a wall takes its place
        occupied.for_each_near(wall.place, apart * box.spacing, [&](const std::size_t k) {
          room = room && constants.clamped[k] != particles::all_directions<dim>;
        });
        if (!room)
          continue;
        result.push_back(wall);
        occupied.for_each_near(wall.place, overlap * box.spacing, [&](const std::size_t k) {
          const auto &body = bodies[constants.body_of[k]];
          throw body.options.error(
            "",
            "the body reaches into a wall at (" + write_value(occupied[k]) + ")",
            "Try: move it away by a spacing, or hold it there in all directions.");
        });
      }
    for (const auto &wall : result)
      occupied.add(wall.place);
    for (const auto &obstacle : moving)
      for (const auto &wall : obstacle.at_start())
        occupied.add(wall.place);
    walls = std::move(result);
  }


  template <int dim>
  void
  ParticleModel<dim>::add_walls(const std::vector<WallParticle<dim>> &walls)
  {
    using particles::Kind;
    n_wall = walls.size();
    for (const auto &wall : walls)
      add(wall.place,
          dealii::Tensor<1, dim>(),
          particles::Tag::of(wall.layer == 0 ? Kind::wall : Kind::dummy, 0));
  }


  template <int dim>
  void
  ParticleModel<dim>::check_layers(const ParticleFluid<dim>              &fluid,
                                   const std::vector<LayerParticle<dim>> &layers,
                                   const ParticleObstacles<dim>          &obstacles) const
  {
    for (const auto &particle : layers)
      {
        if (!particle.is_inflow && !constants.is_full)
          continue; // nothing is there
        const auto boundaries = fluid.options.section("Boundaries");
        const auto place      = "(" + write_value(particle.place) + ")";
        occupied.for_each_near(particle.place, apart * box.spacing, [&](const std::size_t k) {
          if (k < constants.reference.size())
            throw boundaries.error("",
                                   "the body '" + names[constants.body_of[k]] +
                                     "' stands in an inflow or opening at " + place,
                                   "Try: move it away by a spacing.");
        });
        auto next = particle.place; // where it flows
        if (particle.velocity.norm() > 0)
          next += (particle.layer + 1) * box.spacing * particle.velocity / particle.velocity.norm();
        if (obstacles.contain(next))
          throw boundaries.error("",
                                 "an obstacle closes an inflow or opening at " + place,
                                 "Try: move it away, or another 'Region' of the opening.");
      }
  }


  template <int dim>
  void
  ParticleModel<dim>::check_room(const ParticleFluid<dim>                              &fluid,
                                 const std::function<bool(const dealii::Point<dim> &)> &taken)
  {
    bool flows_in = false, flows_out = false;
    for (const auto &opening : fluid.openings)
      (opening.kind == OpeningKind::inflow ? flows_in : flows_out) = true;
    for (const auto side : box.sides)
      flows_out = flows_out || side == ParticleSide::open;
    if (!flows_in || flows_out)
      return;
    box.for_each_cell([&](const auto &place) { most_fluid += taken(place) ? 0 : 1; });
    if (fluid.places.size() == most_fluid)
      throw fluid.options.section("Boundaries")
        .error("",
               "fluid flows into a domain that is full and closed",
               "Try: an outflow, 'Domain / Open sides', or a smaller 'Region' of the fluid.");
  }


  template <int dim>
  void
  ParticleModel<dim>::find_surface(const ParticleFluid<dim>     &fluid,
                                   const ParticleObstacles<dim> &obstacles)
  {
    using Cube = typename FluidParts<dim>::Cube;
    const FluidParts<dim> parts(box, fluid, [&](const dealii::Point<dim> &place) {
      Cube cube = obstacles.contain(place) ? Cube::wall : Cube::free;
      occupied.for_each_near(place, apart * box.spacing, [&](const std::size_t k) {
        if (cube == Cube::free)
          cube = k < constants.reference.size() ? Cube::body : Cube::wall;
      });
      return cube;
    });
    if (parts.n_full == 0)
      return;
    if (parts.n > 1)
      throw fluid.options.error(
        "Region",
        fmt::format("the fluid around ({}) fills a part of the domain that walls and obstacles "
                    "close, and there is more fluid elsewhere",
                    write_value(*parts.in_full)),
        "Try: compute it by itself, or leave a layer of a spacing without fluid there.");
    const auto &numerics = constants.numerics;
    if (numerics.pair_force != particles::PairForce::balanced ||
        numerics.coupling != particles::Coupling::simultaneous)
      throw fluid.options.error(
        "Region",
        "the fluid fills a closed domain, where pressures are known up to a constant",
        "Allowed: only with 'Particles / Pressure / Pair force = balanced' and 'Coupling = "
        "simultaneous'. Try: them, or leave a layer of a spacing without fluid.");
    constants.is_full = true;
    // What starts or stops all the fluid at once are large pressures, which any opening of faces
    // turns into velocities.
    constexpr double closed_faces = 1e-3;
    if (!fluid.openings.empty() || !moving.empty())
      constants.numerics.faces_tolerance =
        std::min(constants.numerics.faces_tolerance, closed_faces);
    std::vector<dealii::Point<dim>> corners;
    for (unsigned int corner = 0; corner < (1u << dim); ++corner)
      {
        auto place = box.lower;
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (corner >> axis & 1)
            place[axis] = box.upper[axis];
        corners.push_back(place);
      }
    constants.top_potential = largest_potential(corners);
  }


  template <int dim>
  double
  ParticleModel<dim>::largest_potential(const std::vector<dealii::Point<dim>> &places) const
  {
    const particles::BodyForce<dim, double> force{
      constants.gravity, constants.attraction, constants.centre};
    double result = places.empty() ? 0 : -std::numeric_limits<double>::infinity();
    for (const auto &place : places)
      result = std::max(result, force.potential(plain<dim>(place)));
    return result;
  }


  template <int dim>
  void
  ParticleModel<dim>::add_fluid(ParticleFluid<dim>             &fluid,
                                std::vector<LayerParticle<dim>> layers,
                                const ParticleObstacles<dim>   &obstacles)
  {
    using particles::Kind;
    using particles::Tag;
    const auto taken = [&](const dealii::Point<dim> &place) {
      return occupied.any_near(place, apart * box.spacing) || obstacles.contain(place);
    };
    check_layers(fluid, layers, obstacles);
    VoidCubes<dim> voids(fluid.options);
    voids.fill(box, taken);
    const auto not_for_fluid = [&](const dealii::Point<dim> &place) {
      return taken(place) || voids.contain(place);
    };
    fluid.fill(box, not_for_fluid);
    check_room(fluid, not_for_fluid);
    auto places = fluid.places;
    for (const auto &particle : layers)
      places.push_back(particle.place);
    constants.top_potential = largest_potential(places);
    find_surface(fluid, obstacles);
    if (!constants.is_full) // else it goes on behind all openings
      layers.erase(std::remove_if(layers.begin(),
                                  layers.end(),
                                  [](const auto &particle) { return !particle.is_inflow; }),
                   layers.end());
    else
      check_layers(fluid, layers, obstacles);
    dealii::Tensor<1, dim> gravity;
    for (unsigned int axis = 0; axis < dim; ++axis)
      gravity[axis] = constants.gravity[axis];
    constants.depth      = fluid.depth(gravity, box.spacing);
    constants.open_sides = open_sides(fluid.openings, box, constants.is_full);
    n_fluid              = fluid.places.size();
    n_openings           = fluid.openings.size();
    n_layers             = layers.size();
    for (std::size_t k = 0; k < n_fluid; ++k)
      add(fluid.places[k], fluid.velocities[k], Tag::of(Kind::fluid, 0));
    add_layers(layers, gravity);
  }


  template <int dim>
  void
  ParticleModel<dim>::add_layers(const std::vector<LayerParticle<dim>> &layers,
                                 const dealii::Tensor<1, dim>          &gravity)
  {
    using particles::Kind;
    double fastest = 0;
    for (const auto &particle : layers)
      {
        const bool has_pressure = particle.layer == 0 || !particle.is_inflow;
        add(particle.place,
            particle.velocity,
            particles::Tag::of(has_pressure ? Kind::wall : Kind::dummy,
                               particle.is_inflow ? particles::inflow_material
                                                  : particles::opening_material));
        fastest = std::max(fastest, particle.velocity.norm());
      }
    if (fastest == 0)
      return;
    // What flows in may fill the box, and is faster than what sub-steps are chosen by.
    if (gravity.norm() > 0)
      for (unsigned int axis = 0; axis < dim; ++axis)
        constants.depth =
          std::max(constants.depth,
                   std::abs(gravity[axis]) / gravity.norm() * (box.upper[axis] - box.lower[axis]));
    auto        &numerics = constants.numerics;
    const double longest  = numerics.speed_share * box.spacing / fastest;
    numerics.largest_sub_step =
      numerics.largest_sub_step > 0 ? std::min(numerics.largest_sub_step, longest) : longest;
  }


  template <int dim>
  void
  ParticleModel<dim>::add(const dealii::Point<dim>     &place,
                          const dealii::Tensor<1, dim> &velocity,
                          const particles::Tag          tag)
  {
    start.identities.push_back(start.positions.size());
    start.positions.push_back(plain<dim>(place));
    start.velocities.push_back(plain(velocity));
    start.pressures.push_back(0);
    start.tags.push_back(tag);
  }


  template <int dim>
  particles::WallPaths<dim>
  ParticleModel<dim>::wall_paths(const double time, const double length) const
  {
    particles::WallPaths<dim> result;
    for (const auto &obstacle : moving)
      obstacle.add_paths(result, time, length);
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  ParticleModel<dim>::out_of_wall(const dealii::Point<dim> &place, const double reach) const
  {
    dealii::Tensor<1, dim> result;
    double                 nearest = reach;
    const auto             look    = [&](const double distance, const auto &outwards) {
      if (std::abs(distance) >= nearest)
        return;
      nearest = std::abs(distance);
      result  = outwards;
    };
    for (unsigned int side = 0; side < 2 * dim; ++side)
      if (box.sides[side] == ParticleSide::wall)
        {
          const unsigned int     axis = side / 2;
          dealii::Tensor<1, dim> outwards;
          outwards[axis] = side % 2 == 0 ? 1 : -1;
          look(place[axis] - (side % 2 == 0 ? box.lower : box.upper)[axis], outwards);
        }
    for (const auto &surface : surfaces)
      {
        const auto found = surface->nearest(place);
        look(found.distance, found.outwards);
      }
    return result;
  }


  template <int dim>
  std::size_t
  ParticleModel<dim>::n_particles() const
  {
    return n_fluid + constants.reference.size() + n_wall + constants.n_moving + n_layers;
  }


  template <int dim>
  std::string
  ParticleModel<dim>::counts() const
  {
    return fmt::format("{} of fluid, {} of {} bodies, {} of walls{}{}; {:.4g} m apart",
                       n_fluid,
                       constants.reference.size(),
                       names.size(),
                       n_wall,
                       moving.empty() ? "" : fmt::format(", {} of moving ones", constants.n_moving),
                       n_layers == 0 ? "" : fmt::format(", {} behind openings", n_layers),
                       box.spacing);
  }


  template class ParticleModel<2>;
  template class ParticleModel<3>;
} // namespace undine
