// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_scalar_step_h
#define undine_fluid_scalars_scalar_step_h

#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/scalars/scalar_bounds.h>
#include <undine/fluid/scalars/scalar_fluxes.h>
#include <undine/fluid/viscosity/diffusion_solver.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <functional>
#include <memory>
#include <vector>

namespace undine
{
  /// Takes scalars through a stage by fluxes F, with sources q:
  ///
  ///  - s_L, a solution of first order that obeys the maximum principle whatever the step and
  ///    however small cells are, with values upwind at the faces,
  ///
  ///        V s_L - V^b s^b = h q - h sum F(theta s_L + (1 - theta) s^b),                 (F19)
  ///
  ///    theta being 0 where the fluxes let no more leave a place than there is, else the least
  ///    share for which they do not;
  ///  - fluxes F_H of second order: of what comes to the faces (face_means()), near bodies of the
  ///    mean of both sides at the begin and of s_L at the end, and of diffusion by two stages of
  ///    Alexander's method with what these fluxes bring;
  ///  - as much of their difference as bounds allow (FluxCorrection),
  ///
  ///        V s = V s_L - sum share h (F_H - F).                                          (F21)
  ///
  /// Bounds are the values at the begin as far as flow and diffusion reach in the stage, and those
  /// of s_L next to a place. What leaves one cell or component enters another one.
  template <int dim>
  class ScalarStep
  {
  public:
    /// The flow must outlive this.
    explicit ScalarStep(const ScalarFlow<dim> &flow)
      : flow(flow)
    {
    }

    /// q on the present topology at a time [s]; empty: none.
    using Source = std::function<Field<dim>(const double)>;

    /// The scalar at the end of the stage, from that at its begin. Throws SolveError. Collective.
    Field<dim>
    advance(const Field<dim>             &scalar,
            const BoundaryCondition<dim> &condition,
            const double                  diffusivity,
            const Source                 &source);

    /// Of all solutions so far.
    unsigned int
    iterations() const
    {
      return n_iterations;
    }

    /// Of matrices and fields while advance() works [bytes].
    std::size_t
    memory_consumption() const
    {
      return memory;
    }

  private:
    /// Equations for values s of which the shares theta leave each place:
    ///
    ///     (retained + sum -other) s + sum other theta s' = load
    struct Equations
    {
      double          duration; ///< [s]
      Field<dim>      retained; ///< [m^dim]
      Field<dim>      shares;   ///< theta; ghosts are up to date
      Field<dim>      diagonal; ///< [m^dim]
      DiffusionSolver solver;
    };

    struct Low
    {
      Field<dim> end;     ///< s_L
      Field<dim> carried; ///< theta s_L + (1 - theta) s^b
    };

    Field<dim>
    gains(const Source &source) const;
    Low
    low_order(const ScalarFluxes<dim> &fluxes, const Field<dim> &begin, const Field<dim> &gains);
    Field<dim>
    after_half(const ScalarFluxes<dim> &fluxes,
               const Field<dim>        &begin,
               const Low               &low,
               const Field<dim>        &gains) const;
    Velocity<dim>
    values_on_faces(const ScalarFluxes<dim> &fluxes,
                    const Field<dim>        &begin,
                    const Field<dim>        &half,
                    const Low               &low,
                    ScalarBounds<dim>       &bounds) const;
    Field<dim>
    diffused(const ScalarFluxes<dim> &fluxes,
             const Field<dim>        &begin,
             const Velocity<dim>     &on_faces,
             const Field<dim>        &gains);
    std::vector<double>
    later_than_middle(const ScalarFluxes<dim> &fluxes) const;
    Field<dim>
    corrected(const ScalarFluxes<dim> &fluxes,
              const Low               &low,
              const Velocity<dim>     &on_faces,
              const Field<dim>        &diffused,
              const ScalarBounds<dim> &bounds) const;

    void
    number();
    template <class Coefficients>
    void
    assemble(Equations                      &equations,
             const ScalarFluxes<dim>        &fluxes,
             const DiffusionSolver::Matrices matrices,
             const Coefficients             &coefficients);
    Field<dim>
    solve(const Equations &equations, const Field<dim> &load, const Field<dim> &guess);

    const ScalarFlow<dim>                    &flow;
    std::unique_ptr<PressureNumbers<dim>>     numbers; ///< none before the first matrix
    dealii::TrilinosWrappers::SparsityPattern pattern;
    unsigned int                              n_iterations = 0;
    std::size_t                               memory       = 0;
  };
} // namespace undine

#endif
