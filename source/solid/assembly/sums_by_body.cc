// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/sums_by_body.h>

namespace undine
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  sums_by_body(const SolidModel<dim> &model, const dealii::TrilinosWrappers::MPI::Vector &nodal)
  {
    const auto                         &geometry = model.geometry();
    const auto                         &owned    = model.locally_owned();
    std::vector<dealii::Tensor<1, dim>> result(model.bodies().size());
    std::vector<bool>                   is_counted(owned.n_elements());
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const auto dof : geometry.dofs(cell))
        if (owned.is_element(dof) && !is_counted[owned.index_within_set(dof)])
          {
            is_counted[owned.index_within_set(dof)] = true;
            result[geometry.body(cell)][model.axis(dof)] += nodal(dof);
          }
    for (auto &sum : result)
      sum = dealii::Utilities::MPI::sum(sum, model.communicator());
    return result;
  }


  template std::vector<dealii::Tensor<1, 2>>
  sums_by_body(const SolidModel<2> &, const dealii::TrilinosWrappers::MPI::Vector &);
  template std::vector<dealii::Tensor<1, 3>>
  sums_by_body(const SolidModel<3> &, const dealii::TrilinosWrappers::MPI::Vector &);
} // namespace undine
