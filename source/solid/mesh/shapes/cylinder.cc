// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/mesh/body_shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// A full circular cylinder; there is none in 2D, where `ball` is a disk.
  class Cylinder : public BodyShape<3>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Centre", centre, "m", Allowed::anything(), "Middle of the axis.");
      options.add("Radius", radius, "m", Allowed::positive(), "Of the cylinder.");
      options.add("Length", length, "m", Allowed::positive(), "Along the axis.");
      options.add("Axis", axis_name, "", Allowed::one_of(axis_names), "Direction of the axis.");
      options.add("Cells", cells, "1", Allowed::positive(), "Layers of cells along the axis.");
    }

    void
    make_mesh(dealii::Triangulation<3> &mesh) const override
    {
      dealii::GridGenerator::subdivided_cylinder(mesh, cells, radius, length / 2);
      const unsigned int axis =
        std::find(axis_names.begin(), axis_names.end(), axis_name) - axis_names.begin();
      // A cyclic exchange of the axes keeps cells right-handed.
      dealii::GridTools::transform(
        [&](const dealii::Point<3> &vertex) {
          dealii::Point<3> moved = centre;
          for (unsigned int i = 0; i < 3; ++i)
            moved[(i + axis) % 3] += vertex[i];
          return moved;
        },
        mesh);
      const dealii::Tensor<1, 3> direction = dealii::Point<3>::unit_vector(axis);
      mesh.set_manifold(0, dealii::CylindricalManifold<3>(direction, centre));
    }

    Sides
    sides(const dealii::Triangulation<3> &) const override
    {
      return {{"surface", 0}, {"start", 1}, {"end", 2}};
    }

    ShapeSize
    size() const override
    {
      constexpr double pi = dealii::numbers::PI;
      // A disk across: 5 cells, 8 vertices, 12 lines of which 4 are on the boundary.
      ShapeSize    size;
      const double n = cells;
      size.cells     = 5 * n;
      size.parts     = {{8 * (n + 1), 12 * (n + 1) + 8 * n, 5 * (n + 1) + 12 * n, 5 * n}};
      size.faces     = 2 * 5 + 4 * n;
      size.slices    = std::max(n, std::sqrt(5.));
      size.volume    = pi * radius * radius * length;
      size.area      = 2 * pi * radius * (radius + length);
      size.is_curved = true;
      return size;
    }

  private:
    const std::vector<std::string> axis_names{"x", "y", "z"};

    dealii::Point<3> centre;
    double           radius    = 1;
    double           length    = 1;
    std::string      axis_name = "x";
    unsigned int     cells     = 2;
  };


  static const Register<BodyShape<3>, Cylinder>
    cylinder("cylinder", "A circular cylinder (3D); sides surface, start, end (along its axis).");
} // namespace undine
