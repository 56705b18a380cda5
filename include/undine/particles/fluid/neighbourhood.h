// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_neighbourhood_h
#define undine_particles_fluid_neighbourhood_h

#include <undine/particles/fluid/inward_directions.h>
#include <undine/particles/fluid/stored_correction.h>
#include <undine/particles/math/matrix.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/lattice.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/neighbours/neighbours.h>

namespace undine::particles
{
  /// What the surroundings of the particles are like.
  template <int dim, class Real>
  struct Neighbourhood
  {
    Real *densities; ///< number density n* [1]
    /// 1 + the error of the volume: sum of filling() over that of a full lattice and, as it should
    /// be there, what a plane surface with as one-sided neighbours takes of it [1]. In a full
    /// domain there is no surface, only gaps to be filled.
    Real *fillings;
    int  *is_unknown; ///< 1: has a row in the pressure equation
    Real *coverages;  ///< 0: at the free surface; 1: not [1]
    /// 1: has neighbours with given pressures; AssemblePressure says it of those with a row.
    unsigned char *is_beside_given;
    /// M, which makes gradients exact for linear fields.
    StoredCorrection<dim, Real> *corrections;
    StoredVector<dim, Real>
      *inward_directions; ///< as by MeasureInwardDirections; nullptr: no bodies
  };

  /// Measures them, over all kinds of neighbours; but M of fluid and bodies without dummies, which
  /// have no pressure. At the free surface are particles with few neighbours, and those with
  /// somewhat few which are all on one side. In between are particles of the fluid that are a
  /// little of both: a limit that rounding decides on would send single particles different ways.
  template <int dim, class Real>
  struct MeasureNeighbourhood
  {
    Constants<dim, Real>     constants;
    Neighbours<dim, Real>    neighbours;
    const int               *identities;
    const unsigned char     *inside_body; ///< by identity: has its own body all around
    Neighbourhood<dim, Real> result;
    const StepControl       *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      const Tag tag         = neighbours.places[i].tag;
      result.is_unknown[i]  = 0;
      result.coverages[i]   = 0;
      result.densities[i]   = 0;
      result.fillings[i]    = 0;
      const auto identity   = SymmetricMatrix<dim, Real>::diagonal(1);
      result.corrections[i] = StoredCorrection<dim, Real>::of(identity, PressureIs::given);
      if (result.inward_directions != nullptr)
        result.inward_directions[i] = Vector<dim, Real>::zero();
      if (tag.kind() == Kind::dummy || control->done())
        return;
      auto                    side   = Vector<dim, Real>::zero();
      auto                    moment = SymmetricMatrix<dim, Real>::diagonal(0);
      Real                    n = 0, f = 0;
      bool                    moves = tag.is_free(); // or touches what does
      BodiesAround<dim, Real> bodies;
      neighbours.for_each(i, [&](const int, const Pair<dim, Real> &pair) {
        n += pair.weight;
        f += filling(pair.square / (constants.reach * constants.reach));
        bodies.add(pair);
        moves = moves || pair.tag.is_free();
        side += (pair.weight * pair.inverse_distance) * pair.r;
        if (pair.tag.kind() != Kind::dummy || tag.kind() == Kind::wall)
          moment.add_square(pair.weight_over_square(), pair.r);
      });
      if (result.inward_directions != nullptr && tag.kind() == Kind::fluid)
        result.inward_directions[i] = bodies.inward_direction(constants.number_density);
      side *= 1 / constants.number_density;
      const Real coverage = this->coverage(tag, identities[i], n / constants.number_density, side);
      result.densities[i] = n;
      result.fillings[i]  = f / constants.filling;
      if (!constants.is_full)
        result.fillings[i] += constants.surface_lack * norm_square(side);
      result.coverages[i]   = coverage;
      const bool unknown    = constants.is_full ? moves && tag.material() != opening_material
                                                : has_pressure(tag, n, coverage > 0);
      result.is_unknown[i]  = unknown ? 1 : 0;
      const Real share      = tag.kind() == Kind::solid ? Real(1) : coverage;
      result.corrections[i] = StoredCorrection<dim, Real>::of(
        share > 0 ? mixed(identity, correction(moment), share) : identity,
        unknown ? PressureIs::unknown : PressureIs::given);
    }

  private:
    /// `n` and `side` as shares of n0. A body's particle beside which water has opened a little gap
    /// is not at the free surface: its pressure would be given, zero, and pull that of all the
    /// water around to it. Faces of bodies in air have 0.68 (in the plane) or 0.73 of a full
    /// neighbourhood.
    UNDINE_HOST_DEVICE
    Real
    coverage(const Tag tag, const int identity, const Real n, const Vector<dim, Real> &side) const
    {
      if (constants.is_full)
        return 1;
      if (tag.kind() == Kind::solid)
        return inside_body[identity] || n >= constants.body_surface_density ? Real(1) : Real(0);
      const Real has_few       = fade(constants.surface_density - n);
      const Real has_fewer     = fade(constants.one_sided_density - n);
      const Real are_one_sided = fade(sqrt(norm_square(side)) - constants.surface_one_sidedness);
      return (1 - has_few) * (1 - has_fewer * are_one_sided);
    }

    /// From 0 to 1 about zero, smoothly.
    UNDINE_HOST_DEVICE
    Real
    fade(const Real beyond) const
    {
      const Real x =
        minimum(Real(1), maximum(Real(0), Real(0.5) + beyond / (2 * constants.surface_fade)));
      return x * x * (3 - 2 * x);
    }

    UNDINE_HOST_DEVICE
    static SymmetricMatrix<dim, Real>
    mixed(const SymmetricMatrix<dim, Real> &a, SymmetricMatrix<dim, Real> b, const Real share_of_b)
    {
      for (int k = 0; k < b.size; ++k)
        b.entries[k] = a.entries[k] + share_of_b * (b.entries[k] - a.entries[k]);
      return b;
    }

    /// With air, pressures at the free surface are unknown too; only drops that fly alone have
    /// none.
    UNDINE_HOST_DEVICE
    bool
    has_pressure(const Tag tag, const Real n, const bool covered) const
    {
      if (tag.kind() == Kind::solid && constants.coupling == Coupling::surface_pressure)
        return false;
      if (covered || constants.air <= 0 || tag.kind() == Kind::solid)
        return covered;
      const Real least = tag.kind() == Kind::wall ? Real(0.2) : Real(0.1);
      return n > least * constants.number_density;
    }

    /// The inverse of (dim / n0) sum w r r^T / r^2; the identity where neighbours do not span
    /// space.
    UNDINE_HOST_DEVICE
    SymmetricMatrix<dim, Real>
    correction(const SymmetricMatrix<dim, Real> &moment) const
    {
      auto scaled = moment.full();
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          scaled[i][j] *= dim / constants.number_density;
      auto result = SymmetricMatrix<dim, Real>::diagonal(1);
      if (!(determinant(scaled) > Real(0.1)))
        return result;
      const auto inverse = SymmetricMatrix<dim, Real>::of(inverse_transpose(scaled));
      Real       largest = 0;
      for (int k = 0; k < result.size; ++k)
        largest = maximum(largest, absolute(inverse.entries[k] - result.entries[k]));
      return largest < StoredCorrection<dim, Real>::bound ? inverse : result;
    }
  };
} // namespace undine::particles

#endif
