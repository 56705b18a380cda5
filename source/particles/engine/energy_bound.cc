// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/engine/energy_bound.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace undine::particles
{
  template <int dim>
  EnergyBound<dim>::EnergyBound(const Setup<dim> &setup, const ParticleState<dim> &state)
    : spacing(setup.spacing)
  {
    const double volume = std::pow(spacing, dim);
    source_mass         = setup.fluid_density;
    for (int axis = 0; axis < dim; ++axis)
      {
        const double extent = setup.upper[axis] - setup.lower[axis];
        height              = std::max(height, extent);
        falls_around        = falls_around || (setup.periodic[axis] && setup.gravity[axis] != 0);
        source_mass *= extent;
      }
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      {
        const Tag tag = state.tags[i];
        if (tag.kind() == Kind::solid)
          mass += volume * setup.bodies[setup.body_of[state.identities[i]]].density;
        else if (tag.kind() == Kind::fluid)
          mass += volume * setup.fluid_density;
        else if (tag.material() == inflow_material)
          {
            flows_in     = true;
            inflow_speed = std::max(inflow_speed, std::sqrt(norm_square(state.velocities[i])));
          }
      }
    for (const auto &side : setup.open_sides)
      if (side.is_opening)
        {
          flows_in = true;
          inflow_speed =
            std::max(inflow_speed, std::sqrt(2 * std::abs(side.pressure) / setup.fluid_density));
        }
    gravity = std::sqrt(norm_square(setup.gravity)) + std::abs(setup.attraction) * height;
  }


  namespace
  {
    /// Kinetic and elastic energy [J].
    template <int dim>
    double
    in_motion(const Balance<dim> &balance)
    {
      return balance.kinetic_fluid + balance.kinetic_solid + balance.elastic;
    }


    template <int dim>
    double
    total(const Balance<dim> &balance)
    {
      return in_motion(balance) + balance.potential;
    }


    std::string
    reason(const double gain, const std::string &since, const double had)
    {
      std::ostringstream text;
      text << "the energy of fluid and bodies grew by " << gain << " J " << since << had
           << " J in motion and deformation; sources of that much are not known. A body is softer "
              "than what hits or presses on it, or sub-steps are too long. Try a stiffer body "
              "(Young's modulus above rho v^2 and rho g H), a smaller 'Speed share', or smaller "
              "particles.";
      return text.str();
    }
  } // namespace


  template <int dim>
  bool
  EnergyBound<dim>::has_sources() const
  {
    return wall_speed > 0 || flows_in || falls_around;
  }


  template <int dim>
  void
  EnergyBound<dim>::accept(const Balance<dim> &before, const Balance<dim> &after)
  {
    if (has_sources() || after.mass < before.mass)
      at_start.reset();
    else if (!at_start)
      at_start = total(before);
  }


  template <int dim>
  std::string
  EnergyBound<dim>::reason_of_excess(const Balance<dim> &before,
                                     const Balance<dim> &after,
                                     const double        length) const
  {
    const double had = in_motion(before), weight = mass * gravity;
    const auto   in_frame = [&](const double gain, const double may_gain) {
      return gain > may_gain ? reason(gain, "in a frame that began with ", had) : "";
    };
    if (has_sources())
      {
        // A wall throws what is at rest with twice its speed.
        const double speed = std::max(2 * wall_speed, inflow_speed);
        return in_frame(in_motion(after) - had,
                        10 * had + (mass + (flows_in ? source_mass : 0)) *
                                     (speed * speed + gravity * (height + speed * length)));
      }
    if (!(gravity > 0 || had > 0))
      return "";
    const auto because = in_frame(total(after) - total(before), share * (had + weight * spacing));
    if (!because.empty() || after.mass < before.mass || !at_start)
      return because;
    const double gain = total(after) - *at_start, has = in_motion(after);
    return gain > share_of_motion * has + share_of_weight * weight * spacing
             ? reason(gain, "since the start, in a frame that ended with ", has)
             : "";
  }


  template struct EnergyBound<2>;
  template struct EnergyBound<3>;
} // namespace undine::particles
