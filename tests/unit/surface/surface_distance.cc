// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/shape_boundary.h>
#include <undine/surface/surface_distance.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>
#include <message_of.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <unistd.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  ShapeBoundary<dim>
  boundary_of(const std::string &keys)
  {
    const auto options = read_scene_text(section("shape", keys)).section("shape");
    return make_shape_boundary(ShapeDescription<dim>("shape", options));
  }


  template <int dim>
  double
  volume_of(const ShapeBoundary<dim> &boundary)
  {
    return body_volumes(boundary.surface("shape"), boundary.nodes)[0];
  }


  /// Distance from the box [0, 1]^dim, negative inside.
  template <int dim>
  double
  distance_of_box(const dealii::Point<dim> &place)
  {
    double outside = 0, inside = -1e100;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const double beyond = std::abs(place[axis] - 0.5) - 0.5;
        outside += std::pow(std::max(beyond, 0.), 2);
        inside = std::max(inside, beyond);
      }
    return inside < 0 ? inside : std::sqrt(outside);
  }


  /// A file that is gone at the end.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &bytes)
      : name("/tmp/undine_surface_" + std::to_string(getpid()))
    {
      std::ofstream(name, std::ios::binary) << bytes;
    }

    ~TemporaryFile()
    {
      std::remove(name.c_str());
    }

    const std::string name;
  };


  using Triangle = std::array<dealii::Point<3>, 3>;


  /// The simplex with corners 0 and 2 along each axis, as triangles.
  std::vector<Triangle>
  simplex()
  {
    const dealii::Point<3> o, x(2, 0, 0), y(0, 2, 0), z(0, 0, 2);
    return {{{o, y, x}}, {{o, x, z}}, {{o, z, y}}, {{x, y, z}}};
  }


  std::string
  text_stl(const std::vector<Triangle> &triangles)
  {
    std::string text = "solid thing\n";
    for (const auto &triangle : triangles)
      {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const auto &corner : triangle)
          text += fmt::format("  vertex {} {} {}\n", corner[0], corner[1], corner[2]);
        text += " endloop\nendfacet\n";
      }
    return text + "endsolid thing\n";
  }


  template <class Number>
  void
  append(std::string &bytes, const Number number)
  {
    bytes.append(reinterpret_cast<const char *>(&number), sizeof(number));
  }


  std::string
  binary_stl(const std::vector<Triangle> &triangles)
  {
    std::string bytes(80, ' ');
    append(bytes, static_cast<std::uint32_t>(triangles.size()));
    for (const auto &triangle : triangles)
      {
        for (unsigned int k = 0; k < 3; ++k)
          append(bytes, 0.f);
        for (const auto &corner : triangle)
          for (unsigned int axis = 0; axis < 3; ++axis)
            append(bytes, static_cast<float>(corner[axis]));
        append(bytes, std::uint16_t(0));
      }
    return bytes;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "surface distance: of a box, on all sides, edges and corners", "", ((int dim), dim), 2, 3)
{
  const auto                             boundary = boundary_of<dim>("set Shape = box");
  const SurfaceDistance<dim>             surface(boundary.surface("box"), boundary.nodes);
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> anywhere(-1, 2);
  for (unsigned int k = 0; k < 2000; ++k)
    {
      dealii::Point<dim> place;
      for (unsigned int axis = 0; axis < dim; ++axis)
        place[axis] = anywhere(random);
      const auto nearest = surface.nearest(place);
      REQUIRE(nearest.distance == Approx(distance_of_box(place)).margin(1e-12));
      REQUIRE(nearest.place.distance(place) == Approx(std::abs(nearest.distance)).margin(1e-12));
    }
}


TEMPLATE_TEST_CASE_SIG("surface distance: of a ball", "", ((int dim), dim), 2, 3)
{
  const auto                 boundary = boundary_of<dim>("set Shape = ball\n set Radius = 2");
  const SurfaceDistance<dim> surface(boundary.surface("ball"), boundary.nodes);
  for (double r = 0.2; r < 4; r += 0.1)
    {
      dealii::Point<dim> place;
      for (unsigned int axis = 0; axis < dim; ++axis)
        place[axis] = r * (axis + 1) / std::sqrt(dim == 2 ? 5. : 14.);
      CHECK(surface.nearest(place).distance == Approx(r - 2).margin(0.01));
    }
}


TEST_CASE("surface file: STL as text and binary, turned outwards, scaled")
{
  auto triangles = simplex();
  for (const bool inside_out : {false, true})
    {
      if (inside_out)
        for (auto &triangle : triangles)
          std::swap(triangle[0], triangle[1]);
      for (const auto &bytes : {text_stl(triangles), binary_stl(triangles)})
        {
          const TemporaryFile file(bytes);
          const auto          boundary =
            boundary_of<3>("set Surface = " + file.name + "\n set Surface scale = 3");
          CHECK(boundary.nodes.size() == 4);
          CHECK(boundary.facets.size() == 4);
          CHECK(volume_of(boundary) == Approx(27 * 8. / 6));
        }
    }
}


TEST_CASE("surface file: Gmsh's triangles and lines")
{
  const TemporaryFile solid("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 2 0 0\n"
                            "3 0 2 0\n4 0 0 2\n$EndNodes\n$Elements\n4\n1 2 2 1 1 1 3 2\n"
                            "2 2 2 1 1 1 2 4\n3 2 2 1 1 1 4 3\n4 2 2 1 1 2 3 4\n$EndElements\n");
  CHECK(volume_of(boundary_of<3>("set Surface = " + solid.name)) == Approx(8. / 6));
  const TemporaryFile plane("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 2 0 0\n"
                            "3 0 2 0\n$EndNodes\n$Elements\n3\n1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n"
                            "3 1 2 1 1 3 1\n$EndElements\n");
  CHECK(volume_of(boundary_of<2>("set Surface = " + plane.name)) == Approx(2));
}


TEST_CASE("surface file: what is no closed surface is refused")
{
  const auto refused = [](const std::string &bytes, const std::string &keys = "") {
    const TemporaryFile file(bytes);
    return message_of([&] { boundary_of<3>("set Surface = " + file.name + "\n" + keys); });
  };
  auto triangles = simplex();
  CHECK_THAT(refused(text_stl(triangles), "set Shape = ball"),
             Catch::Matchers::Contains("contradicts"));
  triangles.pop_back();
  CHECK_THAT(refused(text_stl(triangles)), Catch::Matchers::Contains("is open"));
  CHECK_THAT(refused("solid\n"), Catch::Matchers::Contains("holds no facet"));
  CHECK_THAT(refused("nonsense"), Catch::Matchers::Contains("neither an STL file nor"));
}
