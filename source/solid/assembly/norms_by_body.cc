// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/norms_by_body.h>

#include <cmath>

namespace undine
{
  template <int dim>
  NormsByBody<dim>::NormsByBody(const SolidModel<dim> &model)
    : communicator(model.communicator())
    , n_bodies(model.bodies().size())
  {
    if (n_bodies == 1)
      return;
    const auto &geometry = model.geometry();
    const auto &owned    = model.locally_owned();
    body_of.resize(owned.n_elements());
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      for (const auto dof : geometry.dofs(cell))
        if (owned.is_element(dof))
          body_of[owned.index_within_set(dof)] = geometry.body(cell);
  }


  template <int dim>
  std::vector<double>
  NormsByBody<dim>::operator()(const Vector &nodal) const
  {
    if (n_bodies == 1)
      return {nodal.l2_norm()};
    std::vector<double> result(n_bodies, 0.);
    const double       *value = nodal.begin();
    for (const unsigned int body : body_of)
      {
        result[body] += *value * *value;
        ++value;
      }
    dealii::Utilities::MPI::sum(result, communicator, result);
    for (double &norm : result)
      norm = std::sqrt(norm);
    return result;
  }


  template class NormsByBody<2>;
  template class NormsByBody<3>;
} // namespace undine
