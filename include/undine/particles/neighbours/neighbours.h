// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_neighbours_neighbours_h
#define undine_particles_neighbours_neighbours_h

#include <undine/particles/model/cell_grid.h>
#include <undine/particles/model/particle.h>

namespace undine::particles
{
  /// Where the k-th entry of row i of a list with `capacity` entries a row lies: rows in groups of
  /// 32, which the device reads together, entries of a group next to each other.
  UNDINE_HOST_DEVICE
  std::size_t
  list_slot(const int i, const int k, const int capacity)
  {
    return (static_cast<std::size_t>(i >> 5) * capacity + k) * 32 + (i & 31);
  }

  /// One neighbour j of a particle i.
  template <int dim, class Real>
  struct Pair
  {
    Vector<dim, Real> r;                ///< x_j - x_i [m]
    Real              square;           ///< |r|^2 [m^2]
    Real              inverse_distance; ///< 1 / |r| [1/m]
    Real              weight;           ///< w = r_e / |r| - 1 [1]
    Tag               tag;              ///< of j

    /// w / |r|^2 [1/m^2]
    UNDINE_HOST_DEVICE
    Real
    weight_over_square() const
    {
      return weight * inverse_distance * inverse_distance;
    }
  };

  /// The list of neighbours within the reach, as it was when the list was made.
  template <int dim, class Real>
  struct Neighbours
  {
    CellGrid<dim, Real>     grid;
    Real                    reach; ///< r_e [m]
    int                     capacity;
    const Place<dim, Real> *places;
    const int              *counts;
    const int              *indices;

    /// Call f(j, pair) for all neighbours of i at present places.
    template <class Function>
    UNDINE_HOST_DEVICE
    void
    for_each(const int i, const Function &f) const
    {
      for_each(
        i,
        [](const int) { return 0; },
        [&](const int j, const Pair<dim, Real> &pair, const int) { f(j, pair); });
    }

    /// Call f(j, pair, fetch(j)): what it needs to know of them is on the way together.
    template <class Fetch, class Function>
    UNDINE_HOST_DEVICE
    void
    for_each(const int i, const Fetch &fetch, const Function &f) const
    {
      using More = decltype(fetch(0));
      // So many are on the way at the same time; more would take the registers of other threads.
      constexpr int           together = sizeof(More) > 16 ? 2 : 4;
      const Vector<dim, Real> x        = places[i].x;
      const int               count    = counts[i];
      const bool              wraps    = grid.is_beside_periodic_side(x, Real(1.01) * reach);
      int                     first    = 0;
      for (; first + together <= count; first += together)
        {
          int              j[together];
          Place<dim, Real> other[together];
          More             more[together];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            j[k] = indices[list_slot(i, first + k, capacity)];
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            {
              other[k] = places[j[k]];
              more[k]  = fetch(j[k]);
            }
          UNDINE_UNROLL
          for (int k = 0; k < together; ++k)
            call(f, x, wraps, j[k], other[k], more[k]);
        }
      for (; first < count; ++first)
        {
          const int j = indices[list_slot(i, first, capacity)];
          call(f, x, wraps, j, places[j], fetch(j));
        }
    }

  private:
    template <class Function, class More>
    UNDINE_HOST_DEVICE
    void
    call(const Function          &f,
         const Vector<dim, Real> &x,
         const bool               wraps,
         const int                j,
         const Place<dim, Real>  &other,
         const More              &more) const
    {
      Pair<dim, Real> pair;
      pair.r                = wraps ? grid.difference(other.x, x) : other.x - x;
      pair.square           = norm_square(pair.r) + Real(1e-12) * reach * reach;
      pair.inverse_distance = inverse_square_root(pair.square);
      pair.weight           = reach * pair.inverse_distance - 1;
      pair.tag              = other.tag;
      if (pair.weight > 0)
        f(j, pair, more);
    }
  };
} // namespace undine::particles

#endif
