// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_neighbour_equations_h
#define undine_fluid_viscosity_neighbour_equations_h

#include <undine/base/multigrid/stencil_rows.h>
#include <undine/fluid/grid/field.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace undine
{
  /// Linear equations of the values of a field that couple points of a lattice to their neighbours
  /// only, such as those of implicit friction and convection where no body is near,
  ///
  ///     d_i v_i + sum_k (a_ki v_(i + e_k) + b_ki v_(i - e_k)) = r_i.
  ///
  /// They are solved by red-black successive over-relaxation in single precision, whose result
  /// corrects v, until the residual in double precision is small. With Jacobi's matrix having its
  /// eigenvalues in an ellipse of half-axes alpha (friction) and i beta (convection), the best
  /// over-relaxation is [Young, Iterative solution of large linear systems (1971), chapter 6]
  ///
  ///     omega = 2/(1 + s),   s = sqrt(1 - alpha^2 + beta^2),
  ///
  /// and a sweep reduces errors to ((alpha + beta)/(1 + s))^2 of what they were.
  template <int dim>
  class NeighbourEquations
  {
  public:
    /// Without entries.
    explicit NeighbourEquations(std::shared_ptr<const Lattice<dim>> lattice);

    const Lattice<dim> &
    lattice() const
    {
      return *points;
    }

    /// Where the value of a stored point is in arrays; those of a row along the first direction
    /// follow each other.
    std::ptrdiff_t
    position(const GridIndex<dim> &index) const;

    /// The owned points.
    const BoxInArray<dim> &
    owned() const
    {
      return box;
    }

    /// To be filled: all entries of owned points. Those of ghosts may be written, too. @{
    std::array<std::vector<double>, dim> above; ///< a: zero where there is no neighbour
    std::array<std::vector<double>, dim> below; ///< b
    std::vector<double>                  diagonal;
    std::vector<double>                  right_side;
    /// @}

    /// Solve for `field` from the values that it has, to the tolerance of DiffusionSolver. Returns
    /// the number of sweeps; nothing, and leaves the field as it is, if that would take long or
    /// relaxation does not converge. Collective.
    std::optional<unsigned int>
    solve(Field<dim> &field);

    /// On this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    struct Relaxation
    {
      double omega;
      double reduction; ///< of errors by a sweep
      unsigned int
      sweeps(double wanted) const;
    };

    Relaxation
    prepare_relaxation();

    template <typename Number>
    void
    exchange(std::vector<Number> &values) const;

    double
    find_residual();

    void
    correct(const Relaxation &relaxation, const unsigned int n_sweeps, const double size);

    double
    norm(const std::vector<double> &values) const;

    template <typename Number>
    StencilEntries<dim, Number>
    entries(const std::array<std::vector<Number>, dim> &above,
            const std::array<std::vector<Number>, dim> &below) const;

    std::shared_ptr<const Lattice<dim>> points;
    IndexBox<dim>                       stored; ///< with one layer of ghosts
    BoxInArray<dim>                     box;
    std::size_t                         size; ///< of arrays

    std::vector<double>                 values, residual;
    std::array<std::vector<float>, dim> rough_above, rough_below; ///< in single precision
    std::vector<float>                  rough_inverse, rough_residual, correction;
  };
} // namespace undine

#endif
