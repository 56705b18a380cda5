// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/face_facets.h>
#include <undine/surface/shape_boundary.h>

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


    template <int dim>
    ShapeBoundary<dim>
    collect_boundary(const dealii::Triangulation<dim> &mesh)
    {
      const auto                           facets_of_face = face_facets<dim>(1);
      std::map<unsigned int, unsigned int> numbers; // by vertex
      ShapeBoundary<dim>                   result;
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
                result.sides.push_back(cell->face(face)->boundary_id());
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
    no_volume(const ShapeDescription<dim> &description, const dealii::Triangulation<dim> &mesh)
    {
      const std::string what    = "makes an obstacle that is inside out or has no volume";
      const auto       &options = description.options;
      if (description.has_map)
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
    apply_map(std::vector<dealii::Point<dim>> &nodes, const ShapeDescription<dim> &description)
    {
      constexpr double farthest = 1e100; // of which differences and products stay finite
      for (auto &node : nodes)
        {
          const dealii::Point<dim> image(description.map.vector(node, 0.));
          for (unsigned int d = 0; d < dim; ++d)
            if (!(std::abs(image[d]) < farthest))
              throw description.options.error(
                "Map",
                fmt::format("takes ({:.4g}) to a place that is not a number, or too far away",
                            fmt::join(node.begin_raw(), node.begin_raw() + dim, ", ")),
                "Try: a map that is finite on the whole shape.");
          node = image;
        }
    }


    template <int dim>
    bool
    has_volume(const ShapeBoundary<dim> &boundary, const std::string &name)
    {
      return body_volumes(boundary.surface(name), boundary.nodes)[0] > 0;
    }


    template <int dim>
    ShapeBoundary<dim>
    make_boundary_of_shape(const ShapeDescription<dim> &description)
    {
      dealii::Triangulation<dim> mesh;
      description.shape->make_mesh(mesh);
      unsigned int refinements = description.refinements;
      if (!description.has_refinements && (description.has_map || is_curved(mesh)))
        refinements = refinements_of_curved_shapes;
      const auto names = description.shape->sides(mesh);
      for (unsigned int level = 0; level < refinements; ++level)
        refine_boundary(mesh);
      auto result       = collect_boundary(mesh);
      result.side_names = names;
      if (description.has_map)
        apply_map(result.nodes, description);
      if (!has_volume(result, description.name))
        throw no_volume(description, mesh);
      return result;
    }
  } // namespace


  template <int dim>
  ShapeDescription<dim>::ShapeDescription(const std::string &name, const Options &options)
    : name(name)
    , options(options)
    , has_map(options.given("Map"))
    , has_refinements(options.given("Refinements"))
  {
    options.add("Surface",
                surface_file,
                "",
                Allowed::anything(),
                "File of a closed surface, instead of a shape: STL (3D, text or binary), or "
                "triangles (3D) or lines (2D) of a mesh of Gmsh.");
    options.add("Surface scale",
                surface_scale,
                "1",
                Allowed::positive(),
                "Factor on all lengths in the file of the surface.");
    for (const char *key : {"Shape", "Refinements"})
      if (!options.is_reference() && !surface_file.empty() && options.given(key))
        throw options.error(
          key, "contradicts 'Surface', which is given as well", "Remove one of the two.");
    if (!options.is_reference() && surface_file.empty() && options.given("Surface scale"))
      throw options.error("Surface scale", "is given, but no 'Surface'", "Remove it.");
    if (surface_file.empty())
      shape = options.choose<BodyShape<dim>>("Shape", "box", "The shape at rest.");
    options.add("Map",
                map,
                "m",
                Allowed::constant_in_time(),
                "Where each vertex of the refined shape is at rest, as a function of where the "
                "shape has it; not given: there.");
    options.add("Refinements",
                refinements,
                "1",
                Allowed::between(0, 12),
                "How often each facet of the surface is split in two along every direction; "
                "not given: 4 times if the shape is curved or has a map, else not at all.");
  }


  template <int dim>
  Surface<dim>
  ShapeBoundary<dim>::surface(const std::string &name) const
  {
    return Surface<dim>(nodes.size(), facets, std::vector<unsigned int>(facets.size(), 0), {name});
  }


  template <int dim>
  ShapeBoundary<dim>
  make_shape_boundary(const ShapeDescription<dim> &description)
  {
    if (description.surface_file.empty())
      return make_boundary_of_shape(description);
    auto result = read_surface_file<dim>(
      description.options, description.surface_file, description.surface_scale);
    if (description.has_map)
      apply_map(result.nodes, description);
    if (!has_volume(result, description.name))
      throw description.options.error(
        "Map", "turns the surface inside out or leaves no volume", "Try: another map.");
    return result;
  }


  template struct ShapeDescription<2>;
  template struct ShapeDescription<3>;
  template struct ShapeBoundary<2>;
  template struct ShapeBoundary<3>;
  template ShapeBoundary<2>
  make_shape_boundary(const ShapeDescription<2> &);
  template ShapeBoundary<3>
  make_shape_boundary(const ShapeDescription<3> &);
} // namespace undine
