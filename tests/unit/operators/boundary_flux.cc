// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/flush_facets.h>
#include <undine/operators/body_forces.h>
#include <undine/surface/body_surface.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <operators/immersed.h>
#include <solid/solid_scene.h>

using namespace undine_tests;

namespace
{
  const std::vector<std::string> kinds_inside{
    "ball", "wave", "snapped star", "nested bodies", "egg box"};


  template <int dim>
  dealii::Tensor<1, dim>
  some_vector(const double seed)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = std::sin(1 + seed + 2.3 * d);
    return result;
  }


  /// Call check(immersed) for random bodies of some kinds on both kinds of grids.
  template <int dim, class Check>
  void
  for_some_bodies(const std::vector<std::string> &names, const int count, const Check &check)
  {
    for (const auto &name : names)
      for (const Grid grid : {Grid::unit, Grid::graded})
        for (int number = 0; number < count; ++number)
          {
            INFO(dim << "D " << name << ' ' << number
                     << (grid == Grid::unit ? " unit" : " graded"));
            Random     random(number);
            auto       bodies    = bodies_of_kind<dim>(name, random);
            const auto stretched = make_planes(bodies, grid, random);
            check(Immersed<dim>(stretched.planes, bodies.surface(), bodies.nodes));
          }
  }


  /// Forces of p = 1, x, y, z in all nodes against quadrature over the uncut surface.
  template <int dim>
  void
  check_nodal_forces(const Immersed<dim> &immersed)
  {
    const BoundaryFlux<dim>   flux(immersed.cut, immersed.surface);
    const std::vector<double> ones(immersed.cut.components.size(), 1.);
    for (unsigned int axis = 0; axis <= dim; ++axis)
      {
        const auto exact =
          forces_by_quadrature<dim>(immersed.surface, immersed.positions, [&](const auto &x) {
            return axis == dim ? 1. : x[axis];
          });
        const auto found = axis == dim ? nodal_forces(flux, ones, MPI_COMM_WORLD)
                                       : gravity_loads(immersed.cut,
                                                       immersed.surface,
                                                       immersed.positions,
                                                       ones,
                                                       dealii::Point<dim>::unit_vector(axis),
                                                       MPI_COMM_WORLD);
        CHECK(largest_difference(found, exact) <= 1e-12 * largest_norm(exact));
      }
  }


  /// Forces by the mean of B over a motion are pressures on facets times their mean area vectors.
  template <int dim>
  void
  check_pressures_on_facets(const Immersed<dim> &immersed)
  {
    auto after = immersed.positions;
    for (std::size_t node = 0; node < after.size(); ++node)
      after[node] += some_vector<dim>(7. * node);
    const auto pressures = immersed.parts.of_cut_cells(immersed.scattered());
    const auto loads     = pressures_on_facets(
      immersed.cut, immersed.surface, immersed.positions, pressures, MPI_COMM_WORLD);
    std::vector<dealii::Tensor<1, dim>> expected(after.size());
    for (unsigned int facet = 0; facet < immersed.surface.facets().size(); ++facet)
      for (unsigned int k = 0; k < dim; ++k)
        expected[immersed.surface.facets()[facet][k]] +=
          loads[facet * dim + k] *
          mean_area_vector(immersed.surface, facet, immersed.positions, after);
    const BoundaryFlux<dim> mean(
      immersed.cut, immersed.surface, immersed.positions, immersed.positions, after);
    CHECK(largest_difference(nodal_forces(mean, pressures, MPI_COMM_WORLD), expected) <=
          1e-12 * largest_norm(expected));
  }


  /// Sum of B^T p = - sum of D^T p over the pieces of all faces, those of the domain's sides too.
  template <int dim>
  void
  check_momentum(const Immersed<dim> &immersed)
  {
    const auto             &open     = immersed.open();
    const auto              pressure = immersed.scattered();
    const BoundaryFlux<dim> flux(immersed.cut, immersed.surface);
    dealii::Tensor<1, dim>  on_fluid, on_solid;
    double                  scale = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int k = 0; k < open.pieces[axis].size(); ++k)
        if (open.faces[axis].owns(k))
          for (const int end : {0, 1})
            if (const int c = open.pieces[axis][k].components[end]; c >= 0)
              {
                const double area = open.faces[axis].all()[k].measure;
                on_fluid[axis] += (end == 0 ? 1 : -1) * area * pressure[c];
                scale += area;
              }
    on_fluid = dealii::Utilities::MPI::sum(on_fluid, MPI_COMM_WORLD);
    scale    = dealii::Utilities::MPI::sum(scale, MPI_COMM_WORLD);
    for (const auto &force :
         nodal_forces(flux, immersed.parts.of_cut_cells(pressure), MPI_COMM_WORLD))
      on_solid += force;
    CHECK((on_fluid + on_solid).norm() <= 1e-13 * scale);
  }


  /// Bodies and fluid that move alike: B u + D v = 0 in every component.
  template <int dim>
  void
  check_translation(const Immersed<dim> &immersed)
  {
    const auto              velocity = some_vector<dim>(1);
    const BoundaryFlux<dim> flux(immersed.cut, immersed.surface);
    const auto              from_surface =
      flux.flux(std::vector<dealii::Tensor<1, dim>>(immersed.surface.n_nodes(), velocity));
    const auto &components   = immersed.open().cells;
    const auto  through_face = immersed.divergence(velocity);
    for (unsigned int c = 0; c < components.all().size(); ++c)
      if (components.owns(c))
        {
          double face = 0;
          for (unsigned int axis = 0; axis < dim; ++axis)
            face = std::max(face, immersed.grid.face_area(axis, components.all()[c].index));
          CHECK(std::abs(through_face[c] + from_surface[immersed.parts.cut_components[c]]) <=
                1e-12 * face);
        }
  }


  template <int dim>
  void
  check_archimedes(const Immersed<dim> &immersed)
  {
    const auto                gravity = some_vector<dim>(2);
    const std::vector<double> densities(immersed.cut.components.size(), 3.);
    const auto                loads = gravity_loads(
      immersed.cut, immersed.surface, immersed.positions, densities, gravity, MPI_COMM_WORLD);
    const auto forces  = sums_over_bodies(immersed.surface, loads);
    const auto volumes = body_volumes(immersed.surface, immersed.positions);
    for (unsigned int body = 0; body < forces.size(); ++body)
      {
        double scale = 0; // force on one side: volumes of thin sheets are small differences
        for (unsigned int facet = 0; facet < immersed.surface.facets().size(); ++facet)
          if (immersed.surface.body(facet) == body)
            scale += area_vector(immersed.surface, facet, immersed.positions).norm() *
                     immersed.positions[immersed.surface.facets()[facet][0]].norm();
        CHECK((forces[body] + 3. * volumes[body] * gravity).norm() <= 1e-12 * scale);
      }
  }


  /// Deformed finite elements of a scene in the middle of a unit box.
  template <int dim>
  Immersed<dim>
  deformed_body(const std::string &shape, const unsigned int degree, const int cells)
  {
    const SolidModel<dim> model(
      read_scene_text(
        one_body(shape + "\nset Density = 1\nset Young's modulus = 1\nset Poisson's ratio = 0.3\n",
                 "",
                 "set Element degree = " + std::to_string(degree))),
      MPI_COMM_WORLD);
    const BodySurface<dim> surface(model);
    auto                   displacement = model.vector();
    for (const auto dof : model.locally_owned())
      {
        const auto  &x    = model.rest_position(dof);
        const double wave = std::sin(7 * x[0] + 3 * x[dim - 1] + model.axis(dof));
        displacement(dof) = .03 * wave + .02 * x[model.axis(dof)];
      }
    displacement.compress(dealii::VectorOperation::insert);
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      for (int i = 0; i <= cells; ++i)
        planes[d].push_back(std::pow(i / double(cells), 1 + .3 * d));
    return Immersed<dim>(planes, surface.surface(), surface.positions(displacement));
  }


  template <int dim>
  std::vector<std::string>
  shapes()
  {
    return {plane_or_space<dim>("set Shape = ball\nset Centre = .5, .5\nset Radius = .3",
                                "set Shape = ball\nset Centre = .5, .5, .5\nset Radius = .3"),
            plane_or_space<dim>(
              "set Centre = .5, .5\nset Size = .6, 1e-3\nset Cells = 5, 1\nset Rotation = 30",
              "set Centre = .5, .5, .5\nset Size = .5, 1e-3, .4\nset Cells = 4, 1, 3\n"
              "set Rotation = 10, 20, 30")};
  }


  template <int dim>
  void
  check_finite_elements()
  {
    for (const auto &shape : shapes<dim>())
      for (const unsigned int degree : {1, 2})
        {
          INFO(dim << "D degree " << degree << ' ' << shape);
          const auto immersed = deformed_body<dim>(shape, degree, 12);
          check_closed(immersed.surface, immersed.positions);
          check_positions(immersed.surface, immersed.positions);
          check_nodal_forces(immersed);
          check_momentum(immersed);
          check_translation(immersed);
          check_archimedes(immersed);
        }
  }


  /// A sheet across a box of 4 cells in each direction, over its rim.
  template <int dim>
  Immersed<dim>
  sheet_across(const double lower, const double thickness)
  {
    const auto map = [&](const dealii::Point<dim> &x) {
      dealii::Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = d == dim - 1 ? lower + thickness * x[d] : -1 + 6 * x[d];
      return result;
    };
    std::array<int, dim> cells;
    cells.fill(3);
    cells[dim - 1]                       = 1;
    const auto                    bodies = lattice<dim>(cells, map);
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      planes[d] = {0, 1, 2, 3, 4};
    return Immersed<dim>(planes, bodies.surface(), bodies.nodes);
  }


  template <int dim>
  void
  check_sheets()
  {
    for (const double thickness : {1e-6, 1e-3, .3, 1., 2.})
      for (const double lower : {1., 1.3, 1 - 1e-12})
        {
          INFO(dim << "D thickness " << thickness << " from " << lower);
          const auto immersed = sheet_across<dim>(lower, thickness);
          check_translation(immersed);
          check_momentum(immersed);
        }
  }
} // namespace


TEST_CASE("Forces in the nodes equal quadrature over the uncut surface", "[interface][mpi]")
{
  for_some_bodies<2>(kinds_inside, 5, check_nodal_forces<2>);
  for_some_bodies<3>(kinds_inside, 2, check_nodal_forces<3>);
}


TEST_CASE("Pressures on facets that move", "[interface][mpi]")
{
  for_some_bodies<2>(kinds_inside, 5, check_pressures_on_facets<2>);
  for_some_bodies<3>(kinds_inside, 2, check_pressures_on_facets<3>);
}


TEST_CASE("What fluid pressure gives to bodies it takes from the fluid", "[interface][mpi]")
{
  for_some_bodies<2>(kinds_inside, 5, check_momentum<2>);
  for_some_bodies<3>(kinds_inside, 2, check_momentum<3>);
}


TEST_CASE("Bodies that move with the fluid leave it free of divergence", "[interface][mpi]")
{
  for_some_bodies<2>(kinds_inside, 5, check_translation<2>);
  for_some_bodies<3>(kinds_inside, 2, check_translation<3>);
  check_sheets<2>();
  check_sheets<3>();
}


TEST_CASE("Archimedes' force", "[interface][mpi]")
{
  for_some_bodies<2>(kinds_inside, 5, check_archimedes<2>);
  for_some_bodies<3>(kinds_inside, 2, check_archimedes<3>);
}


TEST_CASE("The operators of deformed finite elements", "[interface][mpi]")
{
  check_finite_elements<2>();
  check_finite_elements<3>();
}


TEST_CASE("Entries of the boundary flux: the operator and its transpose", "[interface]")
{
  Random            random(3);
  const auto        bodies = ball<3>(1, 2).shift(all_equal<3>(2.6));
  const Immersed<3> immersed(
    {{{0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5, 6}, {0, 1, 2, 3, 4, 5, 6}}},
    bodies.surface(),
    bodies.nodes);
  const BoundaryFlux<3>             flux(immersed.cut, immersed.surface);
  std::vector<dealii::Tensor<1, 3>> velocities(immersed.surface.n_nodes());
  std::vector<double>               pressures(immersed.cut.components.size());
  for (auto &velocity : velocities)
    for (unsigned int d = 0; d < 3; ++d)
      velocity[d] = random.between(-1, 1);
  for (auto &pressure : pressures)
    pressure = random.between(-1, 1);
  const auto u_to_flux     = flux.flux(velocities);
  const auto p_to_force    = flux.local_forces(pressures);
  double     work_on_fluid = 0, work_on_solid = 0, exact = 0, size = 0;
  for (unsigned int c = 0; c < pressures.size(); ++c)
    work_on_fluid += pressures[c] * u_to_flux[c];
  for (unsigned int node = 0; node < velocities.size(); ++node)
    work_on_solid += velocities[node] * p_to_force[node];
  // Against the corners of the fragments: the mean over a polygon's triangles, fan by fan.
  for (unsigned int f = 0; f < immersed.cut.fragments.size(); ++f)
    {
      const auto &fragment = immersed.cut.fragments[f];
      const auto &nodes    = immersed.surface.facets()[fragment.facet];
      const auto &corners  = immersed.cut.corners;
      const auto  normal   = area_vector(immersed.surface, fragment.facet, immersed.positions);
      const auto  velocity = [&](const dealii::Point<3> &x) {
        dealii::Tensor<1, 3> result;
        for (unsigned int k = 0; k < 3; ++k)
          {
            const auto a = immersed.positions[nodes[(k + 1) % 3]] - x;
            const auto b = immersed.positions[nodes[(k + 2) % 3]] - x;
            result += dealii::cross_product_3d(a, b) * normal / 2 / normal.norm_square() *
                      velocities[nodes[k]];
          }
        return result;
      };
      for (int k = corners.first[f] + 1; k + 1 < corners.first[f + 1]; ++k)
        {
          const auto &a = corners.points[corners.first[f]];
          const auto &b = corners.points[k], &c = corners.points[k + 1];
          const auto  area = -0.5 * dealii::cross_product_3d(b - a, c - a);
          const auto  term =
            pressures[fragment.component] * area * velocity(dealii::Point<3>((a + b + c) / 3.));
          exact += term;
          size += std::abs(term);
        }
    }
  CHECK(std::abs(work_on_fluid - work_on_solid) <= 1e-14 * size);
  CHECK(std::abs(work_on_fluid - exact) <= 1e-12 * size);
}


TEST_CASE("The mean of B is that of whole facets, also where they are cut beside their places",
          "[interface]")
{
  // A trapezium with its base a little above a plane of the grid, in which it is cut: moved as a
  // whole it sweeps nothing in sum.
  constexpr double off    = 5e-5;
  auto             bodies = box<2>({.3, .25 + off}, {.5, .35}, {{1, 1}});
  for (auto &node : bodies.nodes)
    if (node[1] > .3 && node[0] > .4)
      node[0] -= .1;
  std::array<std::vector<double>, 2> planes;
  for (auto &of_axis : planes)
    for (int k = 0; k <= 16; ++k)
      of_axis.push_back(k / 16.);
  const auto            surface = bodies.surface();
  const auto            cut_at  = beyond_planes(GridPlanes<2>(planes), surface, bodies.nodes);
  const Immersed<2>     immersed(planes, surface, cut_at);
  const BoundaryFlux<2> mean(immersed.cut, surface, cut_at, bodies.nodes, bodies.nodes);
  CHECK(cut_at != bodies.nodes);
  for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const std::vector<dealii::Tensor<1, 2>> velocities(bodies.nodes.size(),
                                                         dealii::Point<2>::unit_vector(axis));
      double                                  sum = 0;
      for (const double flux : mean.flux(velocities))
        sum += flux;
      CHECK(std::abs(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD)) < 1e-14);
    }
}
