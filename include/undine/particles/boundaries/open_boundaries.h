// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_boundaries_open_boundaries_h
#define undine_particles_boundaries_open_boundaries_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>

namespace undine::particles
{
  /// A plane through which fluid enters or leaves. Behind an inflow stand layers of particles that
  /// move with the velocity they shall have: a wall that pushes. One that crosses the plane becomes
  /// fluid, and another one is put at the end of its column. What crosses the plane of an outflow
  /// is parked. Parked particles have the last places in sorted order.
  template <int dim, class Real>
  struct OpenBoundary
  {
    int  axis;
    Real plane;     ///< [m]
    Real inward;    ///< +1 or -1: sign of the inward normal along the axis
    Real depth;     ///< of the layers behind an inflow [m]
    bool is_inflow; ///< else an outflow

    /// How far x is behind the plane, outside [m].
    UNDINE_HOST_DEVICE
    Real
    behind(const Vector<dim, Real> &x) const
    {
      return (plane - x[axis]) * inward;
    }
  };

  /// All of them; few.
  template <int dim, class Real>
  struct OpenBoundaries
  {
    static constexpr int    most = 2 * dim + 4;
    int                     n    = 0;
    OpenBoundary<dim, Real> boundaries[most];
  };

  /// Moves the layers of inflows, makes fluid of what crosses into the domain (P2b), and parks what
  /// leaves it. `crossed` is 1 for each particle that leaves a gap at the end of its column.
  template <int dim, class Real>
  struct CrossBoundaries
  {
    OpenBoundaries<dim, Real> open;
    Real                      spacing;
    Real                      part; ///< of the sub-step, until which layers move [1]
    Place<dim, Real>         *places;
    const Motion<dim, Real>  *motions;
    int                      *crossed;
    const StepControl        *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      crossed[i]             = 0;
      Place<dim, Real> place = places[i];
      if (control->done() || place.tag.is_parked())
        return;
      if (place.tag.material() == inflow_material)
        {
          place.x += part * static_cast<Real>(control->dt) * motions[i].v;
          const Real behind = distance_behind_inflow(place.x);
          crossed[i]        = behind < 0 ? 1 : 0;
          place.tag         = behind < 0
                                ? Tag::of(Kind::fluid, 0)
                                : Tag::of(behind < spacing ? Kind::wall : Kind::dummy, inflow_material);
        }
      else if (place.tag.kind() == Kind::fluid && has_left(place.x))
        place.tag = Tag::parked();
      places[i] = place;
    }

  private:
    /// To the nearest one.
    UNDINE_HOST_DEVICE
    Real
    distance_behind_inflow(const Vector<dim, Real> &x) const
    {
      Real distance = -1;
      for (int b = 0; b < open.n; ++b)
        if (open.boundaries[b].is_inflow)
          distance = maximum(distance, open.boundaries[b].behind(x));
      return distance;
    }

    UNDINE_HOST_DEVICE
    bool
    has_left(const Vector<dim, Real> &x) const
    {
      for (int b = 0; b < open.n; ++b)
        if (!open.boundaries[b].is_inflow && open.boundaries[b].behind(x) > 0)
          return true;
      return false;
    }
  };


  /// Puts a parked particle at the end of the column of each one that has crossed an inflow.
  template <int dim, class Real>
  struct RefillInflows
  {
    OpenBoundaries<dim, Real> open;
    int                       n;
    Place<dim, Real>         *places;
    Motion<dim, Real>        *motions;
    const int                *crossed;
    const int                *crossed_before; ///< their number before each particle
    const int                *first_parked;
    StepControl              *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (control->done() || !crossed[i])
        return;
      const int slot = *first_parked + crossed_before[i];
      if (slot >= n)
        {
          atomic_or(&control->failures, static_cast<unsigned int>(Failure::no_reserve));
          return;
        }
      Place<dim, Real> place    = places[i];
      const auto       boundary = open.boundaries[nearest_inflow(place.x)];
      place.x[boundary.axis] -= boundary.inward * boundary.depth;
      place.tag              = Tag::of(Kind::dummy, inflow_material);
      places[slot]           = place;
      motions[slot]          = motions[i];
      motions[slot].pressure = 0;
    }

  private:
    /// A sub-step moves by less than a spacing: the plane that a particle has just crossed is the
    /// nearest one behind it.
    UNDINE_HOST_DEVICE
    int
    nearest_inflow(const Vector<dim, Real> &x) const
    {
      int nearest = 0;
      for (int b = 1; b < open.n; ++b)
        if (open.boundaries[b].is_inflow &&
            (!open.boundaries[nearest].is_inflow ||
             open.boundaries[b].behind(x) > open.boundaries[nearest].behind(x)))
          nearest = b;
      return nearest;
    }
  };
} // namespace undine::particles

#endif
