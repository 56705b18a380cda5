// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_body_h
#define undine_solid_mesh_body_h

#include <undine/base/options/options.h>
#include <undine/solid/material/kinematics.h>
#include <undine/solid/material/material.h>
#include <undine/solid/mesh/body_boundary.h>
#include <undine/solid/mesh/body_shape.h>

#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// One deformable body as a scene describes it, in a subsection of `Bodies` that bears its name.
  template <int dim>
  struct Body
  {
    /// Read the keys of the section `name`.
    Body(const std::string &name, const Options &options);

    std::string                      name;
    Options                          options; ///< for messages about this section
    std::unique_ptr<BodyShape<dim>>  shape;
    Expression<dim, dim>             map; ///< rest position of a vertex of the shape [m]
    bool                             has_map     = false;
    unsigned int                     refinements = 0;
    double                           density     = 0; ///< at rest [kg/m^3]
    std::unique_ptr<Material>        material;
    std::unique_ptr<Kinematics<dim>> kinematics;
    Expression<dim, dim>             load;         ///< dead load per rest volume [N/m^3]
    Expression<dim, dim>             displacement; ///< at t = 0 [m]
    Expression<dim, dim>             velocity;     ///< at t = 0 [m/s]
    std::vector<BodyBoundary<dim>>   boundaries;   ///< in order of appearance
  };

  /// The bodies of the section `Bodies`, in order of appearance. Throws InputError.
  template <int dim>
  std::vector<Body<dim>>
  read_bodies(const Options &bodies);
} // namespace undine

#endif
