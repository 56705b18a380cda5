// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/moving_obstacle.h>
#include <undine/particle_model/plain_vector.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double accuracy = 1e-3; // of velocities by differences [frames]
  }                                   // namespace


  template <int dim>
  MovingObstacle<dim>::MovingObstacle(const Options                        &options,
                                      const std::string                    &name,
                                      const Expression<dim, dim>           &displacement,
                                      const std::vector<WallParticle<dim>> &particles)
    : name(name)
    , displacement(displacement)
    , at_rest(particles)
  {
    for (const auto &particle : at_start())
      if (!std::isfinite(particle.place.norm()))
        throw options.error("Displacement",
                            "is not a number at the start",
                            "Try: an expression that is finite everywhere in the obstacle.");
  }


  template <int dim>
  std::vector<WallParticle<dim>>
  MovingObstacle<dim>::at_start() const
  {
    auto result = at_rest;
    for (auto &particle : result)
      particle.place += displacement.vector(particle.place, 0.);
    return result;
  }


  template <int dim>
  typename MovingObstacle<dim>::Instant
  MovingObstacle<dim>::instant(const double time, const double accuracy) const
  {
    Instant           result;
    const double      first = std::max(0., time - accuracy); // there may be no meaning before
    const std::size_t n     = displacement.names_place() ? at_rest.size() : 1;
    for (std::size_t k = 0; k < n; ++k)
      {
        const auto &place  = at_rest[k].place;
        const auto  before = displacement.vector(place, first);
        const auto  after  = displacement.vector(place, time + accuracy);
        result.displacements.push_back(displacement.vector(place, time));
        result.velocities.push_back((after - before) / (time + accuracy - first));
        if (!std::isfinite(result.displacements[k].norm() + result.velocities[k].norm()))
          throw SolveError(fmt::format("the 'Displacement' of the obstacle '{}' or its velocity is "
                                       "not a number at {:.6g} s.",
                                       name,
                                       time));
      }
    return result;
  }


  template <int dim>
  void
  MovingObstacle<dim>::add_paths(particles::WallPaths<dim> &paths,
                                 const double               time,
                                 const double               length) const
  {
    const auto start = instant(time, accuracy * length);
    const auto end   = instant(time + length, accuracy * length);
    for (std::size_t k = 0; k < at_rest.size(); ++k)
      {
        const std::size_t m = start.displacements.size() == 1 ? 0 : k;
        paths.push_back({plain<dim>(at_rest[k].place + start.displacements[m]),
                         plain<dim>(end.displacements[m] - start.displacements[m]),
                         plain<dim>(start.velocities[m]),
                         plain<dim>(end.velocities[m]),
                         at_rest[k].layer == 0 ? particles::Kind::wall : particles::Kind::dummy});
      }
  }


  template class MovingObstacle<2>;
  template class MovingObstacle<3>;
} // namespace undine
