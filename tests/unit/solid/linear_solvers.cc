// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/mass_matrix.h>
#include <undine/solid/assembly/sparse.h>
#include <undine/solid/mesh/rigid_motions.h>
#include <undine/solid/solvers/tangent_solver.h>

#include <catch2/catch.hpp>

#include <limits>

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  beam(const std::string &solver, const unsigned int cells, const std::string &modulus = "1000")
  {
    return one_body(
      fmt::format("set Upper corner = {}\n set Cells = {}\n set Density = 1\n"
                  "set Young's modulus = {}\n set Poisson's ratio = 0.3",
                  plane_or_space<dim>("4, 1", "4, 1, 1"),
                  plane_or_space<dim>(fmt::format("{}, {}", 4 * cells, cells),
                                      fmt::format("{}, {}, {}", 4 * cells, cells, cells)),
                  modulus),
      boundary("root", "set Sides = left"),
      "set Linear solver = " + solver + "\n set Inexact Newton = false",
      "set Integrator = static");
  }


  template <int dim>
  dealii::Tensor<1, dim>
  sag(const std::string &solver,
      const unsigned int cells,
      unsigned int      &iterations,
      const std::string &modulus = "1000",
      const double       weight  = 1)
  {
    SolidEnvironment<dim> gravity;
    gravity.gravity[1] = -weight;
    Solid<dim>         solid(beam<dim>(solver, cells, modulus), gravity);
    const auto         report = solid.advance(1);
    dealii::Point<dim> tip;
    tip[0]     = 4;
    iterations = report.newton.linear_iterations / std::max(report.newton.iterations, 1u);
    CHECK(report.note.empty());
    return solid.displacement(tip);
  }
} // namespace


TEST_CASE("multigrid and factorisation agree; multigrid knows rotations", "[solid][mpi]")
{
  unsigned int none, few;
  CHECK((sag<2>("direct", 12, none) - sag<2>("multigrid", 12, few)).norm() < 1e-9);
  CHECK(none == 0);
  CHECK(few > 0);
  CHECK(few < 60); // with translations alone several times as many
  CHECK((sag<3>("direct", 2, none) - sag<3>("multigrid", 2, few)).norm() < 1e-9);
  CHECK(few < 60);
}


TEST_CASE("steel: stiffness is no matter of units for the solvers", "[solid][mpi]")
{
  unsigned int none, few;
  for (const double weight : {2e8, 10.}) // bent strongly, and hardly at all
    {
      const auto direct = sag<2>("direct", 12, none, "2e11", weight);
      CHECK((direct - sag<2>("multigrid", 12, few, "2e11", weight)).norm() < 1e-8 * direct.norm());
      CHECK(few < 60);
      if (weight > 1e8) // as the beam of 1000 Pa under a weight of 1
        CHECK((direct - sag<2>("direct", 12, none)).norm() < 1e-8 * direct.norm());
    }
}


TEST_CASE("follower pressure: the unsymmetric tangent is solved iteratively too", "[solid][mpi]")
{
  const auto bent = [](const std::string &solver) {
    Solid<2> solid(
      one_body("set Upper corner = 4, 1\n set Cells = 48, 12\n set Density = 1\n"
               "set Young's modulus = 1000\n set Poisson's ratio = 0.3",
               boundary("root", "set Sides = left") +
                 boundary("roof", "set Sides = top\n set Kind = pressure\n set Pressure = 4"),
               "set Linear solver = " + solver + "\n set Inexact Newton = false",
               "set Integrator = static"));
    const auto report = solid.advance(1);
    CHECK(report.note.empty());
    CHECK(report.newton.iterations < 8);
    return solid.displacement({4, 0});
  };
  CHECK((bent("direct") - bent("multigrid")).norm() < 1e-9);
}


TEST_CASE("rigid motions cost no elastic energy to first order", "[solid][mpi]")
{
  const Solid<3> solid(beam<3>("direct", 1));
  const auto     zero    = solid.model.vector();
  const auto     K       = internal_stiffness(solid.model, zero);
  const auto     motions = rigid_motions(solid.model, zero);
  REQUIRE(motions.NumVectors() == 6);
  REQUIRE(K.linfty_norm() > 1);
  // Seen by nodes whose neighbours are all free: the far half of the beam.
  for (int motion = 0; motion < 6; ++motion)
    {
      auto x = solid.model.vector(), force = solid.model.vector();
      for (unsigned int row = 0; row < solid.model.locally_owned().n_elements(); ++row)
        x(solid.model.locally_owned().nth_index_in_set(row)) = motions[motion][row];
      x.compress(dealii::VectorOperation::insert);
      CHECK(x.l2_norm() > 1);
      K.vmult(force, x);
      unsigned int n_free = 0;
      for (const auto dof : solid.model.locally_owned())
        if (solid.model.rest_position(dof)[0] > 2)
          {
            ++n_free;
            CHECK(std::abs(force(dof)) < 1e-9);
          }
      CHECK(dealii::Utilities::MPI::sum(n_free, MPI_COMM_WORLD) > 0);
    }
}


TEST_CASE("an indefinite tangent is solved directly, and that is said", "[solid][mpi]")
{
  // The stiffness less a mass that outweighs it in many modes.
  const Solid<2> solid(beam<2>("multigrid", 12));
  auto           A = internal_stiffness(solid.model, solid.model.vector());
  A.add(-1e6, mass_matrix(solid.model));
  fix_rows_and_columns(A, solid.model.all_fixed());
  auto b = solid.model.vector();
  for (const auto dof : solid.model.locally_owned())
    b(dof) = std::sin(solid.model.rest_position(dof)[0] * 3) + solid.model.axis(dof);
  b.compress(dealii::VectorOperation::insert);

  TangentSolver<2> solver(solid.model);
  solver.initialize(A, solid.model.vector());
  const auto x      = solver.solve(b);
  auto       defect = solid.model.vector();
  A.vmult(defect, x);
  defect.add(-1., b);
  CHECK(defect.l2_norm() < 1e-8 * b.l2_norm());
  CHECK_THAT(solver.note(), Catch::Contains("solved directly"));
}


TEST_CASE("a singular tangent is an error on all ranks", "[solid][mpi]")
{
  // Debug: what deal.II asserts about the numbers shall reach the solver, as it does in Release.
  dealii::deal_II_exceptions::disable_abort_on_exception();
  for (const std::string name : {"direct", "multigrid"})
    {
      INFO(name);
      const Solid<2>   solid(beam<2>(name, 12));
      const auto       zero = solid.model.vector();
      auto             b    = zero;
      TangentSolver<2> solver(solid.model);
      b.add(1.);
      const auto nothing = solid.model.matrix();
      solver.initialize(nothing, zero);
      CHECK_THROWS_AS(solver.solve(b), SolveError);
      auto not_a_number = internal_stiffness(solid.model, zero);
      not_a_number *= std::numeric_limits<double>::quiet_NaN();
      solver.initialize(not_a_number, zero);
      CHECK_THROWS_AS(solver.solve(b), SolveError);
    }
}
