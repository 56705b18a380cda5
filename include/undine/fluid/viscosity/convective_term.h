// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_convective_term_h
#define undine_fluid_viscosity_convective_term_h

#include <undine/fluid/viscosity/convective_entries.h>
#include <undine/fluid/viscosity/face_unknowns.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

namespace undine
{
  /// Convection in flux form along one axis, (F13) and (F16), as a term of the equations of
  /// ImmersedViscousTerm.
  template <int dim>
  class ConvectiveTerm
  {
  public:
    using Vector = typename FaceUnknowns<dim>::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    /// The unknowns must outlive it.
    explicit ConvectiveTerm(const FaceUnknowns<dim> &unknowns);

    /// A new matrix is to come: the entries that it needs, of rows that this rank owns or that are
    /// next to them.
    void
    start_pattern(dealii::DynamicSparsityPattern &pattern, const DualFluxes<dim> &fluxes);

    /// Add the part of a step of `dt` [s] to matrix [kg] and load [kg m/s]; `field` is v* with
    /// ghosts [m/s]. The matrix has the pattern of start_pattern(), and what other ranks have added
    /// to it has been exchanged. Collective.
    void
    add(Matrix                &matrix,
        Vector                &load,
        const double           dt,
        const DualFluxes<dim> &fluxes,
        const Field<dim>      &field);

    std::size_t
    memory_consumption() const;

  private:
    /// What add() is given.
    struct Equations
    {
      Matrix           &matrix;
      Vector           &load;
      double            mass_per_rate; ///< rho h [kg s / m^dim]
      const Field<dim> &field;
    };

    void
    add_between(const Equations &equations, const DualFluxes<dim> &fluxes, Vector &leaving);
    void
    add_entry(const Equations      &equations,
              const FacePlace<dim> &row,
              const FacePlace<dim> &column,
              const double          mass) const;
    void
    add_sides(const Equations &equations, const DualFluxes<dim> &fluxes) const;
    void
    add_shrinkage(const Equations &equations, const DualFluxes<dim> &fluxes, Vector &leaving) const;

    const FaceUnknowns<dim> &unknowns;
    ConvectiveEntries<dim>   entries; ///< of the present matrix, once they are known
  };
} // namespace undine

#endif
