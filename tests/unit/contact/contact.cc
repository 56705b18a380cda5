// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/barrier.h>

#include <deal.II/base/utilities.h>

#include <contact/contact_scene.h>
#include <message_of.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  template <int dim>
  void
  check_derivatives(const unsigned int degree, const double aside, const double size)
  {
    INFO(dim << "D, degree " << degree << ", " << aside << " aside");
    // Facets of one body face facets, ridges and corners of the other; nodes face the wall.
    const Scene<dim> scene(two_boxes<dim>(.06, aside, degree), .2, -.1);
    const Vector     place = scene.field(size, 0), change = scene.field(1, 1);
    check_derivatives_along(scene, place, change, 1e-7);
  }


  /// Force and moment on all bodies [N], [N m].
  template <int dim>
  void
  check_balance()
  {
    const Scene<dim>       scene(two_boxes<dim>(.06, .3, 2), .2);
    const Vector           place  = scene.field(.02, 0);
    const Vector           forces = scene.contact.forces(place, 0);
    dealii::Tensor<1, dim> force;
    dealii::Tensor<2, dim> moment;
    double                 size = 0;
    for (const auto dof : scene.model.locally_owned())
      {
        force[scene.model.axis(dof)] += forces(dof);
        size += std::abs(forces(dof));
      }
    const BodySurface<dim> surface(scene.model);
    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      if (const auto &dofs = surface.shares(node).front().dofs;
          scene.model.locally_owned().is_element(dofs[0]))
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double x = scene.model.rest_position(dofs[a])[a] + place(dofs[a]);
            for (unsigned int b = 0; b < dim; ++b)
              {
                moment[a][b] += x * forces(dofs[b]);
                moment[b][a] -= x * forces(dofs[b]);
              }
          }
    force  = dealii::Utilities::MPI::sum(force, MPI_COMM_WORLD);
    moment = dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD);
    size   = dealii::Utilities::MPI::sum(size, MPI_COMM_WORLD);
    CHECK(size > 1e-3);
    CHECK(force.norm() < 1e-14 * size);
    CHECK(moment.norm() < 1e-14 * size);
  }


  /// A flat face of several facets is one surface: each node before it counts once, with half its
  /// area, at its distance, wherever the rims of the facets are. Where one is exactly across from
  /// it, terms of facets and rims may cancel to rounding only.
  template <int dim>
  void
  check_flat_face()
  {
    const double                   distance = .09, reach = .2;
    const Scene<dim>               scene(two_boxes<dim>(1, 0), reach);
    const ContactSurfaces<dim>     surfaces(scene.settings(reach, -10).walls, scene.model, nullptr);
    const ActivationDistances<dim> distances(surfaces, reach);
    for (const double aside : {0., 1e-9, .01, .2, .25, .5})
      {
        INFO(dim << "D, " << aside << " aside");
        dealii::Tensor<1, dim> path;
        path[0] = distance - 1;
        for (unsigned int axis = 1; axis < dim; ++axis)
          path[axis] = aside;
        const auto places  = surfaces.positions(scene.shift(path), 0);
        const auto is_seen = [&](const unsigned int node) {
          bool result = surfaces.surface_of_node(node) == 1 && places[node][0] < 1 + 1.5 * distance;
          for (unsigned int axis = 1; axis < dim; ++axis)
            result = result && places[node][axis] <= 1;
          return result;
        };
        std::vector<double>                 areas(places.size()), energies(places.size());
        std::vector<dealii::Tensor<1, dim>> directions(places.size());
        for (const auto &term :
             find_contact_terms(surfaces,
                                distances,
                                OwnPairs<dim>(surfaces, distances).nearby(places, places),
                                places))
          {
            const unsigned int node = term.nodes[0];
            areas[node] += term.area;
            energies[node] += term.area * barrier(term.distance / reach);
            directions[node] += term.area * term.direction;
          }
        unsigned int found = 0;
        for (unsigned int node = 0; node < places.size(); ++node)
          if (is_seen(node))
            {
              ++found;
              const double area = surfaces.area(node) / 2;
              REQUIRE(places[node][0] == Approx(1 + distance));
              CHECK(areas[node] == Approx(area));
              CHECK(energies[node] == Approx(area * barrier(distance / reach)).epsilon(1e-12));
              CHECK(directions[node][0] == Approx(area));
              CHECK(directions[node].norm() == Approx(area));
            }
        const unsigned int in_a_row = aside == 0 ? 3 : aside <= .5 ? 2 : 1;
        // In space there are nodes in the middle of faces of linear elements, too.
        const unsigned int in_the_middle = dim == 2 ? 0 : aside <= .25 ? 4 : 1;
        CHECK(found == dealii::Utilities::pow(in_a_row, dim - 1) + in_the_middle);
      }
  }


  template <int dim>
  void
  check_ways()
  {
    const Scene<dim>       scene(two_boxes<dim>(1, .3), .1, -.5);
    dealii::Tensor<1, dim> path;
    const Vector           start = scene.model.vector();
    const auto             part  = [&](const double length) {
      path[0] = length;
      return scene.contact.collision_free_fraction({start, 0.}, {scene.shift(path), 0.});
    };
    CHECK(part(.7) == 1);
    CHECK(part(-.9) == 1);
    // Up to half of the gap, through the other body and far beyond.
    for (const double length : {1., 2., 10., 1e3})
      {
        CHECK(part(-length) * length > .94);
        CHECK(part(-length) * length < .9501);
      }
    Vector fall = start;
    fall.add(-4.);
    CHECK(scene.contact.collision_free_fraction({start, 0.}, {fall, 0.}) * 4 == Approx(.45));
    CHECK(scene.contact.forces(start, 0.).size() == 0);
  }


  /// Two balls, a node of one in front of a node of the other.
  template <int dim>
  std::string
  two_balls(const double gap)
  {
    const auto ball = [](const std::string &name, const double x) {
      return fmt::format("subsection {}\nset Shape = ball\nset Radius = 1\nset Centre = {}{}\nset "
                         "Density = 1\nset Young's modulus = 1\nset Poisson's ratio = 0\nend\n",
                         name,
                         x,
                         plane_or_space<dim>(", 0", ", 0, 0"));
    };
    return "subsection Bodies\n" + ball("one", 0) + ball("other", 2 + gap) + "end\n";
  }


  /// Nodes that press on each other are about to slip: for the exact stiffness a way aside has
  /// negative energy, but for no way that of the convex part is negative. Towards each other both
  /// are the same.
  template <int dim>
  void
  check_convex_part()
  {
    const Scene<dim> scene(two_balls<dim>(0.05), 0.2);
    const auto       of_way = [&](const Tangent kind, const Vector &way) {
      auto matrix = scene.model.matrix();
      scene.contact.add_stiffness(matrix, 1, scene.model.vector(), 0, kind);
      Vector result = scene.model.vector();
      matrix.vmult(result, way);
      return result * way;
    };
    const auto   towards = scene.shift(dealii::Point<dim>::unit_vector(0));
    const auto   aside   = scene.shift(dealii::Point<dim>::unit_vector(dim - 1));
    const double size    = of_way(Tangent::convex, towards);
    CHECK(size > 0);
    CHECK(of_way(Tangent::exact, towards) == Approx(size));
    CHECK(of_way(Tangent::exact, aside) < -1e-3 * size);
    CHECK(of_way(Tangent::convex, aside) >= -1e-12 * size);
    for (const double phase : {0., 1., 2., 3., 4., 5.})
      CHECK(of_way(Tangent::convex, scene.field(1, phase)) >= -1e-12 * size);
  }
} // namespace


TEST_CASE("forces and stiffness of contact are derivatives of its energy", "[contact][mpi]")
{
  for (const unsigned int degree : {1, 2})
    {
      check_derivatives<2>(degree, .3, .02);
      check_derivatives<3>(degree, .3, .02);
      // Edges are nearly parallel.
      check_derivatives<3>(degree, .01, .004);
    }
  for (const double s : {.1, .5, .9, .999})
    {
      const double h = 1e-6;
      CHECK((barrier(s + h) - barrier(s - h)) / (2 * h) == Approx(barrier_slope(s)).epsilon(1e-6));
      CHECK((barrier_slope(s + h) - barrier_slope(s - h)) / (2 * h) ==
            Approx(barrier_curvature(s)).epsilon(1e-6));
    }
  CHECK(barrier(1) == 0);
  CHECK(barrier_slope(1) == 0);
  CHECK(barrier_curvature(1) == 0);
}


TEST_CASE("the convex part of contact's stiffness pushes nothing aside", "[contact][mpi]")
{
  check_convex_part<2>();
  check_convex_part<3>();
}


TEST_CASE("forces of contact between bodies balance, and so do their moments", "[contact][mpi]")
{
  check_balance<2>();
  check_balance<3>();
}


TEST_CASE("a flat face is one surface, wherever the rims of its facets are", "[contact]")
{
  check_flat_face<2>();
  check_flat_face<3>();
}


TEST_CASE("no way leads through another body or a wall", "[contact][mpi]")
{
  check_ways<2>();
  check_ways<3>();
}


TEST_CASE("bodies that overlap at the start are refused", "[contact]")
{
  using Catch::Contains;
  const auto complaint = [](const double gap, const double wall) {
    const Scene<2> scene(two_boxes<2>(gap, .3), .1, wall);
    return message_of([&] { scene.contact.check_start(scene.model.vector(), 0); });
  };
  CHECK(complaint(.01, -.01) == "no error");
  CHECK_THAT(complaint(-.01, -1), Contains("overlaps") && Contains("Try: leave a gap"));
  CHECK_THAT(complaint(.01, .2), Contains("'one' is not on the free side of wall 'wall'"));
}


TEST_CASE("where a gap is closed is said, between what, and by how much", "[contact]")
{
  using Catch::Contains;
  const Scene<2> scene(two_boxes<2>(.01, .3), .1, -.01);
  const auto     complaint = [&](const double path) {
    const auto places = scene.shift(path * dealii::Point<2>::unit_vector(0));
    return message_of([&] { scene.contact.energy(places, 0); });
  };
  CHECK(complaint(-.005) == "no error");
  CHECK_THAT(complaint(-1.03),
             Contains("'other' runs into wall 'wall'") && Contains("near (-0.02, ") &&
               Contains("the gap there is -0.01 m") && Contains("Try"));
}
