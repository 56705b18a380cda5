// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/rigid_motions.h>
#include <undine/solid/solvers/tangent_multigrid.h>

#include <deal.II/base/mpi.h>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  bool
  solves_directly(const SolidModel<dim> &model, const FactorUse use)
  {
    const std::string &choice = model.numerics().linear_solver;
    if (choice != "auto")
      return choice == "direct";
    const bool separated =
      std::any_of(model.bodies().begin(), model.bodies().end(), [](auto &body) {
        return body.kinematics->separates_volumetric_part(*body.material);
      });
    return factorisation_work(model) <= most_work_of_factors(use, separated);
  }


  namespace
  {
    /// A has to live as long as the result. Throws what ML throws.
    template <int dim>
    void
    initialize_multigrid(AlgebraicMultigrid                           &multigrid,
                         const dealii::TrilinosWrappers::SparseMatrix &A,
                         const SolidModel<dim>                        &model,
                         const typename SolidModel<dim>::Vector       &displacement)
    {
      auto                               motions = rigid_motions(model, displacement);
      AlgebraicMultigrid::AdditionalData data;
      data.elliptic              = true;
      data.higher_order_elements = model.numerics().degree > 1;
      data.smoother_sweeps       = 2;
      data.aggregation_threshold = 1e-2;

      Teuchos::ParameterList              parameters;
      std::unique_ptr<Epetra_MultiVector> no_constant_modes;
      data.set_parameters(parameters, no_constant_modes, A);
      parameters.set("PDE equations", dim);
      parameters.set("null space: type", "pre-computed");
      parameters.set("null space: dimension", motions.NumVectors());
      parameters.set("null space: vectors", motions.Values());
      parameters.set("null space: add default vectors", false);
      multigrid.initialize(A, parameters);
    }
  } // namespace


  template <int dim>
  std::unique_ptr<TangentMultigrid>
  make_multigrid(const dealii::TrilinosWrappers::SparseMatrix &A,
                 const SolidModel<dim>                        &model,
                 const typename SolidModel<dim>::Vector       &displacement)
  {
    bool failed = !std::isfinite(A.frobenius_norm());
    auto result = std::make_unique<TangentMultigrid>();
    result->matrix.reinit(A);
    result->matrix.add(1., A);
    try
      {
        if (!failed)
          initialize_multigrid(result->hierarchy, result->matrix, model, displacement);
      }
    catch (const std::exception &)
      {
        failed = true;
      }
    if (dealii::Utilities::MPI::logical_or(failed, model.communicator()))
      result.reset();
    return result;
  }


  template bool
  solves_directly(const SolidModel<2> &, FactorUse);
  template bool
  solves_directly(const SolidModel<3> &, FactorUse);
  template std::unique_ptr<TangentMultigrid>
  make_multigrid(const dealii::TrilinosWrappers::SparseMatrix &,
                 const SolidModel<2> &,
                 const SolidModel<2>::Vector &);
  template std::unique_ptr<TangentMultigrid>
  make_multigrid(const dealii::TrilinosWrappers::SparseMatrix &,
                 const SolidModel<3> &,
                 const SolidModel<3>::Vector &);
} // namespace undine
