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

    /// Deformed over rest volume (2D: area) [1] at a quadrature point, whatever its sign.
    double
    stretched_volume(unsigned int point);

  private:
    using Tensor2 = dealii::Tensor<2, dim>;
    using Tensor4 = dealii::Tensor<4, dim>;

    Tensor2
    displacement_gradient(unsigned int point);
    bool
    is_separated() const;
    void
    prepare_dilatation();
    void
    add_forces(const Tensor2 &stress, double JxW);
    void
    add_tangent(const Tensor4 &moduli, double JxW);
    void
    mirror_tangent();
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
    std::vector<dealii::Tensor<1, dim>> gradients; ///< of the shape functions at the current point
    std::vector<double>                 local_forces;
    std::vector<double>                 volume_gradients;
    dealii::FullMatrix<double>          local_tangent;
  };
} // namespace undine

#endif
