// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/mass_matrix.h>

#include <deal.II/lac/full_matrix.h>

namespace undine
{
  template <int dim>
  dealii::TrilinosWrappers::SparseMatrix
  mass_matrix(const SolidModel<dim> &model)
  {
    const auto                &geometry = model.geometry();
    const unsigned int         n_nodes  = geometry.n_nodes();
    dealii::FullMatrix<double> local(n_nodes * dim);
    auto                       result = model.matrix();
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        const double density = model.bodies()[geometry.body(cell)].density;
        for (unsigned int i = 0; i < n_nodes; ++i)
          for (unsigned int j = 0; j < n_nodes; ++j)
            {
              double sum = 0;
              for (unsigned int q = 0; q < geometry.n_points(); ++q)
                sum += geometry.shape(i, q) * geometry.shape(j, q) * geometry.JxW(cell, q);
              for (unsigned int axis = 0; axis < dim; ++axis)
                local(i * dim + axis, j * dim + axis) = density * sum;
            }
        result.add(geometry.dofs(cell), local);
      }
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template dealii::TrilinosWrappers::SparseMatrix
  mass_matrix(const SolidModel<2> &);
  template dealii::TrilinosWrappers::SparseMatrix
  mass_matrix(const SolidModel<3> &);
} // namespace undine
