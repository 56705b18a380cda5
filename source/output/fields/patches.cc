// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/patches.h>

namespace undine
{
  template <int dim, int spacedim>
  void
  Patches<dim, spacedim>::add_scalar(const std::string &field, const std::string &unit)
  {
    components.push_back(field);
    units[field] = unit;
  }


  template <int dim, int spacedim>
  void
  Patches<dim, spacedim>::add_vector(const std::string &field, const std::string &unit)
  {
    const unsigned int first = components.size();
    vectors.emplace_back(first,
                         first + spacedim - 1,
                         field,
                         dealii::DataComponentInterpretation::component_is_part_of_vector);
    for (unsigned int axis = 0; axis < spacedim; ++axis)
      components.push_back(field + "_" + char('x' + axis));
    units[field] = unit;
  }


  template struct Patches<0, 2>;
  template struct Patches<0, 3>;
  template struct Patches<1, 2>;
  template struct Patches<2, 3>;
  template struct Patches<2>;
  template struct Patches<3>;
} // namespace undine
