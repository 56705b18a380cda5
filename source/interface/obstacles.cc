// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/interface/face_facets.h>
#include <undine/interface/obstacles.h>
#include <undine/solid/body_shape.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace undine
{
  namespace
  {
    constexpr unsigned int refinements_of_curved_shapes = 4;


    /// What a scene says about one obstacle.
    template <int dim>
    struct Obstacle
    {
      Obstacle(const std::string &name, const Options &options)
        : name(name)
        , options(options)
        , shape(options.choose<BodyShape<dim>>("Shape", "box", "The shape at rest."))
        , has_map(options.given("Map"))
        , has_refinements(options.given("Refinements"))
      {
        options.add("Map",
                    map,
                    "m",
                    Allowed::anything(),
                    "Where each vertex of the refined shape is at rest, as a function of where the "
                    "shape has it; not given: there.");
        if (has_map && map.names_time())
          throw options.error("Map",
                              "depends on the time t, but says where the obstacle rests",
                              "Try: 'Displacement' for what moves.");
        options.add("Refinements",
                    refinements,
                    "1",
                    Allowed::between(0, 12),
                    "How often each facet of the surface is split in two along every direction; "
                    "not given: 4 times if the shape is curved or has a map, else not at all.");
        options.add("Displacement",
                    displacement,
                    "m",
                    Allowed::anything(),
                    "At time t, of the point that rests at x: a prescribed motion.");
      }

      std::string                     name;
      Options                         options;
      std::unique_ptr<BodyShape<dim>> shape;
      Expression<dim, dim>            map;
      bool                            has_map, has_refinements;
      unsigned int                    refinements = 0;
      Expression<dim, dim>            displacement;
    };


    template <int dim>
    std::vector<Obstacle<dim>>
    read_obstacles(const Options &scene)
    {
      const auto                 section = scene.section("Obstacles");
      std::vector<Obstacle<dim>> result;
      for (const auto &name : section.named_sections("pillar"))
        result.emplace_back(name, section.section(name));
      return result;
    }


    template <int dim>
    bool
    is_curved(const dealii::Triangulation<dim> &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int face : cell->face_indices())
          if (cell->at_boundary(face) && dynamic_cast<const dealii::FlatManifold<dim> *>(
                                           &cell->face(face)->get_manifold()) == nullptr)
            return true;
      return false;
    }


    /// Split all faces of the boundary; cells inside only as far as they must follow.
    template <int dim>
    void
    refine_boundary(dealii::Triangulation<dim> &mesh)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->at_boundary())
          cell->set_refine_flag();
      mesh.execute_coarsening_and_refinement();
    }


    /// The boundary of one obstacle.
    template <int dim>
    struct Boundary
    {
      std::vector<dealii::Point<dim>>           nodes;
      std::vector<typename Surface<dim>::Facet> facets;
    };


    template <int dim>
    Boundary<dim>
    collect_boundary(const dealii::Triangulation<dim> &mesh)
    {
      const auto                           facets_of_face = face_facets<dim>(1);
      std::map<unsigned int, unsigned int> numbers; // by vertex
      Boundary<dim>                        result;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int face : cell->face_indices())
          if (cell->at_boundary(face))
            for (auto facet : facets_of_face[face])
              {
                for (auto &corner : facet)
                  {
                    const auto found =
                      numbers.emplace(cell->vertex_index(corner), result.nodes.size());
                    if (found.second)
                      result.nodes.push_back(cell->vertex(corner));
                    corner = found.first->second;
                  }
                result.facets.push_back(facet);
              }
      return result;
    }


    /// Which cells may be why a mesh encloses no volume.
    template <int dim>
    std::string
    wrong_cells(const dealii::Triangulation<dim> &mesh)
    {
      std::set<std::array<double, dim>> centres;
      for (const auto &cell : mesh.cell_iterators_on_level(0))
        {
          std::array<double, dim> centre;
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] = cell->center()[d];
          const auto place = fmt::format("({:.4g})", fmt::join(centre, ", "));
          if (!centres.insert(centre).second)
            return ": two cells lie on each other at " + place;
          dealii::Point<dim>     vertices[1 << dim];
          dealii::Tensor<0, dim> volumes[1 << dim];
          for (unsigned int v = 0; v < (1u << dim); ++v)
            vertices[v] = cell->vertex(v);
          dealii::GeometryInfo<dim>::alternating_form_at_vertices(vertices, volumes);
          if (!(*std::min_element(std::begin(volumes), std::end(volumes)) > 0))
            return ": the cell at " + place + " is flat, inside out or crosses itself";
        }
      return "";
    }


    template <int dim>
    InputError
    no_volume(const Obstacle<dim> &obstacle, const dealii::Triangulation<dim> &mesh)
    {
      const std::string what    = "makes an obstacle that is inside out or has no volume";
      const auto       &options = obstacle.options;
      if (obstacle.has_map)
        return options.error(
          "Map", what, "Try: a map that is one-to-one and keeps the orientation.");
      if (!options.given("File"))
        return options.error("Shape", what, "Try: larger lengths.");
      std::string file;
      options.add("File", file, "", Allowed::anything(), "Mesh.");
      return options.error("File",
                           "'" + file + "' " + what + wrong_cells(mesh),
                           "Try: correct the mesh; cells share vertices with their neighbours "
                           "alone, numbered around them without crossing.");
    }


    /// Take each node to where the map has it.
    template <int dim>
    void
    apply_map(std::vector<dealii::Point<dim>> &nodes, const Obstacle<dim> &obstacle)
    {
      constexpr double farthest = 1e100; // of which differences and products stay finite
      for (auto &node : nodes)
        {
          const dealii::Point<dim> image(obstacle.map.vector(node, 0.));
          for (unsigned int d = 0; d < dim; ++d)
            if (!(std::abs(image[d]) < farthest))
              throw obstacle.options.error(
                "Map",
                fmt::format("takes ({:.4g}) to a place that is not a number, or too far away",
                            fmt::join(node.begin_raw(), node.begin_raw() + dim, ", ")),
                "Try: a map that is finite on the whole shape.");
          node = image;
        }
    }


    template <int dim>
    Boundary<dim>
    make_boundary(const Obstacle<dim> &obstacle)
    {
      dealii::Triangulation<dim> mesh;
      obstacle.shape->make_mesh(mesh);
      unsigned int refinements = obstacle.refinements;
      if (!obstacle.has_refinements && (obstacle.has_map || is_curved(mesh)))
        refinements = refinements_of_curved_shapes;
      for (unsigned int level = 0; level < refinements; ++level)
        refine_boundary(mesh);
      auto result = collect_boundary(mesh);
      if (obstacle.has_map)
        apply_map(result.nodes, obstacle);

      const Surface<dim> surface(result.nodes.size(),
                                 result.facets,
                                 std::vector<unsigned int>(result.facets.size(), 0),
                                 {obstacle.name});
      if (!(body_volumes(surface, result.nodes)[0] > 0))
        throw no_volume(obstacle, mesh);
      return result;
    }


    /// For each node the number of the closed surface that it belongs to: a hollow obstacle has one
    /// outside and one around each hole.
    template <int dim>
    std::vector<std::size_t>
    find_closed_surfaces(const Surface<dim> &surface)
    {
      DisjointSets joined(surface.n_nodes());
      for (const auto &facet : surface.facets())
        for (const unsigned int node : facet)
          joined.join(facet[0], node);
      std::vector<std::size_t> result;
      for (unsigned int node = 0; node < surface.n_nodes(); ++node)
        result.push_back(joined.smallest(node));
      return result;
    }


    /// int N n dGamma of each node, n out of the solid.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    node_normals(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
    {
      std::vector<dealii::Tensor<1, dim>> result(positions.size());
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        for (const unsigned int node : surface.facets()[facet])
          result[node] += area_vector(surface, facet, positions) / dim;
      return result;
    }


    /// Volume inside each closed surface, known by its lowest node; of a hole negative.
    template <int dim>
    std::vector<double>
    volumes_inside(const Surface<dim>                    &surface,
                   const std::vector<std::size_t>        &closed_surfaces,
                   const std::vector<dealii::Point<dim>> &positions)
    {
      std::vector<double> result(positions.size(), 0.);
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        {
          // Relative to a point of each: a small one far from the origin keeps its digits.
          const unsigned int node  = surface.facets()[facet][0];
          const auto         which = closed_surfaces[node];
          result[which] +=
            (positions[node] - positions[which]) * area_vector(surface, facet, positions) / dim;
        }
      return result;
    }


    /// Add to the velocities along the normals what makes the flux through each closed surface at
    /// `before` the rate at which the volume in it grows from `before` to `after`.
    template <int dim>
    void
    balance_volumes(std::vector<dealii::Tensor<1, dim>>   &velocities,
                    const Surface<dim>                    &surface,
                    const std::vector<dealii::Point<dim>> &before,
                    const std::vector<dealii::Point<dim>> &after,
                    const double                           dt)
    {
      const auto          which       = find_closed_surfaces(surface);
      const auto          old_volumes = volumes_inside(surface, which, before);
      const auto          new_volumes = volumes_inside(surface, which, after);
      const auto          normals     = node_normals(surface, before);
      std::vector<double> missing(before.size()), areas(before.size(), 0.);
      for (unsigned int s = 0; s < missing.size(); ++s)
        missing[s] = (new_volumes[s] - old_volumes[s]) / dt;
      for (unsigned int node = 0; node < before.size(); ++node)
        {
          missing[which[node]] -= velocities[node] * normals[node];
          areas[which[node]] += normals[node].norm();
        }
      for (unsigned int node = 0; node < before.size(); ++node)
        if (const double area = normals[node].norm(); area > 0)
          velocities[node] += missing[which[node]] / areas[which[node]] / area * normals[node];
    }
  } // namespace


  template <int dim>
  void
  Obstacles<dim>::declare(const Options &scene)
  {
    read_obstacles<dim>(scene);
  }


  template <int dim>
  Obstacles<dim>::Obstacles(const Options &scene)
  {
    std::vector<typename Surface<dim>::Facet> facets;
    std::vector<unsigned int>                 obstacle_of_facet;
    std::vector<std::string>                  names;
    for (const auto &obstacle : read_obstacles<dim>(scene))
      {
        const auto         boundary = make_boundary(obstacle);
        const unsigned int first    = rest_positions.size();
        for (auto facet : boundary.facets)
          {
            for (auto &node : facet)
              node += first;
            facets.push_back(facet);
          }
        obstacle_of_facet.resize(facets.size(), names.size());
        rest_positions.insert(rest_positions.end(), boundary.nodes.begin(), boundary.nodes.end());
        obstacle_of_node.resize(rest_positions.size(), names.size());
        displacements.push_back(obstacle.displacement);
        names.push_back(obstacle.name);
      }
    all_facets =
      std::make_unique<const Surface<dim>>(rest_positions.size(), facets, obstacle_of_facet, names);
  }


  template <int dim>
  bool
  Obstacles<dim>::move() const
  {
    return std::any_of(displacements.begin(), displacements.end(), [](const auto &displacement) {
      return !displacement.is_zero();
    });
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  Obstacles<dim>::positions(const double time) const
  {
    auto result = rest_positions;
    for (unsigned int node = 0; node < result.size(); ++node)
      if (const auto &displacement = displacements[obstacle_of_node[node]]; !displacement.is_zero())
        result[node] += displacement.vector(rest_positions[node], time);
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  Obstacles<dim>::velocities(const double time, const double dt) const
  {
    const auto                          before = positions(time), after = positions(time + dt);
    std::vector<dealii::Tensor<1, dim>> result(before.size());
    for (unsigned int node = 0; node < result.size(); ++node)
      result[node] = (after[node] - before[node]) / dt;
    if (move())
      balance_volumes(result, *all_facets, before, after, dt);
    return result;
  }


  template class Obstacles<2>;
  template class Obstacles<3>;
} // namespace undine
