// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_shape_boundary_h
#define undine_surface_shape_boundary_h

#include <undine/solid/mesh/body_shape.h>
#include <undine/surface/surface.h>

#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// The description in a scene of something of which only the boundary matters: a shape as bodies
  /// have it, or a file of a closed surface.
  template <int dim>
  struct ShapeDescription
  {
    /// Read the keys of the section `name`. Throws InputError.
    ShapeDescription(const std::string &name, const Options &options);

    std::string                     name;
    Options                         options;      ///< for messages about this section
    std::unique_ptr<BodyShape<dim>> shape;        ///< if there is no file
    std::string                     surface_file; ///< empty: none
    double                          surface_scale = 1;
    Expression<dim, dim>            map; ///< where each node is at rest [m]
    bool                            has_map         = false;
    bool                            has_refinements = false;
    unsigned int                    refinements     = 0;
  };

  /// The closed boundary of a shape, cut into facets.
  template <int dim>
  struct ShapeBoundary
  {
    std::vector<dealii::Point<dim>>           nodes; ///< [m]
    std::vector<typename Surface<dim>::Facet> facets;
    std::vector<dealii::types::boundary_id>   sides; ///< of the shape, by facet
    typename BodyShape<dim>::Sides            side_names;

    /// As a surface of one body.
    Surface<dim>
    surface(const std::string &name) const;
  };

  /// Build it. Curved shapes and those with a map are refined 4 times unless the scene says
  /// otherwise. Throws InputError if it is inside out or encloses no volume, FileError.
  template <int dim>
  ShapeBoundary<dim>
  make_shape_boundary(const ShapeDescription<dim> &description);

  /// A closed surface from a file: triangles of an STL file (3D), or triangles (3D) or lines (2D)
  /// of a mesh of Gmsh. Nodes at one place become one; the surface is turned so that it encloses a
  /// positive volume. Throws InputError naming the key `Surface` of `options`.
  template <int dim>
  ShapeBoundary<dim>
  read_surface_file(const Options &options, const std::string &file, const double scale);
} // namespace undine

#endif
