// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_point_text_h
#define undine_base_options_point_text_h

#include <deal.II/base/point.h>

#include <fmt/format.h>

#include <string>

namespace undine
{
  /// A place [m] in messages: "(0.5, 1)", with six digits.
  template <int dim>
  std::string
  text_of(const dealii::Point<dim> &place)
  {
    return fmt::format("({:.6g})", fmt::join(place.begin_raw(), place.begin_raw() + dim, ", "));
  }
} // namespace undine

#endif
