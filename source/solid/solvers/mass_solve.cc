// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/solvers/mass_solve.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/trilinos_precondition.h>

namespace undine
{
  template <int dim>
  dealii::TrilinosWrappers::MPI::Vector
  solve_mass(const SolidModel<dim>                        &model,
             const dealii::TrilinosWrappers::SparseMatrix &mass,
             const dealii::TrilinosWrappers::MPI::Vector  &forces,
             const dealii::TrilinosWrappers::MPI::Vector  &fixed)
  {
    auto result = model.vector();
    for (const auto &entry : model.fixed())
      result(entry.dof) = fixed(entry.dof);
    result.compress(dealii::VectorOperation::insert);

    auto right_side = model.vector();
    mass.vmult(right_side, result);
    right_side.sadd(-1., 1., forces);
    clear_fixed(right_side, model);

    auto matrix = model.matrix();
    matrix.add(1., mass);
    fix_rows_and_columns(matrix, model.all_fixed());
    dealii::TrilinosWrappers::PreconditionJacobi preconditioner;
    preconditioner.initialize(matrix);

    auto                  free = model.vector();
    dealii::SolverControl control(1000, 1e-13 * right_side.l2_norm());
    try
      {
        dealii::SolverCG<dealii::TrilinosWrappers::MPI::Vector>(control).solve(
          matrix, free, right_side, preconditioner);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        throw SolveError("the accelerations of the bodies cannot be found: the forces on them are "
                         "not numbers. Try smaller loads or a smaller step.");
      }
    result.add(1., free);
    return result;
  }


  template dealii::TrilinosWrappers::MPI::Vector
  solve_mass(const SolidModel<2> &,
             const dealii::TrilinosWrappers::SparseMatrix &,
             const dealii::TrilinosWrappers::MPI::Vector &,
             const dealii::TrilinosWrappers::MPI::Vector &);
  template dealii::TrilinosWrappers::MPI::Vector
  solve_mass(const SolidModel<3> &,
             const dealii::TrilinosWrappers::SparseMatrix &,
             const dealii::TrilinosWrappers::MPI::Vector &,
             const dealii::TrilinosWrappers::MPI::Vector &);
} // namespace undine
