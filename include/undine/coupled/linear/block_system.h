// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_linear_block_system_h
#define undine_coupled_linear_block_system_h

#include <deal.II/lac/trilinos_parallel_block_vector.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace undine
{
  /// The equations of a step, linearised (C2), for changes of the bodies' velocities u [m/s] and
  /// the fluid's pressures p [Pa]:
  ///
  ///     [ A    -B^T ] [u]   [N]
  ///     [ k B   h L ] [p]   [m^dim/s]
  ///
  /// (Chentanez, Goktekin, Feldman & O'Brien, equation 3), k = 1 if the surface flux is B u, see
  /// SurfaceFlux::factor(). Block vectors hold u, then p.
  class BlockSystem
  {
  public:
    using Vector      = dealii::TrilinosWrappers::MPI::Vector;
    using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
    using Matrix      = dealii::TrilinosWrappers::SparseMatrix;

    /// The matrices must outlive it.
    BlockSystem(const Matrix &tangent,
                const Matrix &flux,
                const double  flux_factor,
                const Matrix &pressure);

    /// A [kg/s]
    const Matrix &
    tangent() const
    {
      return A;
    }

    /// B [m^(dim-1)]
    const Matrix &
    flux() const
    {
      return B;
    }

    /// k [1]
    double
    flux_factor() const
    {
      return k;
    }

    /// h L [m^dim / (s Pa)]
    const Matrix &
    pressure() const
    {
      return hL;
    }

    /// Zero.
    BlockVector
    vector() const;

    /// result = the matrix times `x`. Collective.
    void
    vmult(BlockVector &result, const BlockVector &x) const;

    /// S = h L + k B diag|A|^-1 B^T [m^dim / (s Pa)]: stands for the Schur complement
    /// h L + k B A^-1 B^T. Collective.
    Matrix
    approximate_schur_complement() const;

  private:
    const Matrix &A;
    const Matrix &B;
    const double  k;
    const Matrix &hL;
  };
} // namespace undine

#endif
