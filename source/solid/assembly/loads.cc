// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/solid/assembly/loads.h>
#include <undine/solid/material/cofactor_derivative.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/physics/elasticity/kinematics.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>

namespace undine
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;
  using dealii::Physics::Transformations::nansons_formula;
  namespace deformation = dealii::Physics::Elasticity::Kinematics;

  namespace
  {
    /// forces += int load(body, place at rest) . N_i dX, where `acts_on(body)` says so.
    template <int dim, class ActsOn, class Load>
    void
    add_volume_load(Vector                &forces,
                    const SolidModel<dim> &model,
                    const ActsOn          &acts_on,
                    const Load            &load_at)
    {
      const auto &geometry = model.geometry();
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          const auto &body = model.bodies()[geometry.body(cell)];
          if (!acts_on(body))
            continue;
          std::vector<double> local(geometry.dofs(cell).size(), 0.);
          for (unsigned int q = 0; q < geometry.n_points(); ++q)
            {
              const dealii::Tensor<1, dim> load =
                load_at(body, geometry.position(cell, q)) * geometry.JxW(cell, q);
              for (unsigned int dof = 0; dof < local.size(); ++dof)
                local[dof] += load[dof % dim] * geometry.shape(dof / dim, q);
            }
          forces.add(geometry.dofs(cell), local);
        }
    }


    template <int dim>
    void
    add_weight(Vector &forces, const SolidModel<dim> &model, const dealii::Tensor<1, dim> &gravity)
    {
      add_volume_load(
        forces,
        model,
        [](const auto &) { return true; },
        [&](const auto &body, const auto &) { return body.density * gravity; });
    }


    template <int dim>
    void
    add_force(Vector                 &forces,
              const SolidModel<dim>  &model,
              const VolumeForce<dim> &force,
              const double            time)
    {
      add_volume_load(
        forces,
        model,
        [&](const auto &body) { return body.name == force.body; },
        [&](const auto &body, const auto &place) {
          return body.density * force.acceleration.vector(place, time) +
                 force.per_volume.vector(place, time);
        });
    }


    template <int dim>
    void
    add_loads_of_bodies(Vector &forces, const SolidModel<dim> &model, const double time)
    {
      add_volume_load(
        forces,
        model,
        [](const auto &body) { return !body.load.is_zero(); },
        [&](const auto &body, const auto &place) { return body.load.vector(place, time); });
    }


    /// What effects do: action(name of the effect, function that adds its forces to a vector).
    template <int dim, class Action>
    void
    for_all_effects(const SolidModel<dim>       &model,
                    const SolidEnvironment<dim> &environment,
                    const double                 time,
                    const Action                &action)
    {
      if (environment.gravity.norm() > 0)
        action("gravity", [&](Vector &forces) { add_weight(forces, model, environment.gravity); });
      for (const auto &force : environment.forces)
        action(force.effect, [&](Vector &forces) { add_force(forces, model, force, time); });
    }


    /// action(body, boundary, face values, degrees of freedom of the cell) at the locally owned
    /// faces with a load of this kind; errors reach all ranks.
    template <int dim, class Action>
    void
    for_all_faces(const SolidModel<dim>                 &model,
                  const typename BodyBoundary<dim>::Kind kind,
                  const Action                          &action)
    {
      const auto                                  &element = model.dof_handler().get_fe();
      dealii::FEFaceValues<dim>                    values(model.mapping(),
                                       element,
                                       dealii::QGauss<dim - 1>(element.degree + 1),
                                       dealii::update_values | dealii::update_gradients |
                                         dealii::update_quadrature_points |
                                         dealii::update_normal_vectors | dealii::update_JxW_values);
      std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
      const auto                                   act_on = [&](const LoadedFace<dim> &face) {
        const auto &body     = model.bodies()[face.body];
        const auto &boundary = body.boundaries[face.boundary];
        if (boundary.kind != kind || !face.cell->is_locally_owned())
          return;
        const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
          &model.triangulation(), face.cell->level(), face.cell->index(), &model.dof_handler());
        values.reinit(cell, face.face);
        cell->get_dof_indices(dofs);
        try
          {
            action(body, boundary, values, dofs);
          }
        catch (const SolveError &error)
          {
            throw SolveError("body '" + body.name + "', boundary '" + boundary.name +
                             "': " + error.what());
          }
      };
      std::string failure;
      try
        {
          for (const auto &face : model.faces())
            act_on(face);
        }
      catch (const SolveError &error)
        {
          failure = error.what();
        }
      throw_together(failure, model.communicator());
    }


    template <int dim>
    void
    add_tractions(Vector &forces, const SolidModel<dim> &model, const double time)
    {
      const auto         &element = model.dof_handler().get_fe();
      std::vector<double> local(element.n_dofs_per_cell());
      for_all_faces(model,
                    BodyBoundary<dim>::Kind::traction,
                    [&](const auto &, const auto &boundary, const auto &values, const auto &dofs) {
                      std::fill(local.begin(), local.end(), 0.);
                      for (const unsigned int q : values.quadrature_point_indices())
                        {
                          const auto load =
                            boundary.traction.vector(values.quadrature_point(q), time) *
                            values.JxW(q);
                          for (unsigned int i = 0; i < local.size(); ++i)
                            local[i] += load[element.system_to_component_index(i).first] *
                                        values.shape_value(i, q);
                        }
                      forces.add(dofs, local);
                    });
    }


    /// H at the points of a face, from a ghosted displacement.
    template <int dim>
    std::vector<dealii::Tensor<2, dim>>
    displacement_gradients(const dealii::FEFaceValues<dim> &values, const Vector &displacement)
    {
      std::vector<dealii::Tensor<2, dim>> result(values.n_quadrature_points);
      values[dealii::FEValuesExtractors::Vector(0)].get_function_gradients(displacement, result);
      return result;
    }


    /// F_33 cof(F) n: the deformed normal times the deformed area per area at rest [1].
    template <int dim>
    dealii::Tensor<1, dim>
    deformed_normal(const Body<dim>              &body,
                    const dealii::Tensor<2, dim> &H,
                    const dealii::Tensor<1, dim> &normal)
    {
      const double stretch = body.kinematics->thickness(*body.material, H).stretch;
      return stretch * nansons_formula(normal, deformation::F(H));
    }


    /// Its derivative with respect to H [1].
    template <int dim>
    dealii::Tensor<3, dim>
    deformed_normal_derivative(const Body<dim>              &body,
                               const dealii::Tensor<2, dim> &H,
                               const dealii::Tensor<1, dim> &normal)
    {
      const auto             thickness  = body.kinematics->thickness(*body.material, H);
      const auto             derivative = cofactor_derivative(deformation::F(H));
      const auto             in_plane   = nansons_formula(normal, deformation::F(H));
      dealii::Tensor<3, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        {
          for (unsigned int k = 0; k < dim; ++k)
            result[a] += thickness.stretch * normal[k] * derivative[a][k];
          result[a] += in_plane[a] * thickness.tangent;
        }
      return result;
    }


    /// factor N_i [d(F_33 cof F n)_a / dF_bl] dN_j/dx_l dA.
    template <int dim>
    void
    add_pressure_point(dealii::FullMatrix<double>      &local,
                       const dealii::FEFaceValues<dim> &values,
                       const unsigned int               q,
                       const dealii::Tensor<3, dim>    &of_normal,
                       const double                     factor)
    {
      const auto &element = values.get_fe();
      for (unsigned int i = 0; i < local.m(); ++i)
        for (unsigned int j = 0; j < local.n(); ++j)
          {
            const unsigned int a = element.system_to_component_index(i).first;
            const unsigned int b = element.system_to_component_index(j).first;
            local(i, j) +=
              factor * values.shape_value(i, q) * (of_normal[a][b] * values.shape_grad(j, q));
          }
    }
  } // namespace


  template <int dim>
  Vector
  dead_loads(const SolidModel<dim>       &model,
             const SolidEnvironment<dim> &environment,
             const double                 time,
             TimingTree                  *timing)
  {
    Vector     forces = model.vector();
    TimingTree unused;
    for_all_effects(model, environment, time, [&](const std::string &effect, const auto &add) {
      const auto timed = (timing ? *timing : unused).section(effect);
      add(forces);
    });
    add_loads_of_bodies(forces, model, time);
    add_tractions(forces, model, time);
    forces.compress(dealii::VectorOperation::add);
    return forces;
  }


  template <int dim>
  std::map<std::string, Vector>
  effect_loads(const SolidModel<dim>       &model,
               const SolidEnvironment<dim> &environment,
               const double                 time)
  {
    std::map<std::string, Vector> result;
    for_all_effects(model, environment, time, [&](const std::string &effect, const auto &add) {
      add(result.try_emplace(effect, model.vector()).first->second);
    });
    for (auto &[effect, forces] : result)
      forces.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  bool
  has_pressure_loads(const SolidModel<dim> &model)
  {
    return std::any_of(model.faces().begin(), model.faces().end(), [&](const auto &face) {
      return model.bodies()[face.body].boundaries[face.boundary].kind ==
             BodyBoundary<dim>::Kind::pressure;
    });
  }


  template <int dim>
  Vector
  pressure_loads(const SolidModel<dim> &model, const Vector &displacement, const double time)
  {
    const auto         &element = model.dof_handler().get_fe();
    const Vector        ghosted = model.ghosted(displacement);
    std::vector<double> local(element.n_dofs_per_cell());
    Vector              forces = model.vector();
    for_all_faces(
      model,
      BodyBoundary<dim>::Kind::pressure,
      [&](const auto &body, const auto &boundary, const auto &values, const auto &dofs) {
        const auto H = displacement_gradients(values, ghosted);
        std::fill(local.begin(), local.end(), 0.);
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const double p = boundary.pressure.value(values.quadrature_point(q), time);
            const auto   load =
              deformed_normal(body, H[q], values.normal_vector(q)) * (-p * values.JxW(q));
            for (unsigned int i = 0; i < local.size(); ++i)
              local[i] +=
                load[element.system_to_component_index(i).first] * values.shape_value(i, q);
          }
        forces.add(dofs, local);
      });
    forces.compress(dealii::VectorOperation::add);
    return forces;
  }


  template <int dim>
  Matrix
  pressure_stiffness(const SolidModel<dim> &model, const Vector &displacement, const double time)
  {
    const auto                &element = model.dof_handler().get_fe();
    const Vector               ghosted = model.ghosted(displacement);
    dealii::FullMatrix<double> local(element.n_dofs_per_cell());
    Matrix                     result = model.matrix();
    for_all_faces(
      model,
      BodyBoundary<dim>::Kind::pressure,
      [&](const auto &body, const auto &boundary, const auto &values, const auto &dofs) {
        const auto H = displacement_gradients(values, ghosted);
        local        = 0;
        for (const unsigned int q : values.quadrature_point_indices())
          {
            const double p = boundary.pressure.value(values.quadrature_point(q), time);
            add_pressure_point(local,
                               values,
                               q,
                               deformed_normal_derivative(body, H[q], values.normal_vector(q)),
                               -p * values.JxW(q));
          }
        result.add(dofs, local);
      });
    result.compress(dealii::VectorOperation::add);
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                    \
  template Vector dead_loads(                                                      \
    const SolidModel<dim> &, const SolidEnvironment<dim> &, double, TimingTree *); \
  template std::map<std::string, Vector> effect_loads(                             \
    const SolidModel<dim> &, const SolidEnvironment<dim> &, double);               \
  template bool   has_pressure_loads(const SolidModel<dim> &);                     \
  template Vector pressure_loads(const SolidModel<dim> &, const Vector &, double); \
  template Matrix pressure_stiffness(const SolidModel<dim> &, const Vector &, double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
