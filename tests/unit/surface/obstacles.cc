// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/body_forces.h>
#include <undine/operators/void_regions.h>
#include <undine/surface/immersed_surface.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <message_of.h>
#include <operators/immersed.h>
#include <solid/solid_scene.h>

#include <cmath>
#include <set>

using namespace undine_tests;

namespace
{
  Options
  obstacle(const std::string &keys, const std::string &more = "")
  {
    return read_scene_text("subsection Obstacles\nsubsection thing\n" + keys + "\nend\nend\n" +
                           more);
  }


  template <int dim>
  typename MacGrid<dim>::Planes
  unit_box(const int cells)
  {
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      for (int i = 0; i <= cells; ++i)
        planes[d].push_back(i / double(cells));
    return planes;
  }


  /// Volume of a ball of radius 1/2 after a number of refinements; all nodes lie on the sphere.
  template <int dim>
  double
  ball_volume(const unsigned int refinements)
  {
    const Obstacles<dim> obstacles(
      obstacle(plane_or_space<dim>("set Shape = ball\nset Centre = 1, 2\nset Radius = .5",
                                   "set Shape = ball\nset Centre = 1, 2, 3\nset Radius = .5") +
               "\nset Refinements = " + std::to_string(refinements)));
    dealii::Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = d + 1;
    const auto positions = obstacles.positions(0);
    for (const auto &x : positions)
      CHECK(x.distance(centre) == Approx(.5).epsilon(1e-13));
    check_closed(obstacles.surface(), positions);
    return body_volumes(obstacles.surface(), positions)[0];
  }


  template <int dim>
  Immersed<dim>
  immersed_box(const std::string &lower, const std::string &upper, const int cells)
  {
    const Obstacles<dim> obstacles(
      obstacle("set Lower corner = " + lower + "\nset Upper corner = " + upper));
    return Immersed<dim>(unit_box<dim>(cells), obstacles.surface(), obstacles.positions(0));
  }


  /// The volume of all fluid, and the area of the pieces on each side of the domain.
  template <int dim>
  std::pair<double, std::array<double, 2 * dim>>
  what_is_left(const Immersed<dim> &immersed)
  {
    using Kind         = typename SubLattice<dim>::Kind;
    const auto &grid   = immersed.grid;
    const auto &cells  = immersed.open().cells;
    double      volume = 0;
    for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      if (cells.kind(cell) == Kind::whole)
        volume += grid.cell_volume(cell);
      for (int k = cells.first(cell); k < cells.last(cell); ++k)
        volume += cells.all()[k].measure;
    });
    std::array<double, 2 * dim> areas{};
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const auto &faces = immersed.open().faces[axis];
        for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
          if (!grid.at_boundary(axis, face))
            return;
          double &area = areas[2 * axis + (face[axis] > 0)];
          if (faces.kind(face) == Kind::whole)
            area += grid.face_area(axis, face);
          for (int k = faces.first(face); k < faces.last(face); ++k)
            area += faces.all()[k].measure;
        });
      }
    for (double &area : areas)
      area = dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD);
    return {dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD), areas};
  }


  template <int dim>
  void
  check_uniform_flow(const Immersed<dim> &immersed)
  {
    const auto              velocity = all_equal<dim>(.7);
    const BoundaryFlux<dim> flux(immersed.cut, immersed.surface);
    const auto              from_surface =
      flux.flux(std::vector<dealii::Tensor<1, dim>>(immersed.surface.n_nodes(), velocity));
    const auto  through_face = immersed.divergence(velocity);
    const auto &components   = immersed.open().cells;
    for (unsigned int c = 0; c < components.all().size(); ++c)
      if (components.owns(c))
        CHECK(std::abs(through_face[c] + from_surface[immersed.parts.cut_components[c]]) <= 1e-13);
  }
} // namespace


TEST_CASE("Nodes of a ball lie on it; its volume converges", "[interface]")
{
  const auto check = [](const double exact, const auto &volume) {
    const double coarse = exact - volume(2), fine = exact - volume(3);
    CHECK(coarse / fine == Approx(4).epsilon(.05));
    CHECK(fine / exact < .02);
  };
  check(M_PI / 4, ball_volume<2>);
  check(M_PI / 6, ball_volume<3>);
}


TEST_CASE("Curved obstacles are refined unless the scene says how", "[interface]")
{
  const auto facets = [](const std::string &keys) {
    return Obstacles<3>(obstacle(keys)).surface().facets().size();
  };
  CHECK(facets("set Shape = ball\nset Refinements = 0") * 256 == facets("set Shape = ball"));
  CHECK(facets("set Shape = box") == 12);
  CHECK(facets("set Shape = box\nset Refinements = 2") == 192);
  CHECK(facets("set Shape = box\nset Map = x + y^2; y; z") == 12 * 256);
}


TEST_CASE("A cylinder has its nodes on its three surfaces", "[interface]")
{
  const Obstacles<3> obstacles(obstacle(
    "set Shape = cylinder\nset Radius = .25\nset Length = 2\nset Axis = z\nset Refinements = 3"));
  const auto         positions = obstacles.positions(0);
  for (const auto &x : positions)
    {
      const double radius = std::hypot(x[0], x[1]);
      CHECK(std::min(std::abs(radius - .25), std::abs(std::abs(x[2]) - 1)) <= 1e-14);
      CHECK(radius <= .25 + 1e-14);
    }
  CHECK(body_volumes(obstacles.surface(), positions)[0] ==
        Approx(M_PI * .25 * .25 * 2).epsilon(.02));
}


TEST_CASE("Obstacles that cannot be are named with their section and key", "[interface]")
{
  using Catch::Matchers::Contains;
  CHECK_THAT(message_of([] { Obstacles<2>(obstacle("set Map = -x; y")); }),
             Contains("section 'Obstacles/thing', key 'Map'") && Contains("inside out"));
  CHECK_THAT(message_of([] { Obstacles<2>(obstacle("set Shape = bal")); }),
             Contains("key 'Shape'") && Contains("ball"));
  CHECK_THAT(message_of([] { Obstacles<2>(obstacle("set Displacement = foo; y")); }),
             Contains("key 'Displacement'"));
}


TEST_CASE("Bodies, then obstacles, make one surface", "[interface][mpi]")
{
  const std::string   body  = "subsection Bodies\nsubsection beam\nset Lower corner = .1, .1\nset "
                              "Upper corner = .4, .2\nset Cells = 3, 1\nset Density = 1\nset "
                              "Young's modulus = 1\nset Poisson's ratio = 0.3\nend\nend\n";
  const auto          scene = obstacle("set Lower corner = .5, .5\nset Upper corner = .9, .8\nset "
                                       "Displacement = t; 0",
                              body);
  const MacGrid<2>    grid(MPI_COMM_WORLD, unit_box<2>(8), {});
  const SolidModel<2> model(scene, MPI_COMM_WORLD);
  const ImmersedSurface<2> immersed(scene, &model, grid);
  CHECK(immersed.surface().body_names() == std::vector<std::string>{"beam", "thing"});
  SolidState state{model.vector(), model.vector(), model.vector()};
  for (const auto dof : model.locally_owned())
    {
      state.displacement(dof) = .01;
      state.velocity(dof)     = model.axis(dof) + 1;
    }
  const auto positions  = immersed.positions(state, .05);
  const auto velocities = immersed.velocities(state, .05, .1);
  const auto volumes    = body_volumes(immersed.surface(), positions);
  CHECK(volumes[0] == Approx(.03));
  CHECK(volumes[1] == Approx(.12));
  REQUIRE(immersed.n_body_nodes() == 16);
  for (unsigned int node = 0; node < positions.size(); ++node)
    {
      const bool of_body = node < immersed.n_body_nodes();
      CHECK(velocities[node][0] == Approx(1));
      CHECK(velocities[node][1] == Approx(of_body ? 2 : 0).margin(1e-14));
    }

  // What acts on the obstacle does not reach the vector of the bodies.
  auto forces = model.vector();
  immersed.add_to_bodies(forces, velocities);
  CHECK(forces.mean_value() * forces.size() == Approx(3. * immersed.n_body_nodes()));
}


TEST_CASE("Bodies at periodic sides and names twice are errors", "[interface]")
{
  using Catch::Matchers::Contains;
  const MacGrid<2> grid(MPI_COMM_SELF, unit_box<2>(8), {{true, false}});
  const auto       place = [&](const std::string &lower, const std::string &upper) {
    return message_of([&] {
      const ImmersedSurface<2> surface(
        obstacle("set Lower corner = " + lower + "\nset Upper corner = " + upper), nullptr, grid);
      surface.positions({}, 0);
    });
  };
  CHECK_THAT(place(".2, .2", "1, .5"), Contains("'thing'") && Contains("periodic"));
  CHECK_THAT(place("-.1, .2", ".5, .5"), Contains("'thing'") && Contains("periodic"));
  CHECK(place(".2, -1", ".8, .5") == "no error");

  const auto moves = obstacle("set Lower corner = .2, .2\nset Upper corner = .8, .8\nset "
                              "Displacement = t; 0");
  const ImmersedSurface<2> surface(moves, nullptr, grid);
  surface.positions({}, .1);
  CHECK_THROWS_AS(surface.positions({}, .3), InputError);

  const auto          twice = obstacle("",
                              "subsection Bodies\nsubsection thing\nset Density = 1\nset Young's "
                                       "modulus = 1\nset Poisson's ratio = 0.3\nend\nend\n");
  const SolidModel<2> model(twice, MPI_COMM_SELF);
  CHECK_THAT(message_of([&] { ImmersedSurface<2>(twice, &model, grid); }),
             Contains("Obstacles/thing") && Contains("same name"));
}


TEST_CASE("Bodies may reach out of the domain and cover whole sides", "[interface][mpi]")
{
  for (const double edge : {.3, .25, 1e-6})
    {
      INFO("edge at " << edge);
      const std::string at = std::to_string(edge);
      {
        // Over the whole lower side of x, on the plane of cells or off it, as thin as wanted.
        const auto immersed = immersed_box<3>("-1, -1, -1", at + ", 2, 2", 4);
        const auto left     = what_is_left(immersed);
        CHECK(left.first == Approx(1 - edge).epsilon(1e-13));
        CHECK(left.second[0] == 0);
        CHECK(left.second[1] == Approx(1).epsilon(1e-13));
        for (unsigned int side = 2; side < 6; ++side)
          CHECK(left.second[side] == Approx(1 - edge).epsilon(1e-13));
        check_uniform_flow(immersed);
      }
      {
        // A sheet that stands in the floor.
        const auto immersed = immersed_box<3>("0.4, -0.2, -.5", "0.5, " + at + ", 1.5", 4);
        const auto left     = what_is_left(immersed);
        CHECK(left.first == Approx(1 - .1 * edge).epsilon(1e-13));
        CHECK(left.second[2] == Approx(.9).epsilon(1e-13));
        CHECK(left.second[3] == Approx(1).epsilon(1e-13));
        check_uniform_flow(immersed);
      }
      {
        const auto immersed = immersed_box<2>("-1, " + std::to_string(1 - edge), "2, 3", 4);
        const auto left     = what_is_left(immersed);
        CHECK(left.first == Approx(1 - edge).epsilon(1e-13));
        CHECK(left.second[3] == 0);
        check_uniform_flow(immersed);
      }
    }
  // All of the domain, and all but what lies beyond a plane of the grid.
  CHECK(what_is_left(immersed_box<2>("-1, -1", "2, 2", 4)).first == 0);
  CHECK(what_is_left(immersed_box<2>("-1, -1", "2, 1", 4)).first == Approx(0).margin(1e-13));
  CHECK(what_is_left(immersed_box<2>("0, 0", "1, 1", 4)).first == Approx(0).margin(1e-13));
  CHECK(what_is_left(immersed_box<3>("-1, -1, 0", "2, 2, .5", 4)).first == Approx(.5));
}


TEST_CASE("The reference lists the keys of obstacles and void regions", "[interface]")
{
  const auto reference = Options::for_reference();
  Obstacles<3>::declare(reference);
  VoidRegions<3>::declare(reference);
  std::set<std::string> keys;
  for (const auto &entry : reference.entries())
    keys.insert(entry.section + entry.key);
  for (const auto &key : {"Obstacles/<pillar>/Shape",
                          "Obstacles/<pillar>/Radius",
                          "Obstacles/<pillar>/Refinements",
                          "Obstacles/<pillar>/Displacement",
                          "Fluid/Void regions/<air>/Seed",
                          "Fluid/Void regions/<air>/Pressure"})
    {
      INFO(key);
      CHECK(keys.count(key) == 1);
    }
}
