// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_contact_settings_h
#define undine_solid_assembly_contact_settings_h

#include <undine/base/options/options.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace undine
{
  /// A plane that bodies do not cross.
  template <int dim>
  struct ContactWall
  {
    std::string            name;
    dealii::Point<dim>     point;  ///< of the plane [m]
    dealii::Tensor<1, dim> normal; ///< of length 1, to where bodies may be
  };

  /// The settings of a scene for contact.
  template <int dim>
  struct ContactSettings
  {
    Options options;                         ///< for messages about the section
    double  activation_distance         = 0; ///< D, below which contact acts [m]; 0: by the mesh
    double  stiffness                   = 0; ///< [Pa]; 0: by the softest body
    std::vector<ContactWall<dim>> walls = {};
    bool                          at_domain = true; ///< walls of the fluid's domain count too
  };
} // namespace undine

#endif
