// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_solid_environment_h
#define undine_solid_solid_environment_h

#include <undine/solid/contact_settings.h>

#include <deal.II/base/tensor.h>

#include <memory>
#include <optional>

namespace undine
{
  template <int dim>
  class Contact;

  /// What the effects that a scene calls for do to its bodies.
  template <int dim>
  struct SolidEnvironment
  {
    dealii::Tensor<1, dim> gravity;               ///< uniform acceleration [m/s^2]
    double                 mass_damping      = 0; ///< alpha in C = alpha M + eta K'(d^n) [1/s]
    double                 stiffness_damping = 0; ///< eta in C = alpha M + eta K'(d^n) [s]

    std::optional<ContactSettings<dim>> contact_settings; ///< none: bodies do not feel each other
    std::shared_ptr<const Contact<dim>> contact;          ///< by these settings, for this scene
  };
} // namespace undine

#endif
