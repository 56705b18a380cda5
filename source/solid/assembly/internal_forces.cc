// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/solid/assembly/cell_forces.h>
#include <undine/solid/assembly/cell_matrix_adder.h>
#include <undine/solid/assembly/internal_forces.h>

#include <limits>

namespace undine
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  namespace
  {
    /// action(cell, cell_forces) for the locally owned cells; errors reach all ranks.
    template <int dim, class Action>
    void
    for_all_cells(const SolidModel<dim> &model, const Vector &displacement, const Action &action)
    {
      const Vector    ghosted = model.ghosted(displacement);
      CellForces<dim> cell_forces(model);
      std::string     failure;
      try
        {
          for (unsigned int cell = 0; cell < model.geometry().n_cells(); ++cell)
            {
              cell_forces.reinit(cell, ghosted);
              action(cell, cell_forces);
            }
        }
      catch (const SolveError &error)
        {
          failure = error.what();
        }
      throw_together(failure, model.communicator());
    }
  } // namespace


  template <int dim>
  Vector
  internal_forces(const SolidModel<dim> &model, const Vector &displacement)
  {
    Vector result = model.vector();
    for_all_cells(model, displacement, [&](const unsigned int cell, CellForces<dim> &forces) {
      result.add(model.geometry().dofs(cell), forces.forces());
    });
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  Matrix
  internal_stiffness(const SolidModel<dim> &model, const Vector &displacement)
  {
    Matrix          result = model.matrix();
    CellMatrixAdder sum(result);
    for_all_cells(model, displacement, [&](const unsigned int cell, CellForces<dim> &forces) {
      sum.add(model.geometry().dofs(cell), forces.tangent());
    });
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  Vector
  viscous_forces(const SolidModel<dim> &model, const Vector &displacement, const Vector &velocity)
  {
    const Vector ghosted = model.ghosted(velocity);
    Vector       result  = model.vector();
    for_all_cells(model, displacement, [&](const unsigned int cell, CellForces<dim> &forces) {
      forces.set_velocity(ghosted);
      result.add(model.geometry().dofs(cell), forces.viscous_forces());
    });
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  Matrix
  viscous_stiffness(const SolidModel<dim> &model,
                    const Vector          &displacement,
                    const Vector          &velocity,
                    const double           displacement_factor,
                    const double           velocity_factor)
  {
    const Vector    ghosted = model.ghosted(velocity);
    Matrix          result  = model.matrix();
    CellMatrixAdder sum(result);
    for_all_cells(model, displacement, [&](const unsigned int cell, CellForces<dim> &forces) {
      forces.set_velocity(ghosted);
      sum.add(model.geometry().dofs(cell),
              forces.viscous_tangent(displacement_factor, velocity_factor));
    });
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  double
  elastic_energy(const SolidModel<dim> &model, const Vector &displacement)
  {
    double sum = 0;
    for_all_cells(model, displacement, [&](const unsigned int, CellForces<dim> &forces) {
      sum += forces.energy();
    });
    return dealii::Utilities::MPI::sum(sum, model.communicator());
  }


  template <int dim>
  Vector
  rounding_of_forces(const SolidModel<dim> &model, const double size)
  {
    const auto                         &geometry = model.geometry();
    Vector                              forces   = model.vector();
    std::vector<dealii::Tensor<1, dim>> gradients;
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        const double modulus = model.bodies()[geometry.body(cell)].material->p_wave_modulus();
        std::vector<double> local(geometry.dofs(cell).size(), 0.);
        for (unsigned int q = 0; q < geometry.n_points(); ++q)
          {
            geometry.gradients(gradients, cell, q);
            for (unsigned int dof = 0; dof < local.size(); ++dof)
              {
                const double gradient = gradients[dof / dim].norm();
                local[dof] += modulus * gradient * (1 + size * gradient) * geometry.JxW(cell, q);
              }
          }
        forces.add(geometry.dofs(cell), local);
      }
    forces.compress(dealii::VectorOperation::add);
    forces *= std::numeric_limits<double>::epsilon();
    return forces;
  }


#define UNDINE_INSTANTIATE(dim)                                                            \
  template Vector internal_forces(const SolidModel<dim> &, const Vector &);                \
  template Matrix internal_stiffness(const SolidModel<dim> &, const Vector &);             \
  template Vector viscous_forces(const SolidModel<dim> &, const Vector &, const Vector &); \
  template Matrix viscous_stiffness(                                                       \
    const SolidModel<dim> &, const Vector &, const Vector &, const double, const double);  \
  template double elastic_energy(const SolidModel<dim> &, const Vector &);                 \
  template Vector rounding_of_forces(const SolidModel<dim> &, const double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
