// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_pair_coefficient_h
#define undine_particles_fluid_pair_coefficient_h

#include <undine/particles/model/constants.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// Does pressure push against a particle, rather than take it along as fluid? In a full domain
  /// against walls, and where that has openings against bodies heavier than the fluid: taken along
  /// with their own density, they accelerated the fluid at their edges more than the coefficients
  /// say, so that its velocity was corrected several times too much, and the stream with it.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  bool
  is_firm(const Constants<dim, Real> &constants, const Tag tag)
  {
    if (!constants.is_full || tag.kind() == Kind::fluid)
      return false;
    if (tag.kind() == Kind::solid)
      return !constants.is_closed && constants.density(tag) > constants.fluid_density;
    return tag.material() != opening_material;
  }

  /// How far pressure moves a particle, over how far it moves fluid [1].
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  mobility(const Constants<dim, Real> &constants, const Tag tag)
  {
    if (tag.is_free() || tag.material() == opening_material)
      return constants.fluid_density / constants.density(tag);
    return 0;
  }

  /// The pair's coefficient in the pressure equation, k_ij [1]: by the density between both, at
  /// which they are accelerated alike. What is firm and the fluid are accelerated apart, each by
  /// the mean of their pressures.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  pressure_coefficient(const Constants<dim, Real> &constants,
                       const Tag                   tag,
                       const Pair<dim, Real>      &pair)
  {
    if (tag.material() == 0 && pair.tag.material() == 0 &&
        (tag.code == pair.tag.code || !constants.is_full))
      return pair.weight; // mostly, and a quotient takes long
    if (is_firm(constants, tag) || is_firm(constants, pair.tag))
      return pair.weight * (mobility(constants, tag) + mobility(constants, pair.tag)) / 2;
    return pair.weight * constants.fluid_density / constants.mean_density(tag, pair.tag);
  }

  /// The largest of them: that of the largest weight, at the smallest mean density.
  template <int dim, class Real>
  Real
  largest_coefficient(const Constants<dim, Real> &constants)
  {
    return Pair<dim, Real>::largest_weight * constants.fluid_density / constants.lightest_density;
  }

  /// Has a pair of neighbours no face? In a full domain two particles of walls, which pressure does
  /// not move, and the fluid and what is farther than the first layer of something firm: pressure
  /// in front of thin walls and bodies would act through them.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  bool
  is_apart(const Constants<dim, Real> &constants, const Tag tag, const Pair<dim, Real> &pair)
  {
    if (!constants.is_full || (tag.code == pair.tag.code && tag.is_free()))
      return false;
    if (!tag.is_free() && !pair.tag.is_free())
      return true;
    const Real near     = Real(1.8) * constants.spacing;
    const bool is_fluid = tag.kind() == Kind::fluid || pair.tag.kind() == Kind::fluid;
    return pair.square > near * near && is_fluid &&
           (is_firm(constants, tag) || is_firm(constants, pair.tag));
  }
} // namespace undine::particles

#endif
