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
    , velocities(displacements.size())
    , viscous_pressures(geometry.n_points())
    , local_forces(displacements.size())
    , volume_gradients(displacements.size())
    , local_tangent(displacements.size())
    , all_gradients(geometry.n_nodes(), geometry.n_points() * dim)
    , of_rows(geometry.n_nodes(), displacements.size())
  {
    for (auto &matrix : of_columns)
      matrix.reinit(geometry.n_points() * dim, displacements.size());
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
    return gradient(displacements);
  }


  /// That of nodal values at the current point.
  template <int dim>
  dealii::Tensor<2, dim>
  CellForces<dim>::gradient(const std::vector<double> &nodal_values) const
  {
    Tensor2 result;
    for (unsigned int node = 0; node < gradients.size(); ++node)
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] += nodal_values[node * dim + axis] * gradients[node];
    return result;
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
      set_moduli(moduli, q);
    });
    multiply_out_tangent();
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
  void
  CellForces<dim>::set_velocity(const dealii::TrilinosWrappers::MPI::Vector &velocity)
  {
    velocity.extract_subvector_to(geometry.dofs(cell), velocities);
  }


  /// F, or I for laws of small rotations.
  template <int dim>
  dealii::Tensor<2, dim>
  CellForces<dim>::rotation_and_stretch(const Tensor2 &displacement_gradient) const
  {
    return deformation::F(body->material->is_objective() ? displacement_gradient : Tensor2());
  }


  template <int dim>
  void
  CellForces<dim>::prepare_viscosity()
  {
    if (viscous_body != body)
      rest_moduli = body->kinematics->respond(*body->material, Tensor2()).tangent;
    viscous_body = body;
    if (!is_separated())
      return;
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      viscous_pressures[q] =
        body->material->volumetric_tangent(1) *
        scalar_product(cofactor(rotation_and_stretch(H)), gradient(velocities));
    });
    dilatation.set_cell(cell);
    viscous_pressures = dilatation.project(viscous_pressures);
  }


  /// S_v = A(I) : sym(F^T G), without the volumetric part; A(I) sees only the symmetric one.
  template <int dim>
  dealii::Tensor<2, dim>
  CellForces<dim>::viscous_stress(const Tensor2 &F) const
  {
    const Tensor2 rate = transpose(F) * gradient(velocities);
    Tensor2       result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        result[i][j] = scalar_product(rest_moduli[i][j], rate);
    return result;
  }


  template <int dim>
  const std::vector<double> &
  CellForces<dim>::viscous_forces()
  {
    prepare_viscosity();
    std::fill(local_forces.begin(), local_forces.end(), 0.);
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      const Tensor2 F      = rotation_and_stretch(H);
      Tensor2       stress = F * viscous_stress(F);
      if (is_separated())
        stress += viscous_pressures[q] * cofactor(F);
      add_forces(stress, geometry.JxW(cell, q));
    });
    return local_forces;
  }


  /// With N = a G + b F, a and b being the factors, the change of displacements and velocities
  /// changes P_v / eta by A_ijkl = a delta_ik S_lj + F_im A(I)_mjlq N_kq + a m d(cof F)_ij/dF_kl,
  /// and cof F : G by (a G : d(cof F)/dF + b cof F) : grad N.
  template <int dim>
  const dealii::FullMatrix<double> &
  CellForces<dim>::viscous_tangent(const double displacement_factor, const double velocity_factor)
  {
    prepare_viscosity();
    local_tangent  = 0;
    const double a = body->material->is_objective() ? displacement_factor : 0.;

    dealii::FullMatrix<double> of_volume(geometry.n_points(), local_forces.size());
    dealii::FullMatrix<double> of_rates = of_volume;
    at_all_points([&](const unsigned int q, const Tensor2 &H) {
      const Tensor2 F = rotation_and_stretch(H);
      const Tensor2 S = viscous_stress(F);
      const Tensor2 G = gradient(velocities), N = a * G + velocity_factor * F;
      Tensor4       moduli;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          {
            moduli[i][j][i] += a * S[j];
            Tensor2 row; // F_im A(I)_mj
            for (unsigned int m = 0; m < dim; ++m)
              row += F[i][m] * rest_moduli[m][j];
            moduli[i][j] += N * transpose(row);
          }
      if (is_separated())
        {
          const Tensor2 C       = cofactor(F);
          const Tensor4 change  = a * cofactor_derivative(F);
          Tensor2       of_rate = velocity_factor * C;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              of_rate += G[i][j] * change[i][j];
          moduli += viscous_pressures[q] * change;
          for (unsigned int dof = 0; dof < local_forces.size(); ++dof)
            {
              of_volume(q, dof) = C[dof % dim] * gradients[dof / dim] * geometry.JxW(cell, q);
              of_rates(q, dof)  = of_rate[dof % dim] * gradients[dof / dim];
            }
        }
      set_moduli(moduli, q);
    });
    multiply_out_tangent();
    if (is_separated())
      add_volumetric_viscosity(of_volume, of_rates);
    return local_tangent;
  }


  /// The part of the tangent by the change of the pressure m. [point][node * dim + axis]:
  /// cof F : grad N times the point's weight, and how cof F : G changes.
  template <int dim>
  void
  CellForces<dim>::add_volumetric_viscosity(const dealii::FullMatrix<double> &volume_gradients,
                                            const dealii::FullMatrix<double> &volume_rates)
  {
    const unsigned int         n_points = geometry.n_points();
    dealii::FullMatrix<double> pressures(n_points, local_forces.size());
    std::vector<double>        of_dof(n_points);
    for (unsigned int dof = 0; dof < local_forces.size(); ++dof)
      {
        for (unsigned int q = 0; q < n_points; ++q)
          of_dof[q] = body->material->volumetric_tangent(1) * volume_rates(q, dof);
        of_dof = dilatation.project(of_dof);
        for (unsigned int q = 0; q < n_points; ++q)
          pressures(q, dof) = of_dof[q];
      }
    volume_gradients.Tmmult(local_tangent, pressures, true);
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


  /// The moduli A at a point.
  template <int dim>
  void
  CellForces<dim>::set_moduli(const Tensor4 &moduli, const unsigned int point)
  {
    const double JxW = geometry.JxW(cell, point);
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int j = 0; j < gradients.size(); ++j)
        {
          const unsigned int row = point * dim + k;
          all_gradients(j, row)  = gradients[j][k];
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              of_columns[a](row, j * dim + b) = JxW * (moduli[a][k][b] * gradients[j]);
        }
  }


  /// K_(i a)(j b) += sum_kq grad_k N_i A_akbl grad_l N_j, as products of matrices: these are fast.
  template <int dim>
  void
  CellForces<dim>::multiply_out_tangent()
  {
    for (unsigned int a = 0; a < dim; ++a)
      {
        all_gradients.mmult(of_rows, of_columns[a]);
        for (unsigned int i = 0; i < of_rows.m(); ++i)
          for (unsigned int dof = 0; dof < of_rows.n(); ++dof)
            local_tangent(i * dim + a, dof) += of_rows(i, dof);
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
