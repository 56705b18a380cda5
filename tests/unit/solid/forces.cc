// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/loads.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <random>

using namespace undine_tests;

namespace
{
  /// A body of eight or so cells of no special shape.
  template <int dim>
  std::string
  block(const std::string &material,
        const unsigned int degree,
        const std::string &keys           = "",
        const std::string &boundaries     = "",
        const double       poissons_ratio = 0.3)
  {
    const std::string map =
      plane_or_space<dim>("x+0.1*y*x; 0.7*y+0.05*x*y", "x+0.1*y*z; 0.7*y+0.05*x*z; 0.8*z-0.1*x*y");
    return one_body(fmt::format("set Cells = {}\n set Map = {}\n set Density = 3\n"
                                "set Material = {}\n{}{}",
                                plane_or_space<dim>("3, 2", "2, 1, 1"),
                                map,
                                material,
                                samples::elastic_lines({10., poissons_ratio}),
                                keys),
                    boundaries,
                    fmt::format("set Element degree = {}", degree));
  }


  /// Nodal values at random, the same for every number of ranks.
  template <int dim>
  Vector
  random_field(const SolidModel<dim> &model, const double size, const unsigned int seed)
  {
    std::mt19937        engine(seed);
    std::vector<double> values(model.dof_handler().n_dofs());
    for (auto &value : values)
      value = size * (2. * engine() / std::mt19937::max() - 1);
    const auto order = model.canonical_order();
    auto       field = model.vector();
    for (const auto dof : model.locally_owned())
      field(dof) = values[order[dof]];
    field.compress(dealii::VectorOperation::insert);
    return field;
  }


  Vector
  sum(const Vector &a, const double factor, const Vector &b)
  {
    Vector result = a;
    result.add(factor, b);
    return result;
  }


  Vector
  product(const Matrix &A, const Vector &x)
  {
    Vector result = x;
    A.vmult(result, x);
    return result;
  }


  /// |A dx - df| / |A dx| with df by central differences.
  template <class Force>
  double
  tangent_error(const Matrix &A, const Vector &x, const Vector &direction, const Force &force)
  {
    const double step = 1e-6;
    const Vector difference =
      sum(force(sum(x, step, direction)), -1, force(sum(x, -step, direction)));
    const Vector predicted = product(A, direction);
    Vector       error     = difference;
    error *= 1 / (2 * step);
    error.add(-1., predicted);
    return error.l2_norm() / predicted.l2_norm();
  }


  template <int dim>
  void
  check_tangent(const std::string &material, const unsigned int degree, const std::string &keys)
  {
    INFO(material << ", degree " << degree << ", " << dim << "D " << keys);
    const Solid<dim> solid(block<dim>(material, degree, keys));
    const auto       d = random_field(solid.model, 0.03 / degree, 1);
    const auto       a = random_field(solid.model, 1, 2);
    const auto       b = random_field(solid.model, 1, 3);
    const auto       A = internal_stiffness(solid.model, d);
    CHECK(tangent_error(A, d, a, [&](const Vector &x) { return internal_forces(solid.model, x); }) <
          1e-7);
    CHECK(b * product(A, a) == Approx(a * product(A, b)).epsilon(1e-12));

    const double step = 1e-6;
    CHECK((elastic_energy(solid.model, sum(d, step, a)) -
           elastic_energy(solid.model, sum(d, -step, a))) /
            (2 * step) ==
          Approx(internal_forces(solid.model, d) * a).epsilon(1e-6));
  }


  /// Viscous forces: the tangent by differences; K' at rest; no negative work, however a body is
  /// deformed.
  template <int dim>
  void
  check_viscosity(const std::string &material, const unsigned int degree, const std::string &keys)
  {
    INFO(material << ", degree " << degree << ", " << dim << "D " << keys);
    const Solid<dim> solid(block<dim>(material, degree, keys));
    const auto      &model = solid.model;
    const auto       d     = random_field(model, 0.03 / degree, 1);
    const auto       u     = random_field(model, 1, 2);
    const auto       a     = random_field(model, 1, 3);
    const double     of_d = 0.7, of_u = 0.4;
    CHECK(tangent_error(
            viscous_stiffness(model, d, u, of_d, of_u), model.vector(), a, [&](const Vector &x) {
              return viscous_forces(model, sum(d, of_d, x), sum(u, of_u, x));
            }) < 1e-7);

    const auto zero    = model.vector();
    const auto at_rest = product(internal_stiffness(model, zero), u);
    CHECK(sum(viscous_forces(model, zero, u), -1, at_rest).l2_norm() <= 1e-12 * at_rest.l2_norm());

    const auto crumpled = random_field(model, 0.3, 4);
    for (const auto *velocity : {&u, &a})
      CHECK(viscous_forces(model, crumpled, *velocity) * *velocity > 0);
  }


  /// x -> R x - x for a rotation that is not small.
  template <int dim>
  Vector
  rotated(const SolidModel<dim> &model)
  {
    const double c = std::cos(2.), s = std::sin(2.);
    auto         field = model.vector();
    for (const auto dof : model.locally_owned())
      {
        const auto x = model.rest_position(dof);
        auto       y = x;
        y[0]         = c * x[0] - s * x[1] + 5;
        y[1]         = s * x[0] + c * x[1];
        field(dof)   = y[model.axis(dof)] - x[model.axis(dof)];
      }
    field.compress(dealii::VectorOperation::insert);
    return field;
  }
} // namespace


TEST_CASE("internal forces: tangent and energy by differences, for every law", "[solid][mpi]")
{
  for (const auto &material : Registry<Material>::instance().names())
    for (const unsigned int degree : {1, 2})
      {
        check_tangent<2>(material, degree, "set Plane state = plane strain");
        check_tangent<2>(material, degree, "set Plane state = plane stress");
        check_tangent<3>(material, degree, "");
      }
}


TEST_CASE("a rigid rotation leaves bodies without force", "[solid][mpi]")
{
  for (const auto &material : Registry<Material>::instance().names())
    if (Registry<Material>::instance().make(material)->is_objective())
      for (const unsigned int degree : {1, 2})
        {
          INFO(material << ", degree " << degree);
          const Solid<2> plane(block<2>(material, degree));
          CHECK(internal_forces(plane.model, rotated(plane.model)).linfty_norm() < 1e-12);
          const Solid<3> space(block<3>(material, degree));
          CHECK(internal_forces(space.model, rotated(space.model)).linfty_norm() < 1e-12);
        }
}


TEST_CASE("viscous forces: tangent by differences, stiffness at rest, no work is put in",
          "[solid][mpi]")
{
  for (const auto &material : Registry<Material>::instance().names())
    for (const unsigned int degree : {1, 2})
      {
        check_viscosity<2>(material, degree, "set Plane state = plane strain");
        check_viscosity<2>(material, degree, "set Plane state = plane stress");
        check_viscosity<3>(material, degree, "");
      }
}


TEST_CASE("viscosity spares a body that is strained and rotates", "[solid][mpi]")
{
  for (const std::string material : {"neo-Hookean", "nearly incompressible rubber"})
    {
      const Solid<3> solid(block<3>(material, 1));
      const auto     d        = random_field(solid.model, 0.03, 1);
      auto           rotation = solid.model.vector();
      const auto     ghosted  = solid.model.ghosted(d);
      // The velocity of every node is across its present place.
      const auto &geometry = solid.model.geometry();
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          const auto dofs = geometry.dofs(cell);
          for (unsigned int node = 0; node < geometry.n_nodes(); ++node)
            {
              const auto   first = dofs[node * 3], second = dofs[node * 3 + 1];
              const double x = solid.model.rest_position(first)[0] + ghosted(first);
              const double y = solid.model.rest_position(second)[1] + ghosted(second);
              if (solid.model.locally_owned().is_element(first))
                rotation(first) = -y;
              if (solid.model.locally_owned().is_element(second))
                rotation(second) = x;
            }
        }
      rotation.compress(dealii::VectorOperation::insert);
      const auto other = random_field(solid.model, 1, 2);
      CHECK(viscous_forces(solid.model, d, rotation).l2_norm() <
            1e-12 * viscous_forces(solid.model, d, other).l2_norm());
    }
}


TEST_CASE(
  "viscosity of nearly incompressible bodies is that of their shape where they keep their volume",
  "[solid][mpi]")
{
  const auto dissipation = [](const double ratio) {
    const Solid<2> solid(block<2>("nearly incompressible rubber", 2, "", "", ratio));
    auto           d = solid.model.vector(), u = d;
    for (const auto dof : solid.model.locally_owned()) // stretched by 1.5, and further
      {
        const auto   axis    = solid.model.axis(dof);
        const double x       = solid.model.rest_position(dof)[axis];
        const double stretch = axis == 0 ? 1.5 : 1 / 1.5;
        d(dof)               = (stretch - 1) * x;
        u(dof)               = (axis == 0 ? 1 : -1) * stretch * x;
      }
    d.compress(dealii::VectorOperation::insert);
    u.compress(dealii::VectorOperation::insert);
    return viscous_forces(solid.model, d, u) * u;
  };
  // The shear modulus is E/3 in the limit; the bulk modulus grows a hundred times.
  CHECK(dissipation(0.49999) == Approx(dissipation(0.499)).epsilon(2e-3));
}


TEST_CASE("follower pressure: tangent by differences, work by volume", "[solid][mpi]")
{
  const auto keys = [](const std::string &sides) {
    return boundary("wet", "set Kind = pressure\n set Pressure = 2\n set Sides = " + sides);
  };
  const Solid<3> top(block<3>("neo-Hookean", 2, "", keys("top, left")));
  const auto     d = random_field(top.model, 0.02, 1);
  const auto     a = random_field(top.model, 1, 2);
  CHECK(tangent_error(pressure_stiffness(top.model, d, 0), d, a, [&](const Vector &x) {
          return pressure_loads(top.model, x, 0);
        }) < 1e-7);

  // Over a closed surface the pressure is the gradient of -p times the volume.
  const Solid<2> all(block<2>("neo-Hookean", 2, "", keys("left, right, bottom, top")));
  const auto     e      = random_field(all.model, 0.02, 3);
  const auto     b      = random_field(all.model, 1, 4);
  const double   step   = 1e-5;
  const auto     volume = [&](const double factor) {
    return measure_bodies(all.model, sum(e, factor, b))[0].volume;
  };
  CHECK(pressure_loads(all.model, e, 0) * b ==
        Approx(-2 * (volume(step) - volume(-step)) / (2 * step)).epsilon(1e-8));
}


TEST_CASE("follower pressure on a sheet in plane stress acts on its deformed edge", "[solid][mpi]")
{
  const std::string sheet = "set Plane state = plane stress";
  for (const auto &material : Registry<Material>::instance().names())
    {
      INFO(material);
      const Solid<2> bent(
        block<2>(material, 2, sheet, boundary("wet", "set Kind = pressure\n set Pressure = 2+x")));
      const auto d = random_field(bent.model, 0.02, 1);
      const auto a = random_field(bent.model, 1, 2);
      CHECK(tangent_error(pressure_stiffness(bent.model, d, 0), d, a, [&](const Vector &x) {
              return pressure_loads(bent.model, x, 0);
            }) < 1e-7);
    }

  // Squeezed alike from all sides: the true stress in the sheet is minus the pressure.
  const double pressure = 3;
  Solid<2>     squeezed(
    one_body("set Cells = 2, 1\n set Density = 1\n set Young's modulus = 10\n"
                 "set Poisson's ratio = 0.3\n" +
               sheet,
             boundary("left", "set Sides = left\n set Components = x") +
               boundary("floor", "set Sides = bottom\n set Components = y") +
               boundary("wet", "set Kind = pressure\n set Sides = right, top\n set Pressure = 3"),
             "set Inexact Newton = false",
             "set Integrator = static"));
  const auto &report = squeezed.advance(1);
  CHECK(report.newton.iterations < 8);
  const double         stretch = 1 + squeezed.displacement({1, 1})[0];
  dealii::Tensor<2, 2> H;
  H[0][0] = H[1][1] = stretch - 1;
  const auto &body  = squeezed.model.bodies()[0];
  const auto  point = body.kinematics->stress(*body.material, H);
  CHECK(stretch < 0.9);
  CHECK(point.thickness_stretch > 1.05);
  CHECK(point.stress[0][0] == Approx(-pressure * stretch * point.thickness_stretch));
  CHECK(squeezed.column("reaction body/left x") ==
        Approx(pressure * stretch * point.thickness_stretch));
}


TEST_CASE("dead loads add up to weight, load and traction", "[solid][mpi]")
{
  SolidEnvironment<3> environment;
  environment.gravity[2] = -10;
  const Solid<3>       solid(block<3>("neo-Hookean",
                                2,
                                "set Load = 0; x*t; 0",
                                boundary("end",
                                         "set Kind = traction\n set Sides = right\n"
                                               "set Traction = 7*t; 0; 0")),
                       environment);
  const auto           loads = dead_loads(solid.model, environment, 2);
  dealii::Tensor<1, 3> total;
  for (const auto dof : solid.model.locally_owned())
    total[solid.model.axis(dof)] += loads(dof);
  total           = dealii::Utilities::MPI::sum(total, MPI_COMM_WORLD);
  const auto body = measure_bodies(solid.model, solid.model.vector())[0];
  CHECK(body.mass == Approx(3 * body.volume));
  CHECK(total[2] == Approx(-10 * body.mass));
  CHECK(total[1] == Approx(2 * body.volume * body.centre_of_mass[0]));

  double area = 0;
  for (const auto &face : solid.model.faces())
    area += face.cell->face(face.face)->measure();
  CHECK(total[0] == Approx(14 * area).epsilon(1e-3)); // measure() takes warped faces as flat
}


TEST_CASE("an inverted cell is an error on all ranks, with body and place", "[solid][mpi]")
{
  const Solid<2> solid(block<2>("neo-Hookean", 1));
  auto           d = solid.model.vector();
  for (const auto dof : solid.model.locally_owned())
    if (solid.model.rest_position(dof)[0] > 0.9)
      d(dof) = solid.model.axis(dof) == 0 ? -1.5 : 0.;
  d.compress(dealii::VectorOperation::insert);
  CHECK_THROWS_WITH(internal_forces(solid.model, d), Catch::Contains("body 'body'"));
  CHECK_THROWS_AS(internal_stiffness(solid.model, d), SolveError);
  CHECK_THROWS_AS(elastic_energy(solid.model, d), SolveError);
}
