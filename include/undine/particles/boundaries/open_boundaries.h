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
  /// fluid, and another one is put at the end of its column. Behind an opening of a full domain are
  /// layers that go along with the fluid before them, in and out, and have a pressure
  /// (DriveOpenings): what leaves becomes a part of them and is parked where they end. What crosses
  /// the plane of an outflow is parked at once. Parked particles have the last places in sorted
  /// order.
  template <int dim, class Real>
  struct OpenBoundary
  {
    int  axis;
    Real plane;  ///< [m]
    Real inward; ///< +1 or -1: sign of the inward normal along the axis
    Real depth;  ///< of the layers behind an inflow or opening [m]
    bool is_inflow;
    bool is_opening;       ///< else an outflow
    Real pressure;         ///< of an opening [Pa]
    bool enters_from_rest; ///< as in OpenSide

    UNDINE_HOST_DEVICE
    bool
    has_layers() const
    {
      return is_inflow || is_opening;
    }

    /// Are layers of this material behind it?
    UNDINE_HOST_DEVICE
    bool
    has_layers_of(const int material) const
    {
      return (is_inflow && material == inflow_material) ||
             (is_opening && material == opening_material);
    }

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

    /// Of those with layers of a material the one that x is farthest behind, or nearest to if it is
    /// before all of them; n if there is none. A sub-step moves by less than a spacing: for what is
    /// in layers, or has just crossed their plane, it is its own.
    UNDINE_HOST_DEVICE
    int
    of_layers(const int material, const Vector<dim, Real> &x) const
    {
      int result = n;
      for (int b = 0; b < n; ++b)
        if (boundaries[b].has_layers_of(material) &&
            (result == n || boundaries[b].behind(x) > boundaries[result].behind(x)))
          result = b;
      return result;
    }

    /// The opening that fluid at x has left through; n: none.
    UNDINE_HOST_DEVICE
    int
    opening_before(const Vector<dim, Real> &x) const
    {
      const int b = of_layers(opening_material, x);
      return b < n && boundaries[b].behind(x) > 0 ? b : n;
    }
  };

  /// Moves the layers of inflows and openings, makes fluid of what crosses into the domain (P2b),
  /// and parks what leaves it or makes it a part of layers. `crossed` is 1 for each particle that
  /// leaves a gap at the end of its column.
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
      if (place.tag.is_in_layers())
        {
          place.x += part * static_cast<Real>(control->dt) * motions[i].v;
          const int  material = place.tag.material();
          const auto boundary = open.boundaries[open.of_layers(material, place.x)];
          const Real behind   = boundary.behind(place.x);
          crossed[i]          = behind < 0 ? 1 : 0;
          place.tag           = behind < 0 ? Tag::of(Kind::fluid, 0)
                                : behind > boundary.depth
                                  ? Tag::parked()
                                  : Tag::of(kind_in_layers(material, behind), material);
        }
      else if (place.tag.kind() == Kind::fluid && open.opening_before(place.x) < open.n)
        place.tag = Tag::of(Kind::wall, opening_material);
      else if (place.tag.kind() == Kind::fluid && has_left(place.x))
        place.tag = Tag::parked();
      places[i] = place;
    }

  private:
    UNDINE_HOST_DEVICE
    Kind
    kind_in_layers(const int material, const Real behind) const
    {
      return material == opening_material || behind < spacing ? Kind::wall : Kind::dummy;
    }

    UNDINE_HOST_DEVICE
    bool
    has_left(const Vector<dim, Real> &x) const
    {
      for (int b = 0; b < open.n; ++b)
        if (!open.boundaries[b].has_layers() && open.boundaries[b].behind(x) > 0)
          return true;
      return false;
    }
  };


  /// Puts a parked particle at the end of the column of each one that has come out of layers.
  template <int dim, class Real>
  struct RefillLayers
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
      const auto       boundary = open.boundaries[nearest(place.x)];
      place.x[boundary.axis] -= boundary.inward * boundary.depth;
      place.tag              = boundary.is_inflow ? Tag::of(Kind::dummy, inflow_material)
                                                  : Tag::of(Kind::wall, opening_material);
      places[slot]           = place;
      motions[slot]          = motions[i];
      motions[slot].pressure = 0;
    }

  private:
    /// A sub-step moves by less than a spacing: the plane that a particle has just crossed is the
    /// nearest one behind it.
    UNDINE_HOST_DEVICE
    int
    nearest(const Vector<dim, Real> &x) const
    {
      const int inflow  = open.of_layers(inflow_material, x);
      const int opening = open.of_layers(opening_material, x);
      if (inflow == open.n || opening == open.n)
        return minimum(inflow, opening);
      return open.boundaries[opening].behind(x) > open.boundaries[inflow].behind(x) ? opening
                                                                                    : inflow;
    }
  };
} // namespace undine::particles

#endif
