// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_body_boundary_h
#define undine_solid_mesh_body_boundary_h

#include <undine/base/options/options.h>

#include <array>
#include <string>
#include <vector>

namespace undine
{
  /// A boundary condition on a part of a body's boundary. Where parts that fix a displacement meet,
  /// the one that the scene names first decides.
  template <int dim>
  struct BodyBoundary
  {
    /// Kinds of boundary conditions.
    enum class Kind
    {
      clamp,             ///< d = initial d
      prescribed_motion, ///< d = g(x, t)
      traction,          ///< dead load per rest area
      pressure           ///< follower load along the deformed normal, into the body
    };

    /// Read the keys of the section `name`.
    BodyBoundary(const std::string &name, const Options &options);

    /// True for clamp and prescribed_motion.
    bool
    fixes_displacement() const;

    std::string              name;
    Options                  options; ///< for messages about this section
    std::vector<std::string> sides;   ///< of the shape; empty: all
    Expression<dim>          where;   ///< faces whose rest centre has where > 0
    Kind                     kind = Kind::clamp;
    std::array<bool, dim>    directions; ///< which components of d are fixed
    Expression<dim, dim>     motion;     ///< g [m]
    Expression<dim, dim>     traction;   ///< [Pa], per rest area
    Expression<dim>          pressure;   ///< [Pa], per deformed area
  };
} // namespace undine

#endif
