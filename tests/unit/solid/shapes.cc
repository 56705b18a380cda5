// SPDX-License-Identifier: LGPL-2.1-or-later
#include "solid_scene.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace undine_tests;

namespace
{
  const std::string elastic =
    "\nset Density = 2\n set Young's modulus = 1\n set Poisson's ratio = 0.3";


  template <int dim>
  BodyMeasure<dim>
  measure(const std::string &keys, const std::string &boundaries = "")
  {
    const SolidModel<dim> model(read_scene_text(one_body(keys + elastic, boundaries)),
                                MPI_COMM_WORLD);
    return measure_bodies(model, model.vector())[0];
  }


  /// Area of the faces that a boundary selects.
  template <int dim>
  double
  area(const std::string &keys, const std::string &boundary_keys)
  {
    const SolidModel<dim> model(
      read_scene_text(one_body(keys + elastic, boundary("part", boundary_keys))), MPI_COMM_WORLD);
    double sum = 0;
    for (const auto &face : model.faces())
      sum += face.cell->face(face.face)->measure();
    return sum;
  }


  std::string
  refusal(const std::string &text)
  {
    try
      {
        SolidModel<2>(read_scene_text(text), MPI_COMM_WORLD);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "accepted";
  }


  /// Two unit squares with the physical line 7 on the left.
  const char *const two_squares = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1 0
6 2 1 0
$EndNodes
$Elements
3
1 1 2 7 1 1 4
2 3 2 1 1 1 2 5 4
3 3 2 1 1 2 3 6 5
$EndElements
)";
} // namespace


TEST_CASE("boxes: size, place, rotation and sides", "[solid][mpi]")
{
  const std::string corners =
    "set Lower corner = 1, 2\n set Upper corner = 3, 2.5\n set Cells = 4, 2";
  const auto plane = measure<2>(corners);
  CHECK(plane.volume == Approx(1));
  CHECK(plane.mass == Approx(2));
  CHECK(plane.centre_of_mass.distance({2, 2.25}) < 1e-14);
  CHECK(measure<2>("set Centre = 2, 3\n set Size = 4, 1").centre_of_mass.distance({2, 3}) < 1e-14);
  CHECK(area<2>(corners, "set Sides = left, top") == Approx(2.5));
  CHECK(area<2>(corners, "set Where = x - 1.9") == Approx(2.5));

  // Turned by a right angle, the left side looks down.
  CHECK(area<2>(corners + "\n set Rotation = 90", "set Sides = left\n set Where = 2.25-y") ==
        Approx(0.5));
  const std::string block = "set Upper corner = 1, 2, 3\n set Cells = 2, 1, 1";
  CHECK(measure<3>(block + "\n set Rotation = 10, 20, 30").volume == Approx(6));
  CHECK(area<3>(block, "set Sides = back") == Approx(2));
  // About x by a right angle, y goes to z: the bottom becomes the lowest side.
  CHECK(area<3>(block + "\n set Rotation = 90, 0, 0", "set Sides = bottom\n set Where = 1.5-z") ==
        Approx(3));
}


TEST_CASE("balls and cylinders: vertices on the surface, volume in second order", "[solid][mpi]")
{
  const double pi   = dealii::numbers::PI;
  const auto   ball = [](const unsigned int refinements) {
    return fmt::format("set Shape = ball\n set Radius = 2\n set Refinements = {}", refinements);
  };
  const double disk_errors[2] = {4 * pi - measure<2>(ball(2)).volume,
                                 4 * pi - measure<2>(ball(3)).volume};
  CHECK(disk_errors[0] / disk_errors[1] == Approx(4).margin(0.2));
  CHECK(area<2>(ball(3), "set Sides = surface") == Approx(4 * pi).epsilon(1e-3));
  const double ball_errors[2] = {32 * pi / 3 - measure<3>(ball(0)).volume,
                                 32 * pi / 3 - measure<3>(ball(1)).volume};
  CHECK(ball_errors[0] / ball_errors[1] == Approx(4).margin(0.6));

  const std::string cylinder = "set Shape = cylinder\n set Radius = 0.5\n set Length = 2\n"
                               "set Axis = y\n set Centre = 1, 2, 3\n set Refinements = 2";
  const auto        solid    = measure<3>(cylinder);
  CHECK(solid.volume == Approx(pi / 2).epsilon(0.03));
  CHECK(solid.centre_of_mass.distance({1, 2, 3}) < 1e-12);
  CHECK(area<3>(cylinder, "set Sides = start, end\n set Where = y-2.9") ==
        Approx(pi / 4).epsilon(0.03));

  const SolidModel<3> model(
    read_scene_text(one_body(cylinder + elastic, boundary("hull", "set Sides = surface"))),
    MPI_COMM_WORLD);
  unsigned int n_vertices = 0;
  for (const auto &face : model.faces())
    for (const unsigned int v : face.cell->face(face.face)->vertex_indices())
      {
        ++n_vertices;
        const auto x = face.cell->face(face.face)->vertex(v);
        CHECK(std::hypot(x[0] - 1, x[2] - 3) == Approx(0.5).epsilon(1e-12));
      }
  CHECK(dealii::Utilities::MPI::sum(n_vertices, MPI_COMM_WORLD) > 0);
}


TEST_CASE("a mesh from a Gmsh file", "[solid]")
{
  // Beside the scene, to which its name is relative.
  const auto name = std::filesystem::temp_directory_path() / "two_squares.msh";
  std::ofstream(name) << two_squares;
  const std::string keys = "set Shape = gmsh\n set File = two_squares.msh\n set Scale = 0.5\n"
                           "set Refinements = 1";
  CHECK(measure<2>(keys).volume == Approx(0.5));
  CHECK(area<2>(keys, "set Sides = 7") == Approx(0.5));
  std::ofstream(name) << "nothing";
  CHECK_THAT(refusal(one_body(keys + elastic)), Catch::Contains("is not a Gmsh mesh"));
  std::filesystem::remove(name);
  CHECK_THAT(refusal(one_body(keys + elastic)),
             Catch::Contains("two_squares.msh' cannot be read") && Catch::Contains("key 'File'"));
}


TEST_CASE("maps move vertices at rest, and are refused if they invert cells", "[solid][mpi]")
{
  CHECK(measure<2>("set Cells = 8, 1\n set Map = x; y*(1+x)").volume == Approx(1.5));
  CHECK_THAT(refusal(one_body("set Map = -x; y" + elastic)), Catch::Contains("key 'Map'"));
}


TEST_CASE("bodies that touch stay separate, with a numbering of their own", "[solid][mpi]")
{
  const auto body = [](const std::string &name, const std::string &keys) {
    return "subsection " + name + "\n" + keys + elastic + "\nend\n";
  };
  const SolidModel<2> model(
    read_scene_text("subsection Bodies\n" + body("lower", "set Cells = 2, 2") +
                    body("upper", "set Lower corner = 0, 1\n set Upper corner = 1, 3") + "end\n"),
    MPI_COMM_WORLD);
  CHECK(model.dof_handler().n_dofs() == 2 * (25 + 9));
  CHECK(measure_bodies(model, model.vector())[1].volume == Approx(2));

  auto                          order = model.canonical_order();
  std::vector<dealii::Point<2>> position(order.size());
  for (unsigned int dof = 0; dof < order.size(); ++dof)
    position[order[dof]] = model.rest_position(dof);
  // The first cell's vertices come first, whatever the number of ranks.
  CHECK(position[0].distance({0, 0}) < 1e-14);
  CHECK(position[2].distance({0.5, 0}) < 1e-14);
  std::sort(order.begin(), order.end());
  for (unsigned int i = 0; i < order.size(); ++i)
    CHECK(order[i] == i);
}


TEST_CASE("what the scene says wrongly about bodies is refused with the keys", "[solid]")
{
  const auto part = [](const std::string &keys) {
    return refusal(one_body("set Cells = 2, 2" + elastic, boundary("root", keys)));
  };
  CHECK_THAT(part("set Sides = lefft"), Catch::Contains("left") && Catch::Contains("Bodies/body"));
  CHECK_THAT(part("set Where = x - 2"), Catch::Contains("selects no face"));
  CHECK_THAT(part("set Kind = glue"), Catch::Contains("prescribed motion"));
  CHECK_THAT(part("set Components = z"), Catch::Contains("x | y"));
  CHECK_THAT(part("set Components ="), Catch::Contains("names no direction"));
  CHECK_THAT(part("set Kind = traction"), Catch::Contains("'Traction': must be given"));
  CHECK_THAT(part("set Kind = pressure"), Catch::Contains("'Pressure': must be given"));
  CHECK_THAT(part("set Kind = prescribed motion"), Catch::Contains("'Displacement': must be"));
  CHECK_THAT(part("set Pressure = 1"), Catch::Contains("'Pressure': is not used"));
  CHECK_THAT(part("set Kind = pressure\n set Pressure = 1\n set Components = x"),
             Catch::Contains("'Components': is not used"));
  CHECK_THAT(refusal(one_body("set Shape = blob" + elastic)), Catch::Contains("ball"));
  CHECK_THAT(refusal(one_body("set Lower corner = 2, 0" + elastic)),
             Catch::Contains("Upper corner"));
  CHECK_THAT(refusal(one_body("set Rotation = 1, 2" + elastic)), Catch::Contains("1 number"));
  CHECK_THAT(refusal(one_body("set Size = 1, 1\n set Lower corner = 0, 0" + elastic)),
             Catch::Contains("either"));
  CHECK_THAT(refusal(one_body("set Cells = 2, 2")), Catch::Contains("Density"));
}


TEST_CASE("supports that make no sense are refused", "[solid]")
{
  const auto supports = [](const std::string &parts, const std::string &integrator = "theta") {
    return refusal(
      one_body("set Cells = 2, 2" + elastic, parts, "", "set Integrator = " + integrator));
  };
  const auto all = boundary("a", "");
  CHECK_THAT(supports(all + boundary("b", "set Sides = left")),
             Catch::Contains("Boundaries/b") && Catch::Contains("not hold already"));
  CHECK_THAT(supports("", "static"), Catch::Contains("nothing holds the body"));
  CHECK_THAT(supports(boundary("a", "set Sides = left\n set Components = x"), "static"),
             Catch::Contains("1 of the 3 rigid motions"));
  const auto moved = [](const std::string &displacement) {
    return boundary("a", "set Kind = prescribed motion\n set Displacement = " + displacement);
  };
  CHECK_THAT(supports(moved("0; 0.1*cos(t)")),
             Catch::Contains("Boundaries/a") && Catch::Contains("0.1 m at t = 0 along y") &&
               Catch::Contains("0 m") && Catch::Contains("body 'body'"));
  SolidModel<2>(
    read_scene_text(one_body(
      "set Cells = 2, 2" + elastic, moved("0; 0.1*cos(t)"), "", "set Integrator = static")),
    MPI_COMM_WORLD);
  SolidModel<2>(
    read_scene_text(one_body("set Cells = 2, 2\n set Initial displacement = 0; 0.1" + elastic,
                             moved("0; 0.1*cos(t)"))),
    MPI_COMM_WORLD);
}


TEST_CASE("points of a body", "[solid][mpi]")
{
  SolidModel<2> model(
    read_scene_text(one_body("set Cells = 3, 2\n set Map = x+0.1*x*y; y" + elastic)),
    MPI_COMM_WORLD);
  auto field = model.vector();
  for (const auto dof : model.locally_owned())
    field(dof) = model.axis(dof) == 0 ? 3 * model.rest_position(dof)[1] : 1.;
  field.compress(dealii::VectorOperation::insert);
  CHECK(SolidPoint<2>(model, "body", {0.4, 0.3}).value(field)[0] == Approx(0.9));
  CHECK(SolidPoint<2>(model, "body", {1.1, 1}).value(field)[1] == Approx(1));
  CHECK_THROWS_WITH(SolidPoint<2>(model, "body", {2, 0}), Catch::Contains("(2, 0)"));
  CHECK_THROWS_WITH(SolidPoint<2>(model, "bode", {0, 0}), Catch::Contains("Allowed: body"));
}
