// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/body_forces.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/face_facets.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <catch2/catch.hpp>
#include <solid/solid_scene.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A curved body and a box, of degree `degree`.
  template <int dim>
  SolidModel<dim>
  two_bodies(const unsigned int degree, const MPI_Comm communicator)
  {
    const std::string material =
      "set Density = 1\nset Young's modulus = 1\nset Poisson's ratio = 0.3\n";
    const std::string centre = plane_or_space<dim>("3, 0", "3, 0, 0");
    return SolidModel<dim>(
      read_scene_text("subsection Bodies\n"
                      "subsection round\nset Shape = ball\nset Centre = " +
                      centre + "\nset Radius = .5\nset Refinements = 1\n" + material +
                      "end\n"
                      "subsection straight\nset Cells = " +
                      plane_or_space<dim>("3, 2", "3, 2, 2") + "\n" + material +
                      "end\nend\nsubsection Solid numerics\nset Element degree = " +
                      std::to_string(degree) + "\nend\n"),
      communicator);
  }


  /// A smooth deformation.
  template <int dim>
  typename SolidModel<dim>::Vector
  deformation(const SolidModel<dim> &model)
  {
    auto result = model.vector();
    for (const auto dof : model.locally_owned())
      {
        const auto &x = model.rest_position(dof);
        result(dof)   = .05 * std::sin(3 * x[0] + 2 * x[dim - 1] + model.axis(dof));
      }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  template <int dim>
  void
  check_surface(const unsigned int degree)
  {
    INFO(dim << "D degree " << degree);
    const auto             model = two_bodies<dim>(degree, MPI_COMM_WORLD);
    const BodySurface<dim> surface(model);
    const auto             displacement = deformation(model);
    const auto             positions    = surface.positions(displacement);
    check_closed(surface.surface(), positions);
    check_positions(surface.surface(), positions);

    // `degree` segments a face in the plane, 4 triangles for each of its edges' nodes in space; a
    // closed surface in space has twice as many triangles as nodes, minus 4.
    unsigned int n_faces = 0;
    for (const auto &cell : model.triangulation().active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        n_faces += cell->at_boundary(face);
    const unsigned int n_facets = surface.surface().facets().size();
    CHECK(n_facets == n_faces * degree * (dim == 2 ? 1 : 4));
    CHECK(surface.n_nodes() == (n_facets + 4 * (dim - 2) * 2) / (dim - 1));

    const auto volumes = body_volumes(surface.surface(), surface.positions(model.vector()));
    CHECK(volumes[1] == Approx(1).epsilon(1e-14));
    const auto measures = measure_bodies(model, model.vector());
    // In space the faces of curved bodies are not plane: two triangles enclose a little more.
    CHECK(volumes[0] == Approx(measures[0].volume).epsilon(dim == 2 ? 1e-13 : .01));
    // In the plane every side encloses what the line or the parabola does (I12).
    for (unsigned int body = 0; body < 2; ++body)
      CHECK(
        body_volumes(surface.surface(), positions)[body] ==
        Approx(measure_bodies(model, displacement)[body].volume).epsilon(dim == 2 ? 1e-13 : .01));

    for (unsigned int node = 0; node < surface.n_nodes(); ++node)
      for (const auto &share : surface.shares(node))
        for (unsigned int axis = 0; axis < dim; ++axis)
          REQUIRE(model.axis(share.dofs[axis]) == axis);
  }


  /// Forces of a uniform pressure on the facets, each of which gives equal parts to its nodes,
  /// against the integrals of the shape functions over the sides of the box.
  template <int dim>
  void
  check_uniform_pressure(const unsigned int degree)
  {
    INFO(dim << "D degree " << degree);
    const auto                          model = two_bodies<dim>(degree, MPI_COMM_WORLD);
    const BodySurface<dim>              surface(model);
    const auto                          positions = surface.positions(model.vector());
    std::vector<dealii::Tensor<1, dim>> on_nodes(surface.n_nodes());
    for (unsigned int facet = 0; facet < surface.surface().facets().size(); ++facet)
      for (const unsigned int node : surface.surface().facets()[facet])
        on_nodes[node] += area_vector(surface.surface(), facet, positions) / dim;
    auto forces = model.vector();
    surface.add(forces, on_nodes);

    auto                                         exact   = model.vector();
    const auto                                  &element = model.dof_handler().get_fe();
    dealii::FEFaceValues<dim>                    values(model.mapping(),
                                     element,
                                     dealii::QGauss<dim - 1>(degree + 1),
                                     dealii::update_values | dealii::update_JxW_values |
                                       dealii::update_normal_vectors);
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    for (const auto &cell : model.dof_handler().active_cell_iterators())
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face))
          {
            values.reinit(cell, face);
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              for (const unsigned int q : values.quadrature_point_indices())
                if (model.locally_owned().is_element(dofs[i]))
                  exact(dofs[i]) +=
                    values.shape_value(i, q) * values.JxW(q) *
                    values.normal_vector(q)[element.system_to_component_index(i).first];
          }
    exact.compress(dealii::VectorOperation::add);
    for (const auto dof : model.locally_owned())
      if (model.rest_position(dof)[0] < 2) // in space the sides of balls are not plane
        REQUIRE(forces(dof) == Approx(exact(dof)).margin(1e-15));
  }


  template <int dim>
  void
  compare_with_one_rank(const unsigned int degree)
  {
    const auto             model = two_bodies<dim>(degree, MPI_COMM_WORLD);
    const auto             alone = two_bodies<dim>(degree, MPI_COMM_SELF);
    const BodySurface<dim> surface(model), surface_alone(alone);
    CHECK(surface.surface().facets() == surface_alone.surface().facets());
    const auto positions       = surface.positions(deformation(model));
    const auto positions_alone = surface_alone.positions(deformation(alone));
    REQUIRE(positions.size() == positions_alone.size());
    double difference = 0;
    for (unsigned int node = 0; node < positions.size(); ++node)
      difference = std::max(difference, positions[node].distance(positions_alone[node]));
    CHECK(difference <= 1e-15);
  }


  /// sum_i f_i u_i over nodes = f . u of the vectors, where f is nothing but the nodes' values.
  template <int dim>
  void
  check_work()
  {
    const auto                          model = two_bodies<dim>(2, MPI_COMM_WORLD);
    const BodySurface<dim>              surface(model);
    const auto                          velocity = deformation(model);
    const auto                          u        = surface.gather(velocity);
    std::vector<dealii::Tensor<1, dim>> forces(u.size());
    double                              work = 0;
    for (unsigned int node = 0; node < u.size(); ++node)
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          forces[node][axis] = std::sin(node + 2. * axis);
          work += forces[node][axis] * u[node][axis];
        }
    auto vector = model.vector();
    surface.add(vector, forces);
    surface.add(vector, forces);
    CHECK(vector * velocity == Approx(2 * work).epsilon(1e-13));
    CHECK(vector.l1_norm() > 0);
  }

} // namespace


TEST_CASE("The surface of bodies is closed and encloses their volume", "[interface][mpi]")
{
  for (const unsigned int degree : {1, 2})
    {
      check_surface<2>(degree);
      check_surface<3>(degree);
    }
}


TEST_CASE("A uniform pressure has the nodal forces of the finite elements", "[interface][mpi]")
{
  check_uniform_pressure<2>(1);
  check_uniform_pressure<2>(2);
  check_uniform_pressure<3>(1);
  check_uniform_pressure<3>(2);
}


TEST_CASE("All ranks know the same surface", "[interface][mpi]")
{
  for (const unsigned int degree : {1, 2})
    {
      compare_with_one_rank<2>(degree);
      compare_with_one_rank<3>(degree);
    }
}


TEST_CASE("Values in the nodes do the same work as vectors", "[interface][mpi]")
{
  check_work<2>();
  check_work<3>();
}


TEST_CASE("Diagonals of a face of degree 2 meet in its middle", "[interface]")
{
  for (const auto &facets : face_facets<3>(2))
    {
      REQUIRE(facets.size() == 8);
      // The middle of a face is the only node that all facets share.
      std::map<unsigned int, unsigned int> uses;
      for (const auto &facet : facets)
        for (const unsigned int node : facet)
          ++uses[node];
      unsigned int most = 0;
      for (const auto &use : uses)
        most = std::max(most, use.second);
      CHECK(most == 8);
    }
}


TEST_CASE("Columns of pressure forces: total and parts", "[interface]")
{
  const Surface<2>  surface(4, {{{0, 1}}, {{1, 0}}, {{2, 3}}, {{3, 2}}}, {0, 0, 1, 1}, {"a", "b"});
  PressureForces<2> forces;
  for (unsigned int node = 0; node < 4; ++node)
    forces.reduced.push_back(dealii::Tensor<1, 2>({1. + node, 10. + node}));
  auto columns = pressure_force_columns(surface, forces);
  REQUIRE(columns.size() == 4);
  CHECK(columns[0].name == "pressure force a x");
  CHECK(columns[0].value == 3);
  CHECK(columns[3].name == "pressure force b y");
  CHECK(columns[3].value == 25);
  forces.gravity.assign(4, dealii::Tensor<1, 2>({0., -1.}));
  columns = pressure_force_columns(surface, forces);
  REQUIRE(columns.size() == 12);
  CHECK(columns[3].value == 23);
  CHECK(columns[7].value == 25);
  CHECK(columns[11].value == -2);
  CHECK(columns[11].name == "gravity load b y");
}
