// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <deal.II/physics/elasticity/kinematics.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// Two shears, one after the other: no volume changes.
  const std::string isochoric_text = "t*0.15*sin(2*y); t*0.2*sin(1.5*(x+t*0.15*sin(2*y)))";

  template <int dim>
  const std::string
    exact_text = plane_or_space<dim>("t*0.12*sin(2*x+y); t*0.1*cos(x-3*y)",
                                     "t*0.12*sin(2*x+y); t*0.1*cos(x-3*y+z); t*0.08*sin(2*z-y)");


  /// The displacement gradient by differences whose error is far below that of the meshes used.
  template <int dim>
  dealii::Tensor<2, dim>
  gradient(const Expression<dim, dim> &d, const dealii::Point<dim> &x, const double time)
  {
    const double           step = 1e-5;
    dealii::Tensor<2, dim> H;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const dealii::Tensor<1, dim> shift = step * dealii::Point<dim>::unit_vector(axis);
        const auto change = (d.vector(x + shift, time) - d.vector(x - shift, time)) / (2 * step);
        for (unsigned int i = 0; i < dim; ++i)
          H[i][axis] = change[i];
      }
    return H;
  }


  /// P with the volumetric part, whichever way the element takes it.
  template <int dim>
  dealii::Tensor<2, dim>
  stress(const Body<dim> &body, const dealii::Tensor<2, dim> &H)
  {
    auto P = body.kinematics->stress(*body.material, H).stress;
    if (body.kinematics->separates_volumetric_part(*body.material))
      {
        const auto F = dealii::Physics::Elasticity::Kinematics::F(H);
        P += body.material->volumetric_stress(determinant(F)) * cofactor(F);
      }
    return P;
  }


  /// int P(exact) : grad N dX: the loads under which the exact displacement is in equilibrium.
  template <int dim>
  Vector
  exact_loads(const SolidModel<dim> &model, const Expression<dim, dim> &exact, const double time)
  {
    const auto                                  &element = model.dof_handler().get_fe();
    dealii::FEValues<dim>                        values(model.mapping(),
                                 element,
                                 dealii::QGauss<dim>(element.degree + 3),
                                 dealii::update_gradients | dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    Vector                                       result = model.vector();
    for (const auto &cell : model.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          std::vector<double> local(dofs.size());
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const auto P =
                stress(model.bodies()[0], gradient(exact, values.quadrature_point(q), time));
              for (unsigned int i = 0; i < dofs.size(); ++i)
                local[i] += P[element.system_to_component_index(i).first] *
                            values.shape_grad(i, q) * values.JxW(q);
            }
          result.add(dofs, local);
        }
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  double
  error_in_L2(const SolidModel<dim> &model, const Vector &field, const Expression<dim, dim> &exact)
  {
    const auto                         &element = model.dof_handler().get_fe();
    dealii::FEValues<dim>               values(model.mapping(),
                                 element,
                                 dealii::QGauss<dim>(element.degree + 3),
                                 dealii::update_values | dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
    const Vector                        ghosted = model.ghosted(field);
    std::vector<dealii::Tensor<1, dim>> found(values.n_quadrature_points);
    double                              sum = 0;
    for (const auto &cell : model.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          values[dealii::FEValuesExtractors::Vector(0)].get_function_values(ghosted, found);
          for (const unsigned int q : values.quadrature_point_indices())
            sum += (found[q] - exact.vector(values.quadrature_point(q), 1)).norm_square() *
                   values.JxW(q);
        }
    return std::sqrt(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD));
  }


  template <int dim>
  double
  manufactured_error(const std::string &material,
                     const std::string &displacement,
                     const unsigned int cells,
                     const unsigned int degree)
  {
    std::string cell_text = std::to_string(cells);
    for (unsigned int axis = 1; axis < dim; ++axis)
      cell_text += ", " + std::to_string(cells);
    Solid<dim>                 solid(one_body(
      fmt::format("set Cells = {}\n set Map = {}\n set Density = 1\n set Material = {}\n"
                                  "set Young's modulus = 10",
                  cell_text,
                  plane_or_space<dim>("x+0.1*x*y; y-0.1*sin(x)", "x+0.1*x*y; y-0.1*sin(x); z"),
                  material),
      boundary("all", "set Kind = prescribed motion\n set Displacement = " + displacement),
      fmt::format("set Element degree = {}", degree),
      "set Integrator = static"));
    const Expression<dim, dim> exact(displacement);
    const unsigned int         steps = 4;
    for (unsigned int step = 0; step < steps; ++step)
      solid.stepper.step(solid.state,
                         solid.environment,
                         1. * step / steps,
                         1. / steps,
                         solid.timing,
                         exact_loads(solid.model, exact, (step + 1.) / steps));
    return error_in_L2(solid.model, solid.state.displacement, exact);
  }


  template <int dim>
  double
  order(const std::string &material,
        const unsigned int cells,
        const unsigned int degree,
        const std::string &displacement = exact_text<dim>)
  {
    return std::log2(manufactured_error<dim>(material, displacement, cells, degree) /
                     manufactured_error<dim>(material, displacement, 2 * cells, degree));
  }
} // namespace


TEST_CASE("finite strain: order of convergence in space", "[solid]")
{
  const std::string neo_hookean = "neo-Hookean\n set Poisson's ratio = 0.3";
  const std::string rubber      = "nearly incompressible rubber\n set Poisson's ratio = 0.499";
  CHECK(order<2>(neo_hookean, 8, 1) == Approx(2).margin(0.15));
  CHECK(order<2>(neo_hookean, 8, 2) == Approx(3).margin(0.15));
  CHECK(order<2>(neo_hookean + "\n set Plane state = plane stress", 8, 2) ==
        Approx(3).margin(0.15));
  CHECK(order<2>(rubber, 16, 1, isochoric_text) == Approx(2).margin(0.2));
  CHECK(order<2>(rubber, 8, 2, isochoric_text) == Approx(3).margin(0.25));
  CHECK(order<3>(neo_hookean, 3, 1) == Approx(2).margin(0.25));
  CHECK(order<3>(neo_hookean, 2, 2) == Approx(3).margin(0.3));
}


TEST_CASE("patch test: a uniform strain is exact on cells of any shape", "[solid][mpi]")
{
  for (const auto &material : Registry<Material>::instance().names())
    for (const unsigned int degree : {1, 2})
      {
        INFO(material << " " << degree);
        const std::string uniform = "0.1*x+0.2*y; -0.1*x+0.05*y";
        Solid<2>          solid(
          one_body("set Cells = 3, 3\n set Map = x+0.1*sin(6*x)*sin(5*y); y-0.1*sin(5*x)*sin(6*y)\n"
                            "set Density = 1\n" +
                     samples::elastic_lines({10., 0.3}) + "set Material = " + material,
                   boundary("all", "set Kind = prescribed motion\n set Displacement = " + uniform),
                   fmt::format("set Element degree = {}", degree),
                   "set Integrator = static"));
        solid.advance(1);
        CHECK(error_in_L2(solid.model, solid.state.displacement, Expression<2, 2>(uniform)) <
              1e-12);
      }
}
