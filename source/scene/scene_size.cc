// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/direction.h>
#include <undine/coupled/scheme/scheme.h>
#include <undine/effects/effect.h>
#include <undine/fluid/boundary/boundary.h>
#include <undine/fluid/grid/mac_grid.h>
#include <undine/scene/measure_particles.h>
#include <undine/scene/scene_size.h>
#include <undine/solid/mesh/body.h>
#include <undine/solid/mesh/solid_numerics.h>
#include <undine/solid/solvers/factorisation_work.h>
#include <undine/surface/obstacle_description.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr unsigned int refinements_of_curved_shapes = 4; // of obstacles, unless the scene says

    // A plane of any direction goes through so many squares or cubes for each that it is as large
    // as, on average: 4/pi in 2D, 3/2 in 3D.
    constexpr double cells_per_area = 1.4;


    double
    power(const double base, const unsigned int exponent)
    {
      return std::pow(base, double(exponent));
    }


    /// The shape's, refined.
    ShapeSize
    refined(ShapeSize size, const unsigned int dim, const unsigned int refinements)
    {
      const double halves = power(2, refinements);
      for (unsigned int i = 0; i < refinements; ++i)
        {
          const auto [vertices, lines, quadrilaterals, hexahedra] = size.parts;
          size.parts = {{vertices + lines + quadrilaterals + hexahedra,
                         2 * lines + 4 * quadrilaterals + 6 * hexahedra,
                         4 * quadrilaterals + 12 * hexahedra,
                         8 * hexahedra}};
        }
      size.cells *= power(halves, dim);
      size.faces *= power(halves, dim - 1);
      size.slices *= halves;
      return size;
    }


    void
    read_time(SceneSize &size, const Options &scene)
    {
      double       end = 0, step = 0.01, interval = 0;
      unsigned int most = 0;
      const auto   time = scene.section("Time");
      time.add("End", end, "s", Allowed::positive(), "");
      time.add("Step", step, "s", Allowed::positive(), "");
      time.add("Maximum steps", most, "", Allowed::positive(), "");
      scene.section("Output").add("Interval", interval, "s", Allowed::not_negative(), "");
      size.steps = std::ceil(end / step * (1 - 1e-9));
      if (most > 0 && most < size.steps)
        {
          size.steps = most;
          end        = most * step;
        }
      size.pictures = 2 + (interval > 0 ? std::floor(end / interval) : 0);
    }


    /// The surfaces in the fluid: number of cells that they cut, each about as large as the mean.
    template <int dim>
    void
    add_surface(GridSize &grid, const ShapeSize &shape, const double mean_width)
    {
      const double facets_of_face = dim - 1; // triangles of a quadrilateral
      grid.facets += facets_of_face * shape.faces;
      grid.cut_cells += cells_per_area * shape.area / power(mean_width, dim - 1);
    }


    /// Returns the shape as make_shape_boundary() would refine it, or the file's surface.
    template <int dim>
    ShapeSize
    obstacle_size(const ShapeDescription<dim> &description)
    {
      if (description.shape)
        {
          const auto size = description.shape->size();
          const bool fine = !description.has_refinements && (description.has_map || size.is_curved);
          return refined(size, dim, fine ? refinements_of_curved_shapes : description.refinements);
        }
      const auto boundary = make_shape_boundary(description);
      const auto surface  = boundary.surface(description.name);
      ShapeSize  size;
      size.faces = surface.facets().size() / double(dim - 1);
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        size.area += area_vector(surface, facet, boundary.nodes).norm();
      return size;
    }


    template <int dim>
    void
    add_obstacles(GridSize &grid, const Options &scene, const double mean_width)
    {
      for (const auto &obstacle : read_obstacles<dim>(scene))
        {
          add_surface<dim>(grid, obstacle_size(obstacle.description), mean_width);
          grid.moves = grid.moves || !obstacle.displacement.is_zero();
        }
    }


    /// Returns the mean width of cells [m].
    template <int dim>
    double
    measure_grid(GridSize &grid, const Options &scene)
    {
      const auto planes = read_planes<dim>(scene.section("Domain"));
      double     volume = 1;
      grid.cells        = 1;
      for (const auto &of_axis : planes)
        {
          grid.cells *= of_axis.size() - 1;
          volume *= of_axis.back() - of_axis.front();
        }
      for (const auto &effect : read_effects<dim>(scene.section("Effects")))
        {
          const auto work = effect->work();
          grid.advected += work.advected;
          grid.implicit += work.implicit;
          grid.scalars += effect->scalars().size();
        }
      for (const auto &boundary :
           read_boundaries<dim>(scene.section("Fluid").section("Boundaries")))
        grid.has_openings = grid.has_openings || boundary.is_open();
      return std::pow(volume / grid.cells, 1. / dim);
    }


    /// Of Lagrange's elements: 1 in each vertex, more in lines, quadrilaterals and hexahedra.
    double
    count_nodes(const ShapeSize &mesh, const unsigned int degree)
    {
      double nodes = 0, within = 1;
      for (const double n : mesh.parts)
        {
          nodes += n * within;
          within *= degree - 1;
        }
      return nodes;
    }


    /// Is the tangent factorised? As solves_directly() decides for the mesh.
    template <int dim>
    bool
    is_direct(const SolidNumerics          &numerics,
              const std::vector<Body<dim>> &bodies,
              const double                  work,
              const FactorUse               use)
    {
      if (numerics.linear_solver != "auto")
        return numerics.linear_solver == "direct";
      const bool separated = std::any_of(bodies.begin(), bodies.end(), [](const auto &body) {
        return body.kinematics->separates_volumetric_part(*body.material);
      });
      return work <= most_work_of_factors(use, separated);
    }


    template <int dim>
    void
    measure_bodies(SceneSize &size, const Options &scene, const double mean_width)
    {
      const SolidNumerics numerics(scene);
      const auto          bodies = read_bodies<dim>(scene.section("Bodies"));
      auto               &solid  = size.solid;
      solid.degree               = numerics.degree;
      for (const auto &body : bodies)
        {
          const auto   mesh     = refined(body.shape->size(), dim, body.refinements);
          const double unknowns = dim * count_nodes(mesh, numerics.degree);
          solid.elements += mesh.cells;
          solid.unknowns += unknowns;
          solid.work += unknowns * power(unknowns / mesh.slices, 2);
          // Each element couples all of its unknowns; those of a face are coupled by two.
          const double of_element = dim * power(numerics.degree + 1, dim);
          const double of_face    = dim * power(numerics.degree + 1, dim - 1);
          solid.entries += mesh.cells * power(of_element, 2) -
                           (dim * mesh.cells - mesh.faces / 2) * power(of_face, 2);
          if (size.grid.cells > 0)
            {
              auto surface = mesh;
              surface.faces *= numerics.degree * power(2, dim - 2); // see facets_of_element()
              add_surface<dim>(size.grid, surface, mean_width);
            }
        }
      const bool together = size.grid.cells > 0 && read_direction(scene) == Direction::two_way;
      const auto use      = together ? FactorUse::preconditioner : FactorUse::a_few_solves;
      solid.is_direct     = is_direct(numerics, bodies, solid.work, use);
    }
  } // namespace


  template <int dim>
  SceneSize
  measure_scene(const Options &options)
  {
    const Options scene(options.file()); // what is read here is not for the documentation
    SceneSize     size;
    size.dimension    = dim;
    const auto scheme = scene.choose<Scheme<dim>>("Scheme", "simultaneous", "");
    read_time(size, scene);
    if (scheme->method() == Scheme<dim>::Method::particles)
      {
        size.particles = measure_particles<dim>(scene);
        return size;
      }
    size.stages         = choose_time_integrator(scene)->stages(1, RatesAtBegin::known).size();
    const bool has_grid = scene.section("Fluid").given();
    const bool has_body = scene.section("Bodies").given();
    double     width    = 0;
    if (has_grid)
      {
        width = measure_grid<dim>(size.grid, scene);
        add_obstacles<dim>(size.grid, scene, width);
      }
    if (has_body)
      measure_bodies<dim>(size, scene, width);
    size.is_coupled = has_grid && has_body;
    for (const auto &effect : read_effects<dim>(scene.section("Effects")))
      size.has_contact = size.has_contact || effect->work().has_contact;
    size.grid.moves =
      size.grid.moves || (size.is_coupled && read_direction(scene) != Direction::fluid_to_body);
    size.grid.cut_cells = std::min(size.grid.cut_cells, size.grid.cells);
    return size;
  }


  template SceneSize
  measure_scene<2>(const Options &);
  template SceneSize
  measure_scene<3>(const Options &);
} // namespace undine
