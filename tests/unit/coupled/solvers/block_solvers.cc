// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>
#include <undine/base/core/registry.h>
#include <undine/base/multigrid/cell_preconditioner.h>

#include <undine/coupled/linear/block_preconditioner.h>

using namespace undine_tests;

namespace
{
  /// A jet against a sheet on the floor.
  template <int dim>
  std::string
  jet_on_sheet(const std::string &coupling, const std::string &numerics)
  {
    const std::string right = plane_or_space<dim>("1.5; 0", "1.5; 0; 0");
    return steps_of(1. / 30) +
           section("Domain", plane_or_space<dim>("set Cells = 20, 20", "set Cells = 10, 10, 9")) +
           section("Fluid",
                   "set Density = 5\nset Initial velocity = " + right + "\n" +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + right) +
                               boundary("out", "right", "outflow"))) +
           section("Bodies",
                   body("sheet",
                        plane_or_space<dim>(
                          "set Lower corner = .5, 0\nset Upper corner = .53, .6\nset Cells = 1, 5",
                          "set Lower corner = .5, 0, .2\nset Upper corner = .53, .6, .7\nset "
                          "Cells = 1, 5, 4") +
                          "\nset Density = 20\nset Young's modulus = 1e5\nset Poisson's ratio = .3",
                        clamp("foot", "1", "set Sides = bottom"))) +
           section("Effects", convection()) + section("Coupling", coupling) +
           section("Solid numerics", numerics);
  }


  /// Linear systems are solved as far as the linear tolerance says.
  const std::string exact = "\nset Inexact Newton = false";


  struct StepResult
  {
    double force, position, iterations;
  };


  template <int dim>
  StepResult
  after_steps(const std::string &coupling, const std::string &numerics = exact)
  {
    CoupledRun<dim> run(jet_on_sheet<dim>(coupling, numerics));
    double          most = 0;
    for (unsigned int n = 0; n < 3; ++n)
      {
        run.step();
        CHECK(run.report.warnings.empty());
        CHECK(run.column("Fluid divergence") <= 1e-10);
        CHECK(run.column("momentum residual sheet") <= 1e-9);
        most = std::max(most, run.column("Most iterations of a solve"));
      }
    return {run.column("pressure force sheet x"), run.column("centre of mass sheet x"), most};
  }


  /// GMRES with every preconditioner that is registered, and either way to stand for A^-1, against
  /// sparse factors of everything.
  template <int dim>
  void
  check_solvers()
  {
    const auto direct = after_steps<dim>("set Linear solver = direct");
    CHECK(direct.iterations == 0);
    CHECK(std::abs(direct.position - .515) > 1e-3);
    const auto compare = [&](const StepResult &result, const double most) {
      CHECK(result.force == Approx(direct.force).epsilon(1e-7));
      CHECK(result.position - .515 == Approx(direct.position - .515).epsilon(1e-7));
      CHECK(result.iterations > 0);
      CHECK(result.iterations <= most);
    };
    // Iterations at most; one that is not listed may take as many as the weakest.
    const std::map<std::string, double> most{{"band correction", 12}, {"block triangular", 20}};
    for (const auto &name : Registry<BlockPreconditioner>::instance().names())
      {
        INFO(name);
        const auto bound = most.count(name) > 0 ? most.at(name) : 20;
        compare(after_steps<dim>("set Preconditioner = " + name), bound);
        compare(
          after_steps<dim>("set Preconditioner = " + name, "set Linear solver = multigrid" + exact),
          bound);
        // Where corrections keep the tangent and solve no further than they gain.
        compare(after_steps<dim>("set Preconditioner = " + name, ""), bound);
      }
    compare(after_steps<dim>("", "set Linear solver = multigrid"), 20);
    for (const auto &name : Registry<CellPreconditioner>::instance().names())
      {
        INFO(name);
        compare(after_steps<dim>("set Multigrid = " + name), 25);
      }
  }
} // namespace


TEST_CASE("Iterations find what sparse factors of the whole matrix do", "[coupled][mpi]")
{
  check_solvers<2>();
}


TEST_CASE("Iterations find what sparse factors of the whole matrix do in space", "[coupled]")
{
  check_solvers<3>();
}


TEST_CASE("Where GMRES gives up the matrix is factorised, with a note", "[coupled][mpi]")
{
  CoupledRun<2> run(jet_on_sheet<2>("set Maximum iterations = 1", ""));
  run.step();
  REQUIRE(run.report.warnings.size() == 1);
  CHECK(run.report.warnings.front().text.find("solved directly") != std::string::npos);
  CHECK(run.column("Fluid divergence") <= 1e-10);
}


TEST_CASE("A soft thin plate in water takes few iterations, by the band around it", "[coupled]")
{
  // Of all bending modes that the water moves the approximation of S knows none.
  const auto most_iterations = [](const std::string &coupling) {
    CoupledRun<3> run(
      steps_of(1. / 240) + section("Domain", "set Cells = 12, 14, 14") +
      section(
        "Fluid",
        "set Density = 1000\n" +
          section("Boundaries", boundary("open", "top, bottom", "pressure", "set Pressure = 0"))) +
      section("Bodies",
              body("plate",
                   "set Lower corner = -.2, .349, -.2\nset Upper corner = 1.2, .3502, 1.2\nset "
                   "Cells = 7, 1, 7\nset Density = 100\nset Young's modulus = 6e4\nset Poisson's "
                   "ratio = .35\nset Load = 0; 1000; 0",
                   clamp("rim", "max(-x, x-1)"))) +
      section("Coupling", coupling) + section("Solid numerics", exact));
    run.step();
    CHECK(run.report.warnings.empty());
    return run.column("Most iterations of a solve");
  };
  CHECK(most_iterations("") <= 55);
  CHECK(most_iterations("set Preconditioner = block triangular\nset Maximum iterations = 1000") >
        80);
}
