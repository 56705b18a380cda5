// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_sparse_h
#define undine_solid_assembly_sparse_h

#include <deal.II/base/index_set.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace undine
{
  /// Have A and B the same entries, on all ranks? Collective.
  bool
  same_pattern(const dealii::TrilinosWrappers::SparseMatrix &A,
               const dealii::TrilinosWrappers::SparseMatrix &B);

  /// The locally owned entries of A, by global numbers.
  void
  add_entries(dealii::DynamicSparsityPattern               &pattern,
              const dealii::TrilinosWrappers::SparseMatrix &A);

  /// Where the locally owned entries of A are among those of `larger`, which has all of A's: local
  /// numbers [entries of A].
  std::vector<int>
  places_of_entries(const dealii::TrilinosWrappers::SparseMatrix &A,
                    const dealii::TrilinosWrappers::SparseMatrix &larger);

  /// A gets the pattern of `larger` and keeps its values; `places` are places_of_entries(A,
  /// larger).
  void
  enlarge(dealii::TrilinosWrappers::SparseMatrix       &A,
          const dealii::TrilinosWrappers::SparseMatrix &larger,
          const std::vector<int>                       &places);

  /// Replace rows and columns of the `fixed` degrees of freedom, given for all ranks, by those of
  /// the identity times the mean size of A's diagonal. Collective.
  void
  fix_rows_and_columns(dealii::TrilinosWrappers::SparseMatrix &A, const dealii::IndexSet &fixed);
} // namespace undine

#endif
