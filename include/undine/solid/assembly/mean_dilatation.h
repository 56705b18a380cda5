// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_mean_dilatation_h
#define undine_solid_assembly_mean_dilatation_h

#include <undine/solid/material/material.h>
#include <undine/solid/mesh/rest_geometry.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace undine
{
  /// Dilatation theta and pressure p of the three-field element (S13), (S14) on one cell: the
  /// elements' degree minus one, discontinuous, condensed. With phi a basis of these polynomials
  /// and J = det F,
  ///
  ///     M = int phi phi^T,   theta = phi^T M^{-1} int phi J,   p = phi^T M^{-1} int phi U'(theta)
  ///
  /// minimise int W_distortional(F) + U(theta) + p (J - theta): its forces are
  /// int (P_distortional + p cof F) : grad N, and the condensed tangent adds
  ///
  ///     int p d(cof F)/dF  +  G^T M^{-1} H M^{-1} G,
  ///     G = int phi (cof F : grad N),   H = int U''(theta) phi phi^T
  ///
  /// [Simo, Taylor, Pister, Comput. Methods Appl. Mech. Eng. 51 (1985) 177; Brink, Stein, Comput.
  /// Mech. 19 (1996) 105].
  template <int dim>
  class MeanDilatation
  {
  public:
    explicit MeanDilatation(const RestGeometry<dim> &geometry);

    /// Choose a cell for project().
    void
    set_cell(unsigned int cell);

    /// The L2 projection phi^T M^{-1} int phi f at the cell's quadrature points, from f there.
    std::vector<double>
    project(const std::vector<double> &values) const;

    /// Find theta and p of a cell from J [1] at its quadrature points.
    void
    reinit(unsigned int cell, const Material &material, const std::vector<double> &jacobians);

    /// p [Pa] at a quadrature point.
    double
    pressure(unsigned int point) const;

    /// int U(theta) dX [J].
    double
    energy() const;

    /// Start the sum G. `volume_gradients` (cof F : grad N, [node * dim + axis], [1/m]) at one
    /// point after the other; then add G^T M^{-1} H M^{-1} G [N/m]. @{
    void
    start_gradient();
    void
    add_gradient(unsigned int point, const std::vector<double> &volume_gradients);
    void
    add_tangent(dealii::FullMatrix<double> &tangent) const;
    /// @}

  private:
    double
    basis(unsigned int function, unsigned int point) const;

    const RestGeometry<dim>   &geometry;
    const unsigned int         n_functions;
    unsigned int               cell     = 0;
    const Material            *material = nullptr;
    dealii::Point<dim>         centre;
    double                     width = 1;
    dealii::FullMatrix<double> inverse_mass;
    std::vector<double>        dilatations;
    std::vector<double>        pressures;
    dealii::FullMatrix<double> gradient; ///< G, [function][node * dim + axis]
  };
} // namespace undine

#endif
