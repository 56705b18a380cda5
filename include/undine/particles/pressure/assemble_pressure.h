// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_assemble_pressure_h
#define undine_particles_pressure_assemble_pressure_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/fluid/neighbourhood.h>
#include <undine/particles/pressure/pressure_matrix.h>
#include <undine/particles/pressure/virtual_faces.h>

namespace undine::particles
{
  /// rho_f lambda n0 / (2 dim): what div(grad P / rho) is multiplied with in the pressure equation
  /// [kg/m^(dim-2)].
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  pressure_scale(const Constants<dim, Real> &constants)
  {
    return constants.fluid_density * constants.spread * constants.number_density / (2 * dim);
  }

  /// The pair's coefficient in the pressure equation, k_ij [1]. Where a full domain has openings
  /// bodies heavier than the fluid count as fluid there, as walls do: the fluid at the edge of a
  /// thin body is accelerated more than coefficients of a heavy one say, so that its velocity would
  /// be corrected several times too much, and the stream through the openings with it.
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  pressure_coefficient(const Constants<dim, Real> &constants,
                       const Tag                   tag,
                       const Pair<dim, Real>      &pair)
  {
    if (tag.material() == 0 && pair.tag.material() == 0) // mostly, and a quotient takes long
      return pair.weight;
    const Real ratio        = constants.fluid_density / constants.mean_density(tag, pair.tag);
    const bool has_openings = constants.is_full && !constants.is_closed;
    return pair.weight * (has_openings ? maximum(Real(1), ratio) : ratio);
  }


  /// The largest of them: that of the largest weight that a collision leaves, at the smallest mean
  /// density.
  template <int dim, class Real>
  Real
  largest_coefficient(const Constants<dim, Real> &constants)
  {
    const Real closest = constants.collision_distance / 2;
    return (constants.reach / closest - 1) * constants.fluid_density / constants.lightest_density;
  }


  /// The part of a sub-step of `dt` after which the fluid's volume is kept: all of it, in a full
  /// domain as far as its path is determined by the pressures [s].
  template <int dim, class Real>
  UNDINE_HOST_DEVICE
  Real
  projected_time(const Constants<dim, Real> &constants, const Real dt)
  {
    return constants.is_full ? constants.path_weight * dt : dt;
  }


  /// Fills the matrix of the pressure equation, its diagonal and that of the equation for the
  /// potentials of the virtual faces,
  ///     sum_j k_ij (L_i - L_j) = -sum_j a_ij of L = 0,
  /// with its right-hand side. Neighbours whose pressure is zero count in the diagonal; so does the
  /// missing part of the neighbourhood at a free surface, as air.
  template <int dim, class Real, class Entry>
  struct AssemblePressure
  {
    Constants<dim, Real>        constants;
    Neighbours<dim, Real>       neighbours;
    Neighbourhood<dim, Real>    neighbourhood;
    VirtualFaces<dim, Real>     faces;
    PressureMatrix<Real, Entry> matrix;
    Real                       *diagonal;
    Real                       *faces_diagonal; ///< nullptr: faces are left open
    StoredVector<dim, Real>    *gaps;           ///< right-hand side of the potentials
    const Motion<dim, Real>    *motions;
    Real                       *divergences; ///< of velocities, by faces without potentials [1/s]
    StepControl                *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      matrix.counts[i] = 0;
      diagonal[i]      = 1;
      divergences[i]   = 0;
      if (faces_diagonal != nullptr)
        {
          faces_diagonal[i] = 1;
          gaps[i]           = Vector<dim, Real>::zero();
        }
      if (neighbourhood.is_unknown[i])
        fill_row(i);
    }

  private:
    /// In a full domain no pressure is given, and only differences of pressures matter: this share
    /// of the diagonal, small as rounding, keeps the matrix positive all the same.
    static constexpr Real regularisation = sizeof(Real) == sizeof(float) ? Real(5e-7) : Real(1e-12);

    /// In a full domain rows of bodies have a source too, but only from the fluid.
    UNDINE_HOST_DEVICE
    bool
    is_left_to_elasticity(const Tag tag, const Tag other) const
    {
      return constants.is_full && tag.kind() == Kind::solid && other.kind() != Kind::fluid;
    }

    /// In a full domain walls in contact with walls only have no pressure, as dummies.
    UNDINE_HOST_DEVICE
    bool
    is_cut_off(const Tag tag, const StoredCorrection<dim, Real> &correction) const
    {
      return constants.is_full && !correction.has_unknown() && tag.material() != opening_material;
    }

    UNDINE_HOST_DEVICE
    void
    fill_row(const int i) const
    {
      const Tag  tag      = neighbours.places[i].tag;
      const auto M        = neighbourhood.corrections[i].matrix();
      const auto v        = motions[i].v;
      const bool closes   = faces_diagonal != nullptr;
      const Real coverage = closes && tag.is_free() ? neighbourhood.coverages[i] : Real(0);
      auto       gap      = Vector<dim, Real>::zero();
      int        count    = 0;
      Real       sum = 0, flow = 0;
      bool       reached = true, has_given = false;
      struct Other
      {
        StoredCorrection<dim, Real> M;
        Vector<dim, Real>           v;
      };
      const auto fetch = [&](const int j) {
        return Other{neighbourhood.corrections[j], motions[j].v};
      };
      neighbours.for_each(
        i, fetch, [&](const int j, const Pair<dim, Real> &pair, const Other &other) {
          const auto plain = (faces.factor * pair.weight_over_square()) * pair.r;
          if (pair.tag.kind() == Kind::dummy || is_cut_off(pair.tag, other.M))
            {
              flow += (other.v - v) * plain;
              return;
            }
          // In this order fewer registers are needed than with VirtualFaces::open().
          const auto open =
            (1 - coverage) * plain + (coverage / 2) * (M * plain + other.M.matrix() * plain);
          if (!is_left_to_elasticity(tag, pair.tag))
            flow += (other.v - v) * open;
          gap -= open;
          const Entry entry =
            Entry::of(j - i, pressure_coefficient(constants, tag, pair), matrix.scale);
          sum += entry.coefficient(matrix.scale);
          has_given = has_given || !other.M.has_unknown();
          if (!other.M.has_unknown())
            return;
          reached                                              = reached && Entry::can_reach(j - i);
          matrix.entries[list_slot(i, count, matrix.capacity)] = entry;
          ++count;
        });
      if (!reached)
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::matrix_indices));
      sum += constants.is_full ? regularisation * sum : air(i, tag);
      matrix.fill_last_group(i, count);
      diagonal[i]    = maximum(sum + compressibility(tag), Real(1e-6));
      divergences[i] = flow;
      if (closes)
        {
          faces_diagonal[i] = maximum(sum, Real(1e-6));
          gaps[i]           = coverage * gap;
        }
      neighbourhood.is_beside_given[i] = has_given ? 1 : 0;
    }

    UNDINE_HOST_DEVICE
    Real
    air(const int i, const Tag tag) const
    {
      if (tag.kind() == Kind::solid)
        return 0;
      return (1 - neighbourhood.coverages[i]) * constants.air *
             maximum(Real(0), constants.number_density - neighbourhood.densities[i]);
    }

    UNDINE_HOST_DEVICE
    Real
    compressibility(const Tag tag) const
    {
      const Real dt = static_cast<Real>(control->dt);
      return tag.material() > 0 ? Real(0)
                                : pressure_scale(constants) * constants.fluid_compressibility /
                                    (dt * projected_time(constants, dt));
    }
  };


  /// The right-hand side of the pressure equation, rho_f lambda n0 / (2 dim) s; runs after the
  /// potentials are known. In the fluid
  ///     s = -div v* / dt + gamma e / dt^2  [1/s^2]
  /// with the error e of the volume, Neighbourhood::fillings - 1 (P3b), or by one of the other
  /// sources that of the number density, (n* - n0) / (n0 dt^2), or a share of it; none in bodies:
  /// pressure takes them along as if they were fluid of another density, and elasticity keeps their
  /// volume.
  template <int dim, class Real, class Entry>
  struct MeasureSource
  {
    Constants<dim, Real>        constants;
    Neighbours<dim, Real>       neighbours;
    Neighbourhood<dim, Real>    neighbourhood;
    VirtualFaces<dim, Real>     faces;
    PressureMatrix<Real, Entry> matrix;
    const Motion<dim, Real>    *motions;
    Real                       *right_hand_side; ///< first the divergences of AssemblePressure
    Real                       *guess;           ///< of the pressures
    const StepControl          *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      const bool is_unknown = neighbourhood.is_unknown[i] != 0;
      const Tag  tag        = neighbours.places[i].tag;
      guess[i]              = is_unknown ? motions[i].pressure : Real(0);
      if (!is_unknown || (tag.kind() == Kind::solid && !constants.is_full))
        right_hand_side[i] = 0;
      else if (tag.kind() == Kind::solid)
        right_hand_side[i] = given_pressures(i, tag) -
                             pressure_scale(constants) / projected_time() * flow_at_surface(i, tag);
      else
        right_hand_side[i] =
          given_pressures(i, tag) +
          pressure_scale(constants) * fluid_source(i, tag, static_cast<Real>(control->dt));
    }

  private:
    UNDINE_HOST_DEVICE
    Real
    projected_time() const
    {
      return undine::particles::projected_time(constants, static_cast<Real>(control->dt));
    }

    /// The divergence at a particle of a body by faces to the fluid: of a
    /// difference of velocities at a body's surface one half is in the fluid's row and one half in
    /// the body's [1/s].
    UNDINE_HOST_DEVICE
    Real
    flow_at_surface(const int i, const Tag tag) const
    {
      const auto v   = motions[i].v;
      Real       sum = right_hand_side[i];
      if (faces.potentials == nullptr)
        return sum;
      const Vector<dim, Real> L = faces.potentials[i];
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        if (pair.tag.kind() == Kind::fluid)
          sum += pressure_coefficient(constants, tag, pair) *
                 ((motions[j].v - v) * (L - Vector<dim, Real>(faces.potentials[j])));
      });
      return sum;
    }

    /// What neighbours contribute whose pressure is given and not zero, sum k_ij P_j: what is
    /// behind openings, and bodies in one of the ways to couple them.
    UNDINE_HOST_DEVICE
    Real
    given_pressures(const int i, const Tag tag) const
    {
      const bool of_bodies = constants.coupling != Coupling::simultaneous;
      Real       sum       = 0;
      if (!of_bodies && (!constants.is_full || !neighbourhood.is_beside_given[i]))
        return sum;
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        if (of_bodies ? pair.tag.kind() == Kind::solid : pair.tag.material() == opening_material)
          sum += stored_coefficient(tag, pair) * motions[j].pressure;
      });
      return sum;
    }

    /// As it is on the diagonal of the matrix.
    UNDINE_HOST_DEVICE
    Real
    stored_coefficient(const Tag tag, const Pair<dim, Real> &pair) const
    {
      return Entry::of(0, pressure_coefficient(constants, tag, pair), matrix.scale)
        .coefficient(matrix.scale);
    }

    UNDINE_HOST_DEVICE
    Real
    fluid_source(const int i, const Tag tag, const Real dt) const
    {
      const Real error = neighbourhood.densities[i] / constants.number_density - 1;
      // The loss of volume that the pressure before has brought about is no error.
      const Real loss = constants.fluid_compressibility * motions[i].pressure;
      switch (constants.source)
        {
          case Source::density:
            return error / (dt * dt);
          case Source::relaxed:
            return constants.density_share * error / (dt * dt);
          default:
            return ((constants.is_full ? error_in_motion(dt)
                                       : share(dt) * (neighbourhood.fillings[i] - 1 -
                                                      constants.filling_growth * loss) +
                                           crowding(i, dt)) /
                      (dt * dt) +
                    loss / (dt * projected_time())) -
                   divergence(i, tag) / projected_time();
        }
    }

    /// In a full domain with openings: the volume of all the fluid is put right as fast as the
    /// fluid moves, a share density_share while the fastest goes a fifth of a spacing, so that what
    /// is at rest stays there.
    UNDINE_HOST_DEVICE
    Real
    error_in_motion(const Real dt) const
    {
      if (constants.is_closed)
        return 0;
      const Real way = static_cast<Real>(control->fastest) * dt / constants.spacing;
      return minimum(Real(1), 5 * way) * constants.density_share *
             static_cast<Real>(control->volume_error);
    }

    /// Where particles crowd, as between a body and a wall, much more of the error is removed at
    /// once, but in time, not by sub-steps: the shorter they are, the faster would what is pushed
    /// apart become, and the shorter the next one.
    UNDINE_HOST_DEVICE
    Real
    crowding(const int i, const Real dt) const
    {
      const Real excess = neighbourhood.densities[i] / constants.number_density - 1;
      const Real share  = constants.crowd_rate > 0
                            ? minimum(constants.crowd_share, constants.crowd_rate * dt)
                            : constants.crowd_share;
      return share * maximum(Real(0), excess - constants.crowd_excess);
    }

    /// gamma
    UNDINE_HOST_DEVICE
    Real
    share(const Real dt) const
    {
      return constants.relaxation_time > 0 ? minimum(Real(1), dt / constants.relaxation_time)
                                           : constants.density_share;
    }

    /// What a neighbour contributes to the divergence.
    struct Other
    {
      Vector<dim, Real> v, L;
    };

    struct Others
    {
      const Motion<dim, Real>       *motions;
      const StoredVector<dim, Real> *potentials;

      UNDINE_HOST_DEVICE
      Other
      operator[](const int j) const
      {
        return {motions[j].v, potentials[j]};
      }
    };

    /// By the same faces as the forces of pressures, as far as they close: at the free surface by
    /// those faces water at rest swirls with twice the energy. In a full domain walls use them,
    /// too: what leaves one row enters another.
    UNDINE_HOST_DEVICE
    Real
    divergence(const int i, const Tag tag) const
    {
      const Real coverage = neighbourhood.coverages[i];
      if (faces.potentials == nullptr || !(tag.is_free() || constants.is_full) || !(coverage > 0))
        return right_hand_side[i];
      Real         sum = 0;
      const Others others{motions, faces.potentials};
      const Other  own = others[i];
      matrix.template for_each_in_row<Other>(i, others, [&](const Entry entry, const Other &other) {
        sum += entry.coefficient(matrix.scale) * ((other.v - own.v) * (own.L - other.L));
      });
      if (neighbourhood.is_beside_given[i])
        sum += beside_given(i, tag, own);
      return right_hand_side[i] + coverage * sum;
    }

    /// The same for neighbours whose pressure is given, which have no entries.
    UNDINE_HOST_DEVICE
    Real
    beside_given(const int i, const Tag tag, const Other &own) const
    {
      Real sum = 0;
      neighbours.for_each(i, [&](const int j, const Pair<dim, Real> &pair) {
        const bool is_cut_off = constants.is_full && pair.tag.material() != opening_material;
        if (pair.tag.kind() == Kind::dummy || neighbourhood.is_unknown[j] || is_cut_off)
          return;
        sum += stored_coefficient(tag, pair) * ((motions[j].v - own.v) * own.L);
      });
      return sum;
    }
  };
} // namespace undine::particles

#endif
