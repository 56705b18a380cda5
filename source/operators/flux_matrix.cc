// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/flux_matrix.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace undine
{
  namespace
  {
    /// Call action(row, column, value) for all entries of the matrix in rows of this rank.
    template <int dim, class Action>
    void
    for_each_free_entry(const BoundaryFlux<dim>    &boundary_flux,
                        const CutTopology<dim>     &parts,
                        const PressureNumbers<dim> &numbers,
                        const ImmersedSurface<dim> &surface,
                        const SolidModel<dim>      &solid,
                        const Action               &action)
    {
      for (const auto &entry : boundary_flux.entries())
        {
          const int component = parts.open_components[entry.component];
          if (component < 0 || !surface.moves(entry.node))
            continue;
          const auto row = numbers.of_component(component);
          for (const auto &share : surface.bodies()->shares(entry.node))
            for (unsigned int axis = 0; axis < dim; ++axis)
              if (!solid.all_fixed().is_element(share.dofs[axis]))
                action(row, share.dofs[axis], share.weight * entry.value[axis]);
        }
    }
  } // namespace


  template <int dim>
  void
  build_flux_matrix(dealii::TrilinosWrappers::SparseMatrix &matrix,
                    const BoundaryFlux<dim>                &boundary_flux,
                    const CutTopology<dim>                 &parts,
                    const PressureNumbers<dim>             &numbers,
                    const ImmersedSurface<dim>             &surface,
                    const SolidModel<dim>                  &solid)
  {
    dealii::TrilinosWrappers::SparsityPattern pattern(
      numbers.owned(), solid.locally_owned(), solid.communicator());
    for_each_free_entry(
      boundary_flux,
      parts,
      numbers,
      surface,
      solid,
      [&](const auto row, const auto column, const double) { pattern.add(row, column); });
    pattern.compress();
    matrix.reinit(pattern);
    for_each_free_entry(boundary_flux,
                        parts,
                        numbers,
                        surface,
                        solid,
                        [&](const auto row, const auto column, const double value) {
                          matrix.add(row, column, value);
                        });
    matrix.compress(dealii::VectorOperation::add);
  }


  std::vector<dealii::types::global_dof_index>
  filled_rows(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    std::vector<dealii::types::global_dof_index> result;
    for (const auto row : matrix.locally_owned_range_indices())
      if (matrix.row_length(row) > 0)
        result.push_back(row);
    return result;
  }


  template void
  build_flux_matrix(dealii::TrilinosWrappers::SparseMatrix &,
                    const BoundaryFlux<2> &,
                    const CutTopology<2> &,
                    const PressureNumbers<2> &,
                    const ImmersedSurface<2> &,
                    const SolidModel<2> &);
  template void
  build_flux_matrix(dealii::TrilinosWrappers::SparseMatrix &,
                    const BoundaryFlux<3> &,
                    const CutTopology<3> &,
                    const PressureNumbers<3> &,
                    const ImmersedSurface<3> &,
                    const SolidModel<3> &);
} // namespace undine
