// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_body_shape_h
#define undine_solid_mesh_body_shape_h

#include <undine/base/options/options.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <string>

namespace undine
{
  /// The size of a shape and of its mesh.
  struct ShapeSize
  {
    /// How many of each there are in the whole mesh: vertices, lines, quadrilaterals, hexahedra.
    using Parts = std::array<double, 4>;

    double cells     = 0;
    Parts  parts     = {};
    double faces     = 0;     ///< on the boundary
    double slices    = 1;     ///< cells along the axis along which there are most
    double volume    = 0;     ///< [m^dim]
    double area      = 0;     ///< of the boundary [m^(dim-1)]
    bool   is_curved = false; ///< refinement puts new boundary vertices elsewhere than in between
  };

  /// The shape of a body at rest, as a mesh of quadrilaterals or hexahedra. One shape is one .cc
  /// file that registers itself.
  template <int dim>
  class BodyShape
  {
  public:
    /// The parts of the boundary that a scene can name, and their boundary indicators.
    using Sides = std::map<std::string, dealii::types::boundary_id>;

    virtual ~BodyShape() = default;

    /// Declare and read the keys of this shape.
    virtual void
    add_options(const Options &options) = 0;

    /// Fill an empty mesh; lengths in m. Its manifolds say where refinement puts new vertices.
    /// Throws InputError if the values given make no mesh, FileError if a file cannot be read.
    virtual void
    make_mesh(dealii::Triangulation<dim> &mesh) const = 0;

    /// The sides of a mesh that make_mesh() filled.
    virtual Sides
    sides(const dealii::Triangulation<dim> &mesh) const = 0;

    /// For estimates: of the mesh that make_mesh() would make. Shapes whose mesh may be large
    /// compute it without making the mesh. Throws as make_mesh() does.
    virtual ShapeSize
    size() const;
  };
} // namespace undine

#endif
