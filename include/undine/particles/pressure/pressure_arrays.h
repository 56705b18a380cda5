// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_pressure_arrays_h
#define undine_particles_pressure_pressure_arrays_h

#include <undine/particles/execution/buffer.h>
#include <undine/particles/neighbours/neighbour_list.h>
#include <undine/particles/pressure/assemble_pressure.h>

namespace undine::particles
{
  /// The memory of the pressure equation, of the equation for the faces' potentials and of what
  /// both are assembled from.
  template <class Executor, int dim, class Real, class Entry>
  struct PressureArrays
  {
    static constexpr int capacity = NeighbourList<Executor, dim, Real>::capacity;

    PressureArrays(const Executor &executor, const int n, const int n_solid)
      : n(n)
      , densities(executor, n)
      , fillings(executor, n)
      , is_unknown(executor, n)
      , coverages(executor, n)
      , is_beside_given(executor, n)
      , corrections(executor, n)
      , inward_directions(executor, n_solid > 0 ? n : 0)
      , counts(executor, n)
      , entries(executor, list_slot((n + 31) / 32 * 32, 0, capacity))
      , diagonal(executor, n)
      , right_hand_side(executor, n)
      , pressures(executor, n)
      , faces_diagonal(executor, n)
      , gaps(executor, n)
      , numbers(executor, 5 * n)
      , vectors(executor, 5 * n)
    {
    }

    Neighbourhood<dim, Real>
    neighbourhood() const
    {
      return {densities.data(),
              fillings.data(),
              is_unknown.data(),
              coverages.data(),
              is_beside_given.data(),
              corrections.data(),
              ways()};
    }

    /// nullptr without bodies
    StoredVector<dim, Real> *
    ways() const
    {
      return inward_directions.size() > 0 ? inward_directions.data() : nullptr;
    }

    /// `scale` is the largest coefficient.
    PressureMatrix<Real, Entry>
    matrix(const Real scale) const
    {
      return {n, capacity, scale, counts.data(), entries.data()};
    }

    int n;

    Buffer<Executor, Real>                        densities, fillings;
    Buffer<Executor, int>                         is_unknown;
    Buffer<Executor, Real>                        coverages;
    Buffer<Executor, unsigned char>               is_beside_given;
    Buffer<Executor, StoredCorrection<dim, Real>> corrections;
    Buffer<Executor, StoredVector<dim, Real>>     inward_directions;
    Buffer<Executor, int>                         counts;
    Buffer<Executor, Entry>                       entries;
    Buffer<Executor, Real>                    diagonal, right_hand_side, pressures, faces_diagonal;
    Buffer<Executor, StoredVector<dim, Real>> gaps;
    Buffer<Executor, Real>                    numbers; ///< of the pressure solver
    Buffer<Executor, StoredVector<dim, Real>> vectors; ///< of the faces' solver
  };
} // namespace undine::particles

#endif
