// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_scheme_carried_scalars_h
#define undine_coupled_scheme_carried_scalars_h

#include <undine/base/core/column.h>
#include <undine/base/core/timing.h>
#include <undine/coupled/model/models.h>

#include <string>
#include <vector>

namespace undine
{
  /// Scalar fields that particles of fluid carry, in ParticleState::scalars. A particle keeps its
  /// value, apart from a source; so passes over particles need not know it.
  template <int dim>
  class CarriedScalars
  {
  public:
    CarriedScalars(const Effects<dim> &effects, const ParticleModel<dim> &model);

    bool
    empty() const
    {
      return fields.empty();
    }

    /// In a frame that is no longer, nothing crosses an inflow but what stood behind it at the
    /// start of the frame [s].
    double
    longest_frame() const;

    /// Give the particles their values at the start. Throws InputError if one is not a number.
    void
    start(particles::ParticleState<dim> &state) const;

    /// Give the particles at the end of a frame of `length` [s] that began at `time` [s] what they
    /// had `before`, and those that have come in the value where and when they did. Throws
    /// SolveError if one is not a number.
    void
    follow(particles::ParticleState<dim>       &after,
           const particles::ParticleState<dim> &before,
           double                               time,
           double                               length,
           TimingTree                          &timing) const;

    /// The integral of each field over the fluid.
    Columns
    columns(const particles::ParticleState<dim> &state) const;

  private:
    using Field = typename Effect<dim>::CarriedScalar;

    /// Where and when a particle came into the domain.
    struct Entry
    {
      dealii::Point<dim> place; ///< [m]
      double             time;  ///< [s]
    };

    /// Of one that stood at a place behind an inflow, with a velocity, at `time`. Returns false if
    /// there is no such inflow.
    bool
    find_entry(Entry                                &entry,
               const particles::Vector<dim, double> &place,
               const particles::Vector<dim, double> &velocity,
               double                                time,
               double                                length) const;

    std::vector<Field>        fields;
    std::string               phase; ///< of the timing, by the effect
    const ParticleModel<dim> &model;
  };
} // namespace undine

#endif
