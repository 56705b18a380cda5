// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/scheme/particle_scheme.h>
#include <undine/effects/effect.h>
#include <undine/particle_model/particle_body.h>
#include <undine/particle_model/particle_fluid.h>
#include <undine/particle_model/particle_numerics.h>
#include <undine/particles/elasticity/reference_lattice.h>
#include <undine/particles/setup/make_constants.h>
#include <undine/scene/measure_particles.h>
#include <undine/surface/obstacle_description.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace undine
{
  namespace
  {
    constexpr double reserve_behind_inflows = 16; // of those in the layers, see ParticleEngine


    /// [m^dim] or [m^(dim-1)], of a shape or a surface from a file.
    struct Extent
    {
      double volume = 0;
      double area   = 0;
    };


    template <int dim>
    Extent
    extent_of(const ShapeDescription<dim> &description)
    {
      if (description.shape)
        {
          const auto size = description.shape->size();
          return {size.volume, size.area};
        }
      const auto boundary = make_shape_boundary(description);
      const auto surface  = boundary.surface(description.name);
      Extent     result{body_volumes(surface, boundary.nodes)[0], 0};
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        result.area += area_vector(surface, facet, boundary.nodes).norm();
      return result;
    }


    /// Cubes of the box in all.
    template <int dim>
    double
    cubes(const ParticleDomain<dim> &box)
    {
      double result = 1;
      for (const auto n : box.cells)
        result *= n;
      return result;
    }


    /// The layers around the box, and those of obstacles where these are thick enough.
    template <int dim>
    double
    count_walls(const Options &scene, const ParticleDomain<dim> &box)
    {
      double with_walls = 1;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          double n = box.cells[axis];
          for (const unsigned int side : {2 * axis, 2 * axis + 1})
            n += box.sides[side] == ParticleSide::wall ? box.layers : 0;
          with_walls *= n;
        }
      double in_obstacles = 0; // [m^dim]
      for (const auto &obstacle : read_obstacles<dim>(scene))
        {
          const auto extent = extent_of(obstacle.description);
          in_obstacles += std::min(extent.volume, extent.area * box.layers * box.spacing);
        }
      return with_walls - cubes(box) + in_obstacles / std::pow(box.spacing, dim);
    }


    /// The part of a side that an opening covers, by a sample of places [1].
    template <int dim>
    double
    covered_share(const ParticleOpening<dim> &opening,
                  const Side                 &side,
                  const ParticleDomain<dim>  &box)
    {
      constexpr unsigned int    n    = 40; // along each direction
      double                    seen = 0, covered = 0;
      std::array<unsigned, dim> index{};
      for (unsigned int axis = 0; axis < dim;)
        {
          dealii::Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = box.lower[d] + (index[d] + 0.5) / n * (box.upper[d] - box.lower[d]);
          place[side.axis] = side.end == 0 ? box.lower[side.axis] : box.upper[side.axis];
          seen += 1;
          covered += opening.covers(place) ? 1 : 0;
          for (axis = 0; axis < dim && (axis == side.axis || ++index[axis] == n); ++axis)
            index[axis] = 0;
        }
      return covered / seen;
    }


    /// What waits behind inflows.
    template <int dim>
    double
    count_waiting(const ParticleFluid<dim> &fluid, const ParticleDomain<dim> &box)
    {
      double result = 0;
      for (const auto &opening : fluid.openings)
        if (opening.kind == OpeningKind::inflow)
          for (const auto &side : opening.sides)
            result += reserve_behind_inflows * box.layers * cubes(box) / box.cells[side.axis] *
                      covered_share(opening, side, box);
      return result;
    }


    /// How fast anything may soon be [m/s]: as at the start, or after a fall from the depth.
    template <int dim>
    double
    likely_speed(const particles::Setup<dim> &setup, const double at_start)
    {
      const double gravity = std::sqrt(norm_square(setup.gravity));
      return std::max(at_start, std::sqrt(2 * gravity * setup.depth));
    }


    template <int dim>
    double
    count_sub_steps(const particles::Setup<dim> &setup, const double frame, const double at_start)
    {
      const auto   bounds  = particles::make_bounds(setup, 0.);
      const double speed   = likely_speed(setup, at_start);
      double       longest = std::min(frame, bounds.asked);
      for (const double bound :
           {bounds.waves, bounds.viscosity, speed > 0 ? bounds.speed_share / speed : 0.})
        if (bound > 0)
          longest = std::min(longest, bound);
      return std::ceil(frame / longest);
    }


    /// Explicit steps of bodies in a frame, by the fastest of them.
    template <int dim>
    double
    count_elastic_steps(const particles::Setup<dim> &setup, const double frame)
    {
      return frame * particles::ReferenceLattice<dim, double>(setup).rate() /
             setup.numerics.elastic_share;
    }
  } // namespace


  template <int dim>
  ParticleSize
  measure_particles(const Options &scene)
  {
    const ParticleNumerics    numerics(scene);
    const ParticleDomain<dim> box(scene, numerics.spacing, numerics.numerics.reach);
    const double              cube  = std::pow(box.spacing, dim);
    double                    frame = 0.01, fastest = 0;
    scene.section("Time").add("Step", frame, "s", Allowed::positive(), "");

    ParticleSize          size;
    particles::Setup<dim> setup;
    setup.spacing  = box.spacing;
    setup.numerics = numerics.numerics;
    size.is_double =
      numerics.precision == particles::Precision::double_precision || seeks_equilibrium(scene);
    size.on_device  = numerics.executor != "host";
    size.walls      = count_walls(scene, box);
    size.grid_cells = 1;
    for (unsigned int axis = 0; axis < dim; ++axis)
      size.grid_cells *= std::max(1.,
                                  (box.outermost_upper()[axis] - box.outermost_lower()[axis]) /
                                    (numerics.numerics.reach * box.spacing));
    for (const auto &body : read_particle_bodies<dim>(scene))
      {
        size.solid += extent_of(body.description).volume / cube;
        setup.bodies.push_back(body.setup);
      }
    std::optional<ParticleFluid<dim>> fluid;
    if (scene.section("Fluid").given())
      fluid.emplace(scene);
    if (fluid)
      setup.fluid_density = fluid->density;
    for (const auto &effect : read_effects<dim>(scene.section("Effects")))
      effect->affect_particles(setup);
    if (fluid)
      {
        dealii::Tensor<1, dim> gravity;
        for (unsigned int axis = 0; axis < dim; ++axis)
          gravity[axis] = setup.gravity[axis];
        const auto sample = fluid->sample(box, gravity);
        size.fluid        = std::max(0., sample.share * cubes(box) - size.solid);
        setup.depth       = sample.depth;
        fastest           = sample.fastest;
        size.waiting      = count_waiting(*fluid, box);
        size.sub_steps    = count_sub_steps(setup, frame, fastest);
      }
    size.elastic_steps = count_elastic_steps(setup, frame);
    if (setup.numerics.most_elastic_steps > 0)
      size.elastic_steps =
        std::min(size.elastic_steps, size.sub_steps * setup.numerics.most_elastic_steps);
    return size;
  }


  template ParticleSize
  measure_particles<2>(const Options &);
  template ParticleSize
  measure_particles<3>(const Options &);
} // namespace undine
