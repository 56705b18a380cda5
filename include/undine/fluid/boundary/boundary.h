// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_boundary_boundary_h
#define undine_fluid_boundary_boundary_h

#include <undine/base/options/expression.h>
#include <undine/base/options/options.h>

#include <array>
#include <string>
#include <vector>

namespace undine
{
  /// One of the 2 dim sides of the domain.
  struct Side
  {
    unsigned int axis; ///< normal to the side
    unsigned int end;  ///< 0 at the lower, 1 at the upper end of the axis

    /// Position in side_names().
    unsigned int
    number() const
    {
      return 2 * axis + end;
    }

    /// Component of the outward normal along the axis.
    int
    sign() const
    {
      return end == 0 ? -1 : 1;
    }
  };

  /// "left", "right", "bottom", "top", "back", "front": ends of x, y and z, lower end first.
  const std::vector<std::string> &
  side_names();

  /// The side of a name that is in side_names().
  Side
  side_by_name(const std::string &name);

  /// What the fluid does at a boundary. v is the velocity, n the outward normal.
  enum class BoundaryKind
  {
    slip_wall,    ///< v.n = 0, no friction
    no_slip_wall, ///< v = 0
    moving_wall,  ///< v.n = 0, tangential velocity given
    inflow,       ///< v given
    pressure,     ///< reduced pressure given; what comes in comes in normal to the boundary
    outflow,      ///< pressure P given; where the flow turns back, p = P - rho (v.n)^2 / 2
    periodic      ///< goes on at the opposite side
  };

  /// A named part of the domain's boundary.
  template <int dim>
  struct Boundary
  {
    std::string          name;
    BoundaryKind         kind = BoundaryKind::slip_wall;
    std::vector<Side>    sides;
    Expression<dim>      region;   ///< faces whose centre has a value > 0
    Expression<dim, dim> velocity; ///< of inflow and moving wall [m/s]
    Expression<dim>      pressure; ///< reduced pressure; of outflows that outside [Pa]
    bool                 has_region = false;

    /// The normal velocity on the faces is given: walls and inflow.
    bool
    prescribes_normal_velocity() const;

    /// The tangential velocity on the boundary is given: walls to which fluid sticks, and inflow.
    bool
    prescribes_tangential_velocity() const;

    /// The pressure on the faces is given: pressure and outflow.
    bool
    is_open() const;

    /// Fluid crosses it: inflow, pressure and outflow.
    bool
    lets_fluid_pass() const;

    /// A wall that viscous fluid does not slip along freely; so far all of them hold its tangential
    /// velocity.
    bool
    has_friction() const;

    /// The given velocity along `axis` [m/s] on a face or boundary point of a side normal to
    /// `normal_axis`; zero if none is given.
    double
    velocity_along(const unsigned int        axis,
                   const unsigned int        normal_axis,
                   const dealii::Point<dim> &place,
                   const double              time) const;
  };

  /// Read the subsections of `Boundaries`, in the order of the file. Throws InputError.
  template <int dim>
  std::vector<Boundary<dim>>
  read_boundaries(const Options &boundaries);

  /// Along which axes the domain is periodic.
  template <int dim>
  std::array<bool, dim>
  periodic_axes(const std::vector<Boundary<dim>> &boundaries);
} // namespace undine

#endif
