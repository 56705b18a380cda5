// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_cell_forces_h
#define undine_solid_assembly_cell_forces_h

#include <undine/solid/assembly/mean_dilatation.h>
#include <undine/solid/mesh/solid_model.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace undine
{
  /// Integrals of the material law over one cell. Local vectors and matrices are counted node by
  /// node (node * dim + axis), as RestGeometry::dofs(). Bodies whose law keeps its volumetric part
  /// apart get the three-field element (MeanDilatation), others the displacement element. Forces,
  /// tangent and energy throw SolveError that names body and place where a point is inverted, on
  /// this rank only.
  ///
  /// The viscous stress (S15) has the constant moduli A(I) of the law at rest, for strain rates
  /// relative to the material: with F = I + grad d, the gradient G = grad u of the velocities and,
  /// for the three-field element, the mean m of F : G over the cell,
  ///
  ///     P_v / eta = F [A(I) : sym(F^T G) + U''(1) m I]                                  [Pa/s]
  ///
  /// Laws of small rotations have F = I in it.
  template <int dim>
  class CellForces
  {
  public:
    explicit CellForces(const SolidModel<dim> &model);

    /// Choose a cell and its nodal displacements [m], from a ghosted vector. Throws nothing. Not
    /// collective.
    void
    reinit(unsigned int cell, const dealii::TrilinosWrappers::MPI::Vector &displacement);

    /// int P : grad N dX [N].
    const std::vector<double> &
    forces();

    /// Derivative of forces() with respect to the displacements [N/m].
    const dealii::FullMatrix<double> &
    tangent();

    /// int W dX [J].
    double
    energy();

    /// Choose the nodal velocities [m/s] of the chosen cell, from a ghosted vector, for the next
    /// two.
    void
    set_velocity(const dealii::TrilinosWrappers::MPI::Vector &velocity);

    /// int P_v : grad N dX for eta = 1 s [N]. Its work, this times the velocities, is never
    /// negative.
    const std::vector<double> &
    viscous_forces();

    /// The derivative of viscous_forces() [N/m], if an unknown changes displacements by
    /// `displacement_factor` [s] and velocities by `velocity_factor` [1] times its own change
    /// [m/s]. Unsymmetric unless displacements stay.
    const dealii::FullMatrix<double> &
    viscous_tangent(double displacement_factor, double velocity_factor);

    /// Deformed over rest volume (2D: area) [1] at a quadrature point, whatever its sign.
    double
    stretched_volume(unsigned int point);

  private:
    using Tensor2 = dealii::Tensor<2, dim>;
    using Tensor4 = dealii::Tensor<4, dim>;

    Tensor2
    displacement_gradient(unsigned int point);
    Tensor2
    gradient(const std::vector<double> &nodal_values) const;
    bool
    is_separated() const;
    void
    prepare_dilatation();
    void
    add_forces(const Tensor2 &stress, double JxW);
    void
    set_moduli(const Tensor4 &moduli, unsigned int point);
    void
    multiply_out_tangent();
    void
    mirror_tangent();
    Tensor2
    rotation_and_stretch(const Tensor2 &displacement_gradient) const;
    void
    prepare_viscosity();
    Tensor2
    viscous_stress(const Tensor2 &F) const;
    void
    add_volumetric_viscosity(const dealii::FullMatrix<double> &volume_gradients,
                             const dealii::FullMatrix<double> &volume_rates);
    void
    add_volume_gradient(const Tensor2 &cofactor, unsigned int point);

    template <class Action>
    void
    at_all_points(const Action &action);

    const SolidModel<dim>              &model;
    const RestGeometry<dim>            &geometry;
    MeanDilatation<dim>                 dilatation;
    bool                                has_dilatation = false; ///< of the chosen cell
    unsigned int                        cell           = 0;
    const Body<dim>                    *body           = nullptr;
    std::vector<double>                 displacements;
    std::vector<double>                 velocities;
    const Body<dim>                    *viscous_body = nullptr; ///< whose moduli these are
    Tensor4                             rest_moduli;            ///< A(I) [Pa]
    std::vector<double>                 viscous_pressures;      ///< U''(1) m at the points [Pa/s]
    std::vector<dealii::Tensor<1, dim>> gradients; ///< of the shape functions at the current point
    std::vector<double>                 local_forces;
    std::vector<double>                 volume_gradients;
    dealii::FullMatrix<double>          local_tangent;

    /// Of the tangent, (k, q) being all directions at all points. @{
    dealii::FullMatrix<double>                  all_gradients; ///< [i][(k, q)]: grad_k N_i
    std::array<dealii::FullMatrix<double>, dim> of_columns; ///< [a][(k, q)][(j, b)]: A_akbl grad_l
                                                            ///< N_j, times the point's weight
    dealii::FullMatrix<double> of_rows;                     ///< [i][(j, b)]
    /// @}
  };
} // namespace undine

#endif
