// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_fields_body_patches_h
#define undine_output_fields_body_patches_h

#include <undine/output/fields/patches.h>
#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_state.h>

namespace undine
{
  /// The configuration in which bodies are drawn.
  enum class Configuration
  {
    rest,
    deformed
  };

  /// The bodies: displacement [m], velocity [m/s], index of the body, and, averaged over each cell,
  /// the von Mises stress of the Cauchy stress [Pa] and the volume ratio det F [1]. Quadratic
  /// elements become patches of two subdivisions. Collective. Throws SolveError if a body is
  /// inverted.
  template <int dim>
  Patches<dim>
  body_patches(const SolidModel<dim> &model, const SolidState &state, Configuration configuration);

  /// The von Mises stress sqrt(3/2 dev(sigma):dev(sigma)) [Pa] of the Cauchy stress
  /// sigma = P F^T / det F at displacement gradient H. Volumetric parts of the law do not matter.
  template <int dim>
  double
  von_mises_stress(const Body<dim> &body, const dealii::Tensor<2, dim> &displacement_gradient);
} // namespace undine

#endif
