// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_boundary_condition_h
#define undine_fluid_boundary_boundary_condition_h

#include <undine/fluid/boundary/boundary_map.h>
#include <undine/fluid/grid/fluid_state.h>

namespace undine
{
  /// The boundary condition of a field that is advected and diffused: its value is prescribed, or
  /// its normal derivative vanishes. Where fluid enters through an opening, it brings a value with
  /// it.
  template <int dim>
  class BoundaryCondition
  {
  public:
    virtual ~BoundaryCondition() = default;

    /// Is the value of the field prescribed on `boundary`?
    virtual bool
    is_dirichlet(const Boundary<dim> &boundary) const = 0;

    /// The value, in the unit of the field, at a place [m] on such a boundary that is normal to
    /// `normal_axis`, at `time` [s].
    virtual double
    dirichlet_value(const Boundary<dim>      &boundary,
                    const unsigned int        normal_axis,
                    const dealii::Point<dim> &place,
                    const double              time) const = 0;

    /// The value of the fluid that enters through an opening at `place` [m].
    virtual double
    entering_value(const dealii::Point<dim> &place, const double time) const = 0;

    /// True if the flow never advects a value beyond those around it, so that an advection must not
    /// create new extrema. That costs accuracy at smooth ones.
    virtual bool
    obeys_maximum_principle() const = 0;

    /// Differences between neighbours that need not be advected, as a share of the field's range
    /// (UniformRegions); 0: all are.
    virtual double
    neglected_variation() const
    {
      return 0;
    }
  };

  /// The velocity along one axis, on sides parallel to that axis.
  template <int dim>
  class VelocityCondition : public BoundaryCondition<dim>
  {
  public:
    explicit VelocityCondition(const unsigned int axis);

    bool
    is_dirichlet(const Boundary<dim> &boundary) const override;

    double
    dirichlet_value(const Boundary<dim>      &boundary,
                    const unsigned int        normal_axis,
                    const dealii::Point<dim> &place,
                    const double              time) const override;

    /// Zero: fluid enters at right angles.
    double
    entering_value(const dealii::Point<dim> &place, const double time) const override;

    /// False: pressure changes the components of the velocity.
    bool
    obeys_maximum_principle() const override;

  private:
    unsigned int axis;
  };

  /// The pressure, which is given at openings.
  template <int dim>
  class PressureCondition : public BoundaryCondition<dim>
  {
  public:
    bool
    is_dirichlet(const Boundary<dim> &boundary) const override;

    double
    dirichlet_value(const Boundary<dim>      &boundary,
                    const unsigned int        normal_axis,
                    const dealii::Point<dim> &place,
                    const double              time) const override;

    /// Not asked for.
    double
    entering_value(const dealii::Point<dim> &place, const double time) const override;

    bool
    obeys_maximum_principle() const override;
  };

  /// Call `action(boundary, fraction, cell)` for the boundary faces around the boundary point
  /// `index` of a lattice on `side`, with the cell that touches the face; the fractions of the
  /// point's share add up to one. A tangential face has half of its share on either of two boundary
  /// faces.
  template <int dim, class Action>
  void
  for_each_boundary_around(const BoundaryMap<dim> &boundaries,
                           const Lattice<dim>     &lattice,
                           const Side              side,
                           const GridIndex<dim>   &index,
                           Action                &&action)
  {
    const auto     cells = boundaries.grid().cells_along();
    GridIndex<dim> cell  = index;
    for (unsigned int d = 0; d < dim; ++d)
      if (!boundaries.grid().periodic(d))
        cell[d] = std::clamp(cell[d], 0, cells[d] - 1);
    const unsigned int axis = lattice.normal_axis();
    if (axis == Lattice<dim>::no_axis || boundaries.grid().at_boundary(axis, index))
      {
        action(boundaries.at(side, cell), 1., cell);
        return;
      }
    const auto   before = moved<dim>(cell, axis, -1);
    const double above  = boundaries.grid().cell_width(axis, index[axis]) / 2;
    const double below  = boundaries.grid().cell_width(axis, index[axis] - 1) / 2;
    action(boundaries.at(side, before), below / (below + above), before);
    action(boundaries.at(side, cell), above / (below + above), cell);
  }

  /// What fluid that enters has at boundary points.
  template <int dim>
  struct Entering
  {
    double time; ///< the value at that time [s]
    /// And as much more as what is inside has come to in a duration at this rate, whose ghost
    /// layers are up to date; nullptr: none.
    const Field<dim> *rate     = nullptr;
    double            duration = 0; ///< [s]
  };

  /// How a field goes on to boundary points where nothing is prescribed and nothing enters.
  enum class Extension
  {
    constant, ///< it is as inside: no new extrema
    linear    ///< the straight line through the two last points, where both are whole
  };

  /// Give the stored boundary points of `field` their values at `time` [s]: prescribed, that of
  /// fluid which enters with the flow `velocity` (whose faces on the boundary must be stored
  /// there), or what is inside, gone on as `extension` says. The ghost layers of `field` must be up
  /// to date. Not collective. @{
  template <int dim>
  void
  fill_boundary_points(Field<dim>                   &field,
                       const BoundaryMap<dim>       &boundaries,
                       const BoundaryCondition<dim> &condition,
                       const Velocity<dim>          &velocity,
                       const double                  time,
                       const Entering<dim>          &entering,
                       Extension                     extension = Extension::constant);

  template <int dim>
  void
  fill_boundary_points(Field<dim>                   &field,
                       const BoundaryMap<dim>       &boundaries,
                       const BoundaryCondition<dim> &condition,
                       const Velocity<dim>          &velocity,
                       const double                  time)
  {
    fill_boundary_points(field, boundaries, condition, velocity, time, {time});
  }
  /// @}

  /// Set the owned faces and pieces on walls and inflows to their normal velocity at `time` [s].
  template <int dim>
  void
  set_boundary_velocity(Velocity<dim>          &velocity,
                        const BoundaryMap<dim> &boundaries,
                        const double            time);
} // namespace undine

#endif
