// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_stability_added_mass_h
#define undine_coupled_stability_added_mass_h

#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace undine
{
  /// What the fluid sets against accelerations of the bodies where the grid is cut for a state,
  ///
  ///     A = B^T L^-1 B   [kg],                                                              (V13)
  ///
  /// with the surface flux B and the pressure matrix L of the projection: the forces of the
  /// pressure are -A du/dt. Symmetric and positive semidefinite.
  template <int dim>
  class AddedMass
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// For a scene with bodies in a fluid. The models must outlive it. Collective.
    AddedMass(const Models<dim> &models, const State<dim> &state);

    /// Can all motions be accelerated? Not if bodies close off a region of the fluid, whose volume
    /// they cannot change.
    bool
    is_finite() const
    {
      return no_region_is_closed;
    }

    /// result = A u [kg m/s]. Throws SolveError if the pressure does not converge. Collective.
    void
    vmult(Vector &result, const Vector &u) const;

  private:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    const unsigned int                  maximum_iterations;
    bool                                no_region_is_closed;
    Matrix                              B, L;
    std::unique_ptr<CellPreconditioner> multigrid;
  };
} // namespace undine

#endif
