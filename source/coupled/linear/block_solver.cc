// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/registry.h>
#include <undine/coupled/linear/block_solver.h>
#include <undine/coupled/linear/joint_factorisation.h>

#include <deal.II/lac/solver_gmres.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    using BlockVector = BlockSystem::BlockVector;


    /// diag^1/2 of both diagonal blocks.
    BlockVector
    square_roots_of_diagonal(const BlockSystem &system, const BlockSystem::Matrix &schur)
    {
      auto       result = system.vector();
      const auto fill   = [](BlockSystem::Vector &roots, const BlockSystem::Matrix &matrix) {
        for (const auto row : matrix.locally_owned_range_indices())
          {
            const double diagonal = std::abs(matrix.diag_element(row));
            roots(row)            = diagonal > 0 ? std::sqrt(diagonal) : 1.;
          }
        roots.compress(dealii::VectorOperation::insert);
      };
      fill(result.block(0), system.tangent());
      fill(result.block(1), schur);
      return result;
    }


    void
    divide(BlockVector &vector, const BlockVector &factors)
    {
      for (unsigned int block = 0; block < 2; ++block)
        std::transform(vector.block(block).begin(),
                       vector.block(block).end(),
                       factors.block(block).begin(),
                       vector.block(block).begin(),
                       std::divides<double>());
    }


    /// W^-1 times the system.
    struct ScaledSystem
    {
      void
      vmult(BlockVector &result, const BlockVector &x) const
      {
        system.vmult(result, x);
        divide(result, weights);
      }

      const BlockSystem &system;
      const BlockVector &weights;
    };


    /// The preconditioner times W.
    struct ScaledPreconditioner
    {
      void
      vmult(BlockVector &result, const BlockVector &right_side) const
      {
        BlockVector unscaled = right_side;
        unscaled.scale(weights);
        preconditioner.vmult(result, unscaled);
      }

      const BlockPreconditioner &preconditioner;
      const BlockVector         &weights;
    };
  } // namespace


  void
  BlockSolverSettings::add_options(const Options &options)
  {
    options.add("Linear solver",
                solver,
                "",
                Allowed::one_of({"iterative", "direct"}),
                "Flexible GMRES, or sparse factors of the whole matrix.");
    preconditioner = options.choose<BlockPreconditioner>(
      "Preconditioner", "automatic", "What GMRES is helped by.");
    options.add(
      "Multigrid",
      multigrid,
      "",
      Allowed::one_of(Registry<CellPreconditioner>::instance().names()),
      "For the pressures within the preconditioner: by smoothed aggregation (Trilinos ML), "
      "or on blocks of cells.");
    options.add("Linear tolerance",
                tolerance,
                "1",
                Allowed::between(1e-14, 1e-2),
                "GMRES stops at this part of the residual it began with.");
    options.add("Maximum iterations",
                maximum_iterations,
                "",
                Allowed::positive(),
                "Of GMRES; then the matrix is factorised.");
  }


  template <int dim>
  BlockSolver<dim>::BlockSolver(const SolidModel<dim> &model, const BlockSolverSettings &settings)
    : settings(settings)
    , tangent_inverse(model)
  {
  }


  template <int dim>
  void
  BlockSolver<dim>::start_step(const CellsOfUnknowns &new_places)
  {
    places = &new_places;
    schur.reset();
    settings.preconditioner->start_step();
    all_iterations = largest_iterations = 0;
    all_notes.clear();
  }


  template <int dim>
  void
  BlockSolver<dim>::initialize(const BlockSystem &new_system, const Vector &displacement)
  {
    system = &new_system;
    factors.reset();
    if (settings.solver != "iterative")
      return;
    if (!schur)
      schur = std::make_unique<const SchurComplement>(*system, *places, settings.multigrid);
    weights = square_roots_of_diagonal(*system, schur->matrix());
    tangent_inverse.initialize(system->tangent(), displacement);
    settings.preconditioner->initialize(
      *system, *schur, [&](Vector &x, const Vector &b) { tangent_inverse.vmult(x, b); });
  }


  template <int dim>
  typename BlockSolver<dim>::BlockVector
  BlockSolver<dim>::solve(const BlockVector &right_side, const double reduction)
  {
    if (settings.solver == "iterative" && !factors)
      {
        auto       solution = system->vector();
        const bool converged =
          iterate(solution, right_side, std::max(reduction, settings.tolerance));
        if (!tangent_inverse.note().empty())
          all_notes = tangent_inverse.note();
        if (converged)
          return solution;
        all_notes = fmt::format("GMRES did not converge within {} iterations: solved directly",
                                settings.maximum_iterations);
      }
    if (!factors)
      {
        factors = std::make_unique<JointFactorisation>();
        factors->factorise(*system, system->pressure().locally_owned_range_indices());
      }
    left = 0;
    return factors->solve(right_side);
  }


  template <int dim>
  bool
  BlockSolver<dim>::iterate(BlockVector       &solution,
                            const BlockVector &right_side,
                            const double       reduction)
  {
    auto scaled = right_side;
    divide(scaled, weights);
    dealii::SolverControl control(settings.maximum_iterations, reduction * scaled.l2_norm());
    bool                  failed = false;
    settings.preconditioner->start_solve();
    try
      {
        using FGMRES = dealii::SolverFGMRES<BlockVector>;
        FGMRES(control, typename FGMRES::AdditionalData(100))
          .solve(ScaledSystem{*system, weights},
                 solution,
                 scaled,
                 ScaledPreconditioner{*settings.preconditioner, weights});
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        failed = true;
      }
    left = control.last_value() / control.initial_value();
    all_iterations += control.last_step();
    largest_iterations = std::max(largest_iterations, control.last_step());
    return !failed;
  }


  template <int dim>
  unsigned int
  BlockSolver<dim>::iterations() const
  {
    return all_iterations;
  }


  template <int dim>
  unsigned int
  BlockSolver<dim>::most_iterations() const
  {
    return largest_iterations;
  }


  template <int dim>
  double
  BlockSolver<dim>::part_left() const
  {
    return left;
  }


  template <int dim>
  const std::string &
  BlockSolver<dim>::note() const
  {
    return all_notes;
  }


  template <int dim>
  std::size_t
  BlockSolver<dim>::memory_consumption() const
  {
    return schur ? schur->memory_consumption() : 0;
  }


  template class BlockSolver<2>;
  template class BlockSolver<3>;
} // namespace undine
