// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/body_forces.h>

#include <array>

namespace undine
{
  namespace
  {
    const char *const axis_names[3] = {"x", "y", "z"};
  } // namespace


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  sums_over_bodies(const Surface<dim> &surface, const std::vector<dealii::Tensor<1, dim>> &values)
  {
    constexpr auto            none = static_cast<unsigned int>(-1);
    std::vector<unsigned int> body_of_node(surface.n_nodes(), none);
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (const unsigned int node : surface.facets()[facet])
        body_of_node[node] = surface.body(facet);
    std::vector<dealii::Tensor<1, dim>> result(surface.body_names().size());
    for (unsigned int node = 0; node < body_of_node.size(); ++node)
      if (body_of_node[node] != none)
        result[body_of_node[node]] += values[node];
    return result;
  }


  template <int dim>
  Columns
  body_columns(const std::string                         &name,
               const std::string                         &unit,
               const Surface<dim>                        &surface,
               const std::vector<dealii::Tensor<1, dim>> &values)
  {
    Columns columns;
    for (unsigned int body = 0; body < values.size(); ++body)
      for (unsigned int axis = 0; axis < dim; ++axis)
        columns.push_back({name + " " + surface.body_names()[body] + " " + axis_names[axis],
                           unit,
                           values[body][axis]});
    return columns;
  }


  template <int dim>
  Columns
  pressure_force_columns(const Surface<dim> &surface, const PressureForces<dim> &forces)
  {
    Columns    columns;
    const auto add = [&](const std::string &name, const auto &sums) {
      for (const auto &column : body_columns(name, "N", surface, sums))
        columns.push_back(column);
    };
    const auto reduced = sums_over_bodies(surface, forces.reduced);
    if (forces.gravity.empty())
      add("pressure force", reduced);
    else
      {
        const auto gravity = sums_over_bodies(surface, forces.gravity);
        auto       total   = reduced;
        for (unsigned int body = 0; body < total.size(); ++body)
          total[body] += gravity[body];
        add("pressure force", total);
        add("reduced pressure force", reduced);
        add("gravity load", gravity);
      }
    return columns;
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template std::vector<dealii::Tensor<1, dim>> sums_over_bodies(                                   \
    const Surface<dim> &, const std::vector<dealii::Tensor<1, dim>> &);                            \
  template Columns body_columns(const std::string &,                                               \
                                const std::string &,                                               \
                                const Surface<dim> &,                                              \
                                const std::vector<dealii::Tensor<1, dim>> &);                      \
  template Columns pressure_force_columns(const Surface<dim> &, const PressureForces<dim> &);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
