// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/rigid_motions.h>

namespace undine
{
  template <int dim>
  Epetra_MultiVector
  rigid_motions(const SolidModel<dim>                       &model,
                const dealii::TrilinosWrappers::MPI::Vector &displacement)
  {
    const unsigned int n_rotations = dim * (dim - 1) / 2;
    Epetra_MultiVector result(displacement.trilinos_partitioner(), dim + n_rotations);
    const auto        &owned = model.locally_owned();
    for (unsigned int row = 0; row < owned.n_elements(); ++row)
      {
        const auto dof = owned.nth_index_in_set(row);
        if (model.all_fixed().is_element(dof))
          continue;
        // The degrees of freedom of one node follow each other.
        const unsigned int axis     = model.axis(dof);
        auto               position = model.rest_position(dof);
        for (unsigned int other = 0; other < dim; ++other)
          position[other] += displacement(dof - axis + other);

        result[axis][row]     = 1;
        unsigned int rotation = dim;
        for (unsigned int first = 0; first < dim; ++first)
          for (unsigned int second = first + 1; second < dim; ++second, ++rotation)
            {
              if (axis == first)
                result[rotation][row] = -position[second];
              if (axis == second)
                result[rotation][row] = position[first];
            }
      }
    return result;
  }


  template Epetra_MultiVector
  rigid_motions(const SolidModel<2> &, const dealii::TrilinosWrappers::MPI::Vector &);
  template Epetra_MultiVector
  rigid_motions(const SolidModel<3> &, const dealii::TrilinosWrappers::MPI::Vector &);
} // namespace undine
