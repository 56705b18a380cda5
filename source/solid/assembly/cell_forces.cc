// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/cell_forces.h>
#include <undine/solid/material/cofactor_derivative.h>
#include <undine/solid/material/positive_jacobian.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace undine
{
  namespace deformation = dealii::Physics::Elasticity::Kinematics;


  template <int dim>
  CellForces<dim>::CellForces(const SolidModel<dim> &model)
    : model(model)
    , geometry(model.geometry())
    , dilatation(geometry)
    , displacements(geometry.n_nodes() * dim)
    , local_forces(displacements.size())
    , volume_gradients(displacements.size())
    , local_tangent(displacements.size())
  {
  }


  template <int dim>
  void
  CellForces<dim>::reinit(const unsigned int                           new_cell,
                          const dealii::TrilinosWrappers::MPI::Vector &displacement)
  {
    cell = new_cell;
    body = &model.bodies()[geometry.body(cell)];
    displacement.extract_subvector_to(geometry.dofs(cell), displacements);
    has_dilatation = false;
  }


  template <int dim>
  bool
  CellForces<dim>::is_separated() const
  {
    return body->kinematics->separates_volumetric_part(*body->material);
  }


  template <int dim>
  dealii::Tensor<2, dim>
  CellForces<dim>::displacement_gradient(const unsigned int point)
  {
    geometry.gradients(gradients, cell, point);
    dealii::Tensor<2, dim> H;
    for (unsigned int node = 0; node < gradients.size(); ++node)
      for (unsigned int axis = 0; axis < dim; ++axis)
        H[axis] += displacements[node * dim + axis] * gradients[node];
    return H;
  }


  /// action(point, H) at every quadrature point, `gradients` being those of the point.
  template <int dim>
  template <class Action>
  void
  CellForces<dim>::at_all_points(const Action &action)
  {
    for (unsigned int q = 0; q < geometry.n_points(); ++q)
      try
        {
          action(q, displacement_gradient(q));
        }
      catch (const SolveError &error)
        {
          const auto &position = geometry.position(cell, q);
          throw SolveError(fmt::format("body '{}', the point that rests at ({:.4g}): {}",
                                       body->name,
                                       fmt::join(position.begin_raw(), position.end_raw(), ", "),
                                       error.what()));
        }
  }


  template <int dim>
  void
  CellForces<dim>::prepare_dilatation()
  {
    if (has_dilatation || !is_separated())
      return;
    std::vector<double> jacobians(geometry.n_points());
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      jacobians[q] = determinant(deformation::F(H));
      assert_positive_jacobian(jacobians[q]);
    });
    dilatation.reinit(cell, *body->material, jacobians);
    has_dilatation = true;
  }


  template <int dim>
  const std::vector<double> &
  CellForces<dim>::forces()
  {
    prepare_dilatation();
    std::fill(local_forces.begin(), local_forces.end(), 0.);
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      Tensor2 stress = body->kinematics->stress(*body->material, H).stress;
      if (is_separated())
        stress += dilatation.pressure(q) * cofactor(deformation::F(H));
      add_forces(stress, geometry.JxW(cell, q));
    });
    return local_forces;
  }


  template <int dim>
  const dealii::FullMatrix<double> &
  CellForces<dim>::tangent()
  {
    prepare_dilatation();
    local_tangent = 0;
    if (is_separated())
      dilatation.start_gradient();
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      auto moduli = body->kinematics->respond(*body->material, H).tangent;
      if (is_separated())
        {
          const auto F = deformation::F(H);
          moduli += dilatation.pressure(q) * cofactor_derivative(F);
          add_volume_gradient(cofactor(F), q);
        }
      add_tangent(moduli, geometry.JxW(cell, q));
    });
    mirror_tangent();
    if (is_separated())
      dilatation.add_tangent(local_tangent);
    return local_tangent;
  }


  template <int dim>
  double
  CellForces<dim>::energy()
  {
    prepare_dilatation();
    double sum = 0;
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      sum += body->kinematics->energy(*body->material, H) * geometry.JxW(cell, q);
    });
    return is_separated() ? sum + dilatation.energy() : sum;
  }


  template <int dim>
  double
  CellForces<dim>::stretched_volume(const unsigned int point)
  {
    return determinant(deformation::F(displacement_gradient(point)));
  }


  template <int dim>
  void
  CellForces<dim>::add_forces(const Tensor2 &stress, const double JxW)
  {
    for (unsigned int node = 0; node < gradients.size(); ++node)
      {
        const auto force = stress * gradients[node];
        for (unsigned int axis = 0; axis < dim; ++axis)
          local_forces[node * dim + axis] += force[axis] * JxW;
      }
  }


  /// K_(i a)(j b) += grad_k N_i A_akbl grad_l N_j, for j >= i: the tangent is symmetric.
  template <int dim>
  void
  CellForces<dim>::add_tangent(const Tensor4 &moduli, const double JxW)
  {
    dealii::Tensor<3, dim> of_row;
    for (unsigned int i = 0; i < gradients.size(); ++i)
      {
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            for (unsigned int l = 0; l < dim; ++l)
              {
                double sum = 0;
                for (unsigned int k = 0; k < dim; ++k)
                  sum += gradients[i][k] * moduli[a][k][b][l];
                of_row[a][b][l] = sum * JxW;
              }
        for (unsigned int j = i; j < gradients.size(); ++j)
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              local_tangent(i * dim + a, j * dim + b) += of_row[a][b] * gradients[j];
      }
  }


  template <int dim>
  void
  CellForces<dim>::mirror_tangent()
  {
    for (unsigned int row = 0; row < local_tangent.m(); ++row)
      for (unsigned int column = 0; column < row / dim * dim; ++column)
        local_tangent(row, column) = local_tangent(column, row);
  }


  template <int dim>
  void
  CellForces<dim>::add_volume_gradient(const Tensor2 &cofactor, const unsigned int point)
  {
    for (unsigned int node = 0; node < gradients.size(); ++node)
      {
        const auto gradient = cofactor * gradients[node];
        for (unsigned int axis = 0; axis < dim; ++axis)
          volume_gradients[node * dim + axis] = gradient[axis];
      }
    dilatation.add_gradient(point, volume_gradients);
  }


  template class CellForces<2>;
  template class CellForces<3>;
} // namespace undine
