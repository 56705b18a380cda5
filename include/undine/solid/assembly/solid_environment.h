// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_solid_environment_h
#define undine_solid_assembly_solid_environment_h

#include <undine/base/options/expression.h>
#include <undine/solid/assembly/contact_settings.h>
#include <undine/solid/assembly/sleep_settings.h>

#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace undine
{
  template <int dim>
  class Contact;

  template <int dim>
  struct SolidMeasures;


  /// A force on a body that an effect calls for, as a function of the place at rest and the time.
  template <int dim>
  struct VolumeForce
  {
    std::string          effect;       ///< its name
    std::string          body;         ///< its name
    Expression<dim, dim> acceleration; ///< [m/s^2]
    Expression<dim, dim> per_volume;   ///< at rest, besides [N/m^3]
  };

  /// The effects of a scene on its bodies.
  template <int dim>
  struct SolidEnvironment
  {
    dealii::Tensor<1, dim>        gravity;               ///< uniform acceleration [m/s^2]
    double                        mass_damping      = 0; ///< alpha, C = alpha M + eta V [1/s]
    double                        stiffness_damping = 0; ///< eta, C = alpha M + eta V [s]
    std::vector<VolumeForce<dim>> forces;                ///< in order of their effects

    std::optional<ContactSettings<dim>> contact_settings; ///< none: no contact
    std::shared_ptr<const Contact<dim>> contact;          ///< by these settings, for this scene

    std::optional<SleepSettings> sleep_settings; ///< none: bodies do not sleep

    /// Measures of the bodies that sleep, which count in `statistics` and nowhere else; nullptr:
    /// none sleep.
    std::shared_ptr<const SolidMeasures<dim>> asleep;
  };
} // namespace undine

#endif
