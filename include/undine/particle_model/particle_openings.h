// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_openings_h
#define undine_particle_model_particle_openings_h

#include <undine/base/options/expression.h>
#include <undine/fluid/boundary/boundary.h>
#include <undine/particle_model/particle_domain.h>
#include <undine/particles/setup/setup.h>

#include <string>
#include <vector>

namespace undine
{
  enum class OpeningKind
  {
    inflow,  ///< with a given velocity
    outflow, ///< no traction; what leaves is not computed any more
    pressure ///< with a given pressure
  };

  /// A part of the box's sides through which fluid of particles enters or leaves.
  template <int dim>
  struct ParticleOpening
  {
    /// Read a subsection of `Fluid / Boundaries`. Throws InputError.
    explicit ParticleOpening(const Options &options);

    Options              options;
    OpeningKind          kind;
    std::vector<Side>    sides;
    Expression<dim>      region;       ///< the places of the sides that have a value > 0
    Expression<dim, dim> velocity;     ///< of an inflow, constant in time [m/s]
    double               pressure = 0; ///< [Pa]

    /// Is there an opening at `place` of a side? Throws InputError if that is not a number.
    bool
    covers(const dealii::Point<dim> &place) const;

    /// With which fluid flows in at `place` of a side [m/s]. Throws InputError unless it flows into
    /// the domain, normal to the side.
    dealii::Tensor<1, dim>
    velocity_at(const dealii::Point<dim> &place, const Side &side) const;
  };

  /// A particle of the layers behind an inflow, or behind another opening of a domain that is full.
  template <int dim>
  struct LayerParticle
  {
    dealii::Point<dim>     place; ///< [m]
    unsigned int           layer; ///< 0: next to the fluid
    dealii::Tensor<1, dim> velocity;
    bool                   is_inflow;
  };

  /// The openings of a scene, in the order of the file. Throws InputError.
  template <int dim>
  std::vector<ParticleOpening<dim>>
  read_particle_openings(const Options &fluid);

  /// Take the particles that are at openings out of the walls around the box. They are returned,
  /// those at inflows with the velocity of the inflow. Where openings overlap, the later one
  /// counts. Throws InputError for openings that contradict the domain, each other, or are nowhere.
  template <int dim>
  std::vector<LayerParticle<dim>>
  open_walls(std::vector<WallParticle<dim>>          &walls,
             const std::vector<ParticleOpening<dim>> &openings,
             const ParticleDomain<dim>               &domain);

  /// The planes of all openings, and those around the room beyond open sides, where fluid is taken
  /// out: the end of the room, and the outer faces of the walls beside it, over which drops may
  /// fly. In a domain that is full fluid comes and goes through openings that are no inflows.
  template <int dim>
  std::vector<particles::OpenSide>
  open_sides(const std::vector<ParticleOpening<dim>> &openings,
             const ParticleDomain<dim>               &domain,
             bool                                     is_full);

  /// Where the fluid has a surface, sides with the pressure zero are open sides of the domain, the
  /// air above the surface: make them so, and take them out of `openings`. Throws InputError for
  /// other pressures.
  template <int dim>
  void
  open_to_air(std::vector<ParticleOpening<dim>> &openings, ParticleDomain<dim> &domain);
} // namespace undine

#endif
