// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/particles/model/lattice.h>
#include <undine/particles/setup/make_constants.h>

#include <cmath>
#include <limits>
#include <string>

namespace undine::particles
{
  namespace
  {
    template <int dim, class Real>
    void
    set_materials(Constants<dim, Real> &constants, const Setup<dim> &setup)
    {
      constants.fluid_density = static_cast<Real>(setup.fluid_density);
      constants.fluid_compressibility =
        setup.fluid_bulk_modulus > 0 ? static_cast<Real>(1 / setup.fluid_bulk_modulus) : Real(0);
      constants.lightest_density = constants.fluid_density;
      for (const auto &body : setup.bodies)
        constants.lightest_density =
          minimum(constants.lightest_density, static_cast<Real>(body.density));
    }

    /// How particles go through a sub-step.
    template <int dim, class Real>
    void
    set_ways(Constants<dim, Real> &constants, const Setup<dim> &setup)
    {
      const bool nothing_moves    = setup.bodies.empty() && setup.n_moving == 0;
      const bool by_mean_velocity = setup.numerics.position_update == PositionUpdate::mean_velocity;
      constants.path_weight       = by_mean_velocity ? Real(setup.is_full ? 0.6 : 0.5) : Real(1);
      constants.is_alone = by_mean_velocity && setup.has_fluid && !setup.is_full && nothing_moves;
      constants.pressure_place = constants.is_alone ? 1 - constants.path_weight : Real(1);
    }

    /// The longest sub-step that gravity waves allow [s]; 0 without any.
    template <int dim>
    double
    longest_by_waves(const Setup<dim> &setup)
    {
      const double speed_square = std::sqrt(norm_square(setup.gravity)) * setup.depth;
      return speed_square > 0 ? setup.numerics.wave_share * setup.spacing / std::sqrt(speed_square)
                              : 0;
    }


    /// The longest sub-step in which what falls from rest crosses no more of the spacing than what
    /// is fast may [s]; 0 if nothing falls.
    template <int dim>
    double
    longest_by_fall(const Setup<dim> &setup)
    {
      const double largest = std::sqrt(norm_square(setup.gravity)) +
                             setup.attraction * std::sqrt(norm_square(setup.upper - setup.lower));
      return largest > 0 ? std::sqrt(2 * setup.numerics.speed_share * setup.spacing / largest) : 0;
    }
  } // namespace


  template <int dim, class Real>
  Constants<dim, Real>
  make_constants(const Setup<dim> &setup)
  {
    const auto          &numerics = setup.numerics;
    const double         l0       = setup.spacing;
    const auto           lattice  = full_lattice(dim, numerics.reach);
    Constants<dim, Real> constants{};
    constants.grid =
      make_cell_grid<dim, Real>(setup.lower, setup.upper, setup.periodic, numerics.reach * l0);
    constants.spacing        = static_cast<Real>(l0);
    constants.reach          = static_cast<Real>(numerics.reach * l0);
    constants.volume         = static_cast<Real>(std::pow(l0, dim));
    constants.number_density = static_cast<Real>(lattice.number_density);
    constants.spread         = static_cast<Real>(lattice.spread * l0 * l0);
    constants.filling        = static_cast<Real>(lattice.filling);
    constants.surface_lack   = static_cast<Real>(lattice.surface_lack);
    constants.filling_growth = static_cast<Real>(lattice.filling_growth);
    for (int axis = 0; axis < dim; ++axis)
      {
        constants.force.gravity[axis] = static_cast<Real>(setup.gravity[axis]);
        constants.force.centre[axis]  = static_cast<Real>(setup.centre[axis]);
      }
    constants.force.attraction  = static_cast<Real>(setup.attraction);
    const bool is_open          = setup.has_openings();
    constants.is_full           = setup.is_full;
    constants.is_closed         = setup.is_full && !is_open;
    constants.displaced_density = static_cast<Real>(setup.is_full ? setup.fluid_density : 0.);
    constants.top_potential     = static_cast<Real>(setup.top_potential);
    constants.viscosity         = static_cast<Real>(setup.fluid_viscosity);
    constants.wall_friction     = {static_cast<Real>(setup.wall_viscosity),
                                   static_cast<Real>(setup.wall_roughness)};
    set_materials(constants, setup);
    constants.source = numerics.source;
    // In a full domain particles are moved to even spacing instead, see EvenSpacing; with openings
    // there is an error of all volume.
    const double corrected  = setup.is_full ? 0. : 1.;
    constants.density_share = static_cast<Real>(constants.is_closed ? 0. : numerics.density_share);
    const double gravity    = std::sqrt(norm_square(setup.gravity));
    constants.relaxation_time =
      gravity > 0 && !setup.is_full
        ? static_cast<Real>(numerics.relaxation_time * std::sqrt(l0 / gravity))
        : Real(0);
    constants.crowd_excess = static_cast<Real>(numerics.crowd_excess);
    constants.crowd_share  = static_cast<Real>(corrected * numerics.crowd_share);
    const double longest   = longest_by_waves(setup);
    constants.crowd_rate =
      longest > 0 ? static_cast<Real>(corrected * numerics.crowd_share / longest) : Real(0);
    constants.surface_density       = static_cast<Real>(numerics.surface_density);
    constants.body_surface_density  = static_cast<Real>(numerics.body_surface_density);
    constants.one_sided_density     = static_cast<Real>(numerics.one_sided_density);
    constants.surface_one_sidedness = static_cast<Real>(numerics.surface_one_sidedness);
    constants.surface_fade          = static_cast<Real>(numerics.surface_fade);
    constants.air                   = static_cast<Real>(numerics.air);
    set_ways(constants, setup);
    constants.collision_distance = static_cast<Real>(numerics.collision_distance * l0);
    constants.fluid_collision_distance =
      setup.is_full ? minimum(constants.collision_distance, static_cast<Real>(0.5 * l0))
                    : constants.collision_distance;
    constants.restitution    = static_cast<Real>(numerics.restitution);
    constants.pair_force     = numerics.pair_force;
    constants.coupling       = numerics.coupling;
    constants.shifting       = static_cast<Real>(numerics.shifting);
    constants.shifting_limit = static_cast<Real>(numerics.shifting_limit * l0);
    return constants;
  }


  template <int dim, class Real>
  OpenBoundaries<dim, Real>
  make_open_boundaries(const Setup<dim> &setup)
  {
    OpenBoundaries<dim, Real> open{};
    if (setup.open_sides.size() > OpenBoundaries<dim, Real>::most)
      throw InputError("the scene has " + std::to_string(setup.open_sides.size()) +
                       " inflows and outflows; at most " +
                       std::to_string(OpenBoundaries<dim, Real>::most) + " are possible.");
    for (const auto &side : setup.open_sides)
      open.boundaries[open.n++] = {side.axis,
                                   static_cast<Real>(side.plane),
                                   static_cast<Real>(side.inward),
                                   static_cast<Real>(side.depth),
                                   side.is_inflow,
                                   side.is_opening,
                                   static_cast<Real>(side.pressure),
                                   side.enters_from_rest};
    return open;
  }


  template <int dim>
  double
  pressure_at_rest(const Setup<dim> &setup, const Vector<dim, double> &x)
  {
    const BodyForce<dim, double> force{setup.gravity, setup.attraction, setup.centre};
    return setup.is_full ? setup.fluid_density * (setup.top_potential - force.potential(x)) : 0.;
  }


  double
  bulk_modulus(const BodySetup &body, const int dim)
  {
    const double nu = body.poissons_ratio;
    return body.youngs_modulus * (nu / ((1 + nu) * (1 - 2 * nu)) + 1 / (dim * (1 + nu)));
  }


  template <int dim>
  StepBounds
  make_bounds(const Setup<dim> &setup, const double elastic_rate)
  {
    const auto  &numerics = setup.numerics;
    const double l0       = setup.spacing;
    const double spread   = full_lattice(dim, numerics.reach).spread * l0 * l0;
    StepBounds   bounds;
    bounds.asked = numerics.largest_sub_step > 0 ? numerics.largest_sub_step
                                                 : std::numeric_limits<double>::max();
    // Waves of a fluid are faster than what falls.
    bounds.waves    = setup.has_fluid ? longest_by_waves(setup) : longest_by_fall(setup);
    double lightest = setup.fluid_density;
    for (const auto &body : setup.bodies)
      lightest = std::min(lightest, body.density);
    // Half of what is stable, for bodies, which the same forces accelerate, too (P2).
    if (setup.fluid_viscosity > 0)
      bounds.viscosity =
        lightest / setup.fluid_density * spread / (4 * dim * setup.fluid_viscosity);
    bounds.speed_share        = numerics.speed_share * l0;
    bounds.elastic_rate       = elastic_rate;
    bounds.elastic_share      = numerics.elastic_share;
    bounds.most_elastic_steps = numerics.most_elastic_steps;
    return bounds;
  }


  template OpenBoundaries<2, float>
  make_open_boundaries(const Setup<2> &);
  template OpenBoundaries<2, double>
  make_open_boundaries(const Setup<2> &);
  template OpenBoundaries<3, float>
  make_open_boundaries(const Setup<3> &);
  template OpenBoundaries<3, double>
  make_open_boundaries(const Setup<3> &);
  template Constants<2, float>
  make_constants(const Setup<2> &);
  template Constants<2, double>
  make_constants(const Setup<2> &);
  template Constants<3, float>
  make_constants(const Setup<3> &);
  template Constants<3, double>
  make_constants(const Setup<3> &);
  template double
  pressure_at_rest(const Setup<2> &, const Vector<2, double> &);
  template double
  pressure_at_rest(const Setup<3> &, const Vector<3, double> &);
  template StepBounds
  make_bounds(const Setup<2> &, double);
  template StepBounds
  make_bounds(const Setup<3> &, double);
} // namespace undine::particles
