// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_block_solver_h
#define undine_coupled_linear_block_solver_h

#include <undine/coupled/linear/block_preconditioner.h>
#include <undine/coupled/linear/joint_factorisation.h>
#include <undine/solid/solvers/tangent_preconditioner.h>

#include <string>

namespace undine
{
  /// The settings by which the block systems of the simultaneous scheme are solved: keys of the
  /// section `Coupling`.
  struct BlockSolverSettings
  {
    /// Read the keys of the section.
    void
    add_options(const Options &options);

    std::unique_ptr<BlockPreconditioner> preconditioner;
    std::string                          solver             = "iterative"; ///< iterative | direct
    std::string                          multigrid          = "algebraic"; ///< CellPreconditioner
    double                               tolerance          = 1e-8;        ///< [1]
    unsigned int                         maximum_iterations = 200;
  };

  /// Solves block systems by flexible GMRES. Residuals are measured after scaling by |diag A|^-1/2
  /// and diag(S)^-1/2, so that forces and fluxes weigh alike, whatever the units: both become
  /// square roots of powers [W^1/2]. Where the iteration does not converge, sparse factors of the
  /// whole matrix take its place, with a note.
  template <int dim>
  class BlockSolver
  {
  public:
    using Vector      = BlockSystem::Vector;
    using BlockVector = BlockSystem::BlockVector;
    using Matrix      = BlockSystem::Matrix;

    /// The references must outlive it.
    BlockSolver(const SolidModel<dim> &model, const BlockSolverSettings &settings);

    /// A new step, with pressures in `places`: forget the approximation of the Schur complement,
    /// iterations() and note(). `places` must outlive the calls of solve().
    void
    start_step(const CellsOfUnknowns &places);

    /// Solutions of `system` follow, which must outlive them; `displacement` [m] says where the
    /// bodies are. Collective. Throws SolveError if the tangent is singular or not a number.
    void
    initialize(const BlockSystem &system, const Vector &displacement);

    /// The solution up to `reduction` of the right side, at least the settings' tolerance.
    /// Collective. Throws SolveError if the system is singular or not a number.
    BlockVector
    solve(const BlockVector &right_side, const double reduction);

    /// Number of iterations of all solves since start_step(), and the largest of one. @{
    unsigned int
    iterations() const;
    unsigned int
    most_iterations() const;
    /// @}

    /// What the last solve() has left of the right side, as GMRES measures it [1]; 0: factors
    /// solved.
    double
    part_left() const;

    /// Memory of the approximation of the Schur complement on this rank [bytes]. Trilinos does not
    /// tell the size of its factors and hierarchies.
    std::size_t
    memory_consumption() const;

    /// A note on anything unusual since start_step(); empty if there was nothing.
    const std::string &
    note() const;

  private:
    /// False if the iteration does not converge.
    bool
    iterate(BlockVector &solution, const BlockVector &right_side, const double reduction);

    const BlockSolverSettings             &settings;
    TangentPreconditioner<dim>             tangent_inverse;
    const CellsOfUnknowns                 *places = nullptr;
    const BlockSystem                     *system = nullptr;
    std::unique_ptr<const SchurComplement> schur;   ///< nullptr: of no system yet
    BlockVector                            weights; ///< W, by which residuals are measured
    std::unique_ptr<JointFactorisation>    factors; ///< of the system, if it was solved with them
    unsigned int                           all_iterations = 0, largest_iterations = 0;
    double                                 left = 0; ///< part_left()
    std::string                            all_notes;
  };
} // namespace undine

#endif
