// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_mesh.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <tuple>

namespace undine
{
  namespace
  {
    template <int dim>
    using MeshDescription = std::tuple<std::vector<dealii::Point<dim>>,
                                       std::vector<dealii::CellData<dim>>,
                                       dealii::SubCellData>;


    /// Is the volume element positive at every vertex?
    template <int dim>
    bool
    is_valid(const std::vector<dealii::Point<dim>> &vertices, const dealii::CellData<dim> &cell)
    {
      using Geometry = dealii::GeometryInfo<dim>;
      dealii::Point<dim>     corners[Geometry::vertices_per_cell];
      dealii::Tensor<0, dim> volume_elements[Geometry::vertices_per_cell];
      for (const unsigned int v : Geometry::vertex_indices())
        corners[v] = vertices[cell.vertices[v]];
      Geometry::alternating_form_at_vertices(corners, volume_elements);
      for (const auto &volume_element : volume_elements)
        if (!(volume_element > 0))
          return false;
      return true;
    }


    /// The refined cells of a body as a list, at rest.
    template <int dim>
    MeshDescription<dim>
    describe(const Body<dim>                  &body,
             const unsigned int                index,
             const dealii::Triangulation<dim> &mesh)
    {
      dealii::Triangulation<dim> flat;
      dealii::GridGenerator::flatten_triangulation(mesh, flat);
      flat.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
      auto description = dealii::GridTools::get_coarse_mesh_description(flat);

      auto &vertices = std::get<0>(description);
      if (body.has_map)
        for (auto &vertex : vertices)
          vertex = dealii::Point<dim>(body.map.vector(vertex, 0.));
      for (auto &cell : std::get<1>(description))
        {
          cell.material_id = index;
          if (!is_valid(vertices, cell))
            throw body.options.error(body.has_map ? "Map" : "Shape",
                                     "makes a cell that is inverted or has no volume",
                                     "Try: a map that is one-to-one and keeps the orientation.");
        }
      return description;
    }


    /// Append a list of faces or edges, whose vertices are counted from `first_vertex`.
    template <class Objects>
    void
    append(Objects &objects, const Objects &others, const unsigned int first_vertex)
    {
      for (auto object : others)
        {
          for (auto &vertex : object.vertices)
            vertex += first_vertex;
          objects.push_back(object);
        }
    }


    template <int dim>
    void
    append(MeshDescription<dim> &mesh, const MeshDescription<dim> &other)
    {
      auto &[vertices, cells, parts]                         = mesh;
      const auto &[other_vertices, other_cells, other_parts] = other;
      const unsigned int first_vertex                        = vertices.size();
      vertices.insert(vertices.end(), other_vertices.begin(), other_vertices.end());
      append(cells, other_cells, first_vertex);
      append(parts.boundary_lines, other_parts.boundary_lines, first_vertex);
      append(parts.boundary_quads, other_parts.boundary_quads, first_vertex);
    }


    /// The ids of the sides that a boundary names; empty: all sides.
    template <int dim>
    std::vector<dealii::types::boundary_id>
    named_sides(const BodyBoundary<dim> &boundary, const typename BodyShape<dim>::Sides &sides)
    {
      std::vector<dealii::types::boundary_id> result;
      for (const auto &name : boundary.sides)
        {
          const auto side = sides.find(name);
          if (side == sides.end())
            {
              std::string all;
              for (const auto &other : sides)
                all += (all.empty() ? "" : " | ") + other.first;
              throw boundary.options.error("Sides",
                                           "names a side '" + name +
                                             "' that the shape does not have",
                                           "Allowed: " + all);
            }
          result.push_back(side->second);
        }
      return result;
    }


    template <class Face, int dim>
    bool
    selects(const BodyBoundary<dim>                       &boundary,
            const std::vector<dealii::types::boundary_id> &sides,
            const Face                                    &face)
    {
      const bool on_side =
        sides.empty() || std::find(sides.begin(), sides.end(), face->boundary_id()) != sides.end();
      return face->at_boundary() && on_side && boundary.where.value(face->center(), 0.) > 0;
    }
  } // namespace


  template <int dim>
  std::vector<typename BodyShape<dim>::Sides>
  make_solid_mesh(dealii::parallel::shared::Triangulation<dim> &mesh,
                  const std::vector<Body<dim>>                 &bodies,
                  const std::vector<bool>                      &kept)
  {
    MeshDescription<dim>                        all;
    std::vector<typename BodyShape<dim>::Sides> sides(bodies.size());
    for (unsigned int index = 0; index < bodies.size(); ++index)
      {
        if (!kept[index])
          continue;
        dealii::Triangulation<dim> shape;
        bodies[index].shape->make_mesh(shape);
        shape.refine_global(bodies[index].refinements);
        sides[index] = bodies[index].shape->sides(shape);
        append(all, describe(bodies[index], index, shape));
      }
    mesh.create_triangulation(std::get<0>(all), std::get<1>(all), std::get<2>(all));
    return sides;
  }


  template <int dim>
  std::vector<LoadedFace<dim>>
  select_faces(const dealii::Triangulation<dim>                  &mesh,
               const std::vector<Body<dim>>                      &bodies,
               const std::vector<bool>                           &kept,
               const std::vector<typename BodyShape<dim>::Sides> &sides)
  {
    std::vector<LoadedFace<dim>> result;
    for (unsigned int body = 0; body < bodies.size(); ++body)
      for (unsigned int b = 0; kept[body] && b < bodies[body].boundaries.size(); ++b)
        {
          const auto &boundary = bodies[body].boundaries[b];
          const auto  ids      = named_sides<dim>(boundary, sides[body]);
          const auto  before   = result.size();
          for (const auto &cell : mesh.active_cell_iterators())
            if (cell->material_id() == body && cell->at_boundary())
              for (const unsigned int face : cell->face_indices())
                if (selects(boundary, ids, cell->face(face)))
                  result.push_back({cell, face, body, b});
          if (result.size() == before)
            throw boundary.options.error("Where",
                                         "together with 'Sides' selects no face of the body",
                                         "Try: another expression or side; faces are selected by "
                                         "their centre at rest.");
        }
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                         \
  template std::vector<typename BodyShape<dim>::Sides> make_solid_mesh( \
    dealii::parallel::shared::Triangulation<dim> &,                     \
    const std::vector<Body<dim>> &,                                     \
    const std::vector<bool> &);                                         \
  template std::vector<LoadedFace<dim>> select_faces(                   \
    const dealii::Triangulation<dim> &,                                 \
    const std::vector<Body<dim>> &,                                     \
    const std::vector<bool> &,                                          \
    const std::vector<typename BodyShape<dim>::Sides> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
