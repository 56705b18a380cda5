// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_outside_domain_h
#define undine_coupled_step_outside_domain_h

#include <undine/coupled/model/models.h>

#include <string>
#include <vector>

namespace undine
{
  /// A note of the bodies and obstacles with nodes at `places` [m] that are nowhere in the domain,
  /// where no fluid meets them; empty if there are none.
  template <int dim>
  std::string
  note_of_what_is_outside(const Models<dim> &models, const std::vector<dealii::Point<dim>> &places);
} // namespace undine

#endif
