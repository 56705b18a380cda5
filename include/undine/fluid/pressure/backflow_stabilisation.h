// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_backflow_stabilisation_h
#define undine_fluid_pressure_backflow_stabilisation_h

#include <undine/fluid/grid/pressure_numbers.h>
#include <undine/fluid/pressure/pressure_gradient.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <utility>
#include <vector>

namespace undine
{
  /// The dynamic pressure on outflows where there is backflow, implicit in time and linearised by
  /// Newton's method: with the speed u = -v^{n+1}.n of the backflow through a face and s, a guess
  /// of it (not below zero), and the pressure P of the fluid at rest outside,
  ///
  ///     p = P - rho/2 max(0, u)^2  ~  P - rho/2 (2 s u - s^2)
  ///
  /// Taken from v^n, the impulse h p would more than stop the backflow as soon as fluid crosses a
  /// cell in a step: strips of backflow and strips of outflow would drive each other. Taken
  /// implicitly, the opening takes h rho/2 u^3 of energy per area in a step, which is what the next
  /// transport brings in. v^{n+1} is unique, since it minimises a convex function,
  ///
  ///     |v - v*|^2 rho V/2 + h rho/6 a max(0, u)^3 - h a P u.
  ///
  /// With v^{n+1} = v* + h a (p_c - p)/(rho V) on the face, v outward and p_c the pressure inside,
  ///
  ///     v^{n+1} = m v* + m h a (p_c - P - rho s^2/2)/(rho V),   m = 1/(1 + h s a/V),        (F11)
  ///
  /// a face with backflow moves as if it were heavier. This is the directional do-nothing condition
  /// of Braack & Mucha (2014), taken implicitly. @{

  /// Let the dynamic pressure act for a step dt [s] on v* = `velocity`, given s: on outflows v*
  /// becomes m v*; the openings get their mobility m, and P and the remainder rho s^2/2 as pressure
  /// [Pa]. Not collective.
  template <int dim>
  void
  stabilise_backflow(Velocity<dim>              &velocity,
                     std::vector<OpenFace<dim>> &openings,
                     const FluidModel<dim>      &model,
                     const double                dt);

  /// s := max(0, u) with u of `velocity` = v^{n+1}; the openings get the pressure that has acted,
  /// with the s before. Returns by how much the new s would change v^{n+1} at most [m/s],
  ///
  ///     m h a (u - s)^2/(2 V).
  ///
  /// Collective.
  template <int dim>
  double
  update_entering_speeds(std::vector<OpenFace<dim>> &openings,
                         const Velocity<dim>        &velocity,
                         const FluidModel<dim>      &model,
                         const double                dt);

  /// Newton's method for the speeds s: round(n), n = 0, 1, ..., solves a step with the last ones
  /// and returns by how much better ones would change v^{n+1}, relative to the largest speed [1].
  /// It ends when that is at most 1e-4, or after 20 rounds. From the speeds of the step before it
  /// takes one or two rounds; speeds that are far too large are halved in each.
  template <class Round>
  void
  find_entering_speeds(const Round &round)
  {
    constexpr unsigned int most_rounds = 20;
    constexpr double       tolerance   = 1e-4;
    for (unsigned int n = 0; n < most_rounds; ++n)
      if (round(n) <= tolerance)
        break;
  }

  /// L = D m (rho V)^-1 D^T, from that with all m = 1: subtracts (1 - m) a^2/(rho V) from the
  /// diagonal. Symmetric and positive definite if that is.
  class BackflowMatrix
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// `matrix` must outlive it.
    template <int dim>
    BackflowMatrix(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                   const FluidModel<dim>                        &model,
                   const PressureNumbers<dim>                   &numbers,
                   const std::vector<OpenFace<dim>>             &openings);

    void
    vmult(Vector &product, const Vector &pressure) const;

    /// The values that are subtracted from the diagonal, with the number of the row among those of
    /// this rank.
    const std::vector<std::pair<std::size_t, double>> &
    subtracted() const
    {
      return removed;
    }

  private:
    const dealii::TrilinosWrappers::SparseMatrix &matrix;
    std::vector<std::pair<std::size_t, double>>   removed; ///< from the diagonal of own rows
  };
  /// @}
} // namespace undine

#endif
