// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/mesh/body_shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// Rotate `vector` in the plane of two axes, from the first towards the second.
    template <int dim>
    void
    rotate(dealii::Point<dim> &vector,
           const unsigned int  first,
           const unsigned int  second,
           const double        angle)
    {
      const double a = vector[first], b = vector[second];
      vector[first]  = std::cos(angle) * a - std::sin(angle) * b;
      vector[second] = std::sin(angle) * a + std::cos(angle) * b;
    }
  } // namespace


  /// A block with edges along the axes, then turned about its centre; a sheet if it is thin.
  template <int dim>
  class Box : public BodyShape<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        upper[axis] = 1;
      options.add(
        "Lower corner", lower, "m", Allowed::anything(), "Corner with the least x, y, z.");
      options.add("Upper corner", upper, "m", Allowed::anything(), "Corner opposite to it.");
      read_centre_and_size(options);
      for (unsigned int axis = 0; axis < dim; ++axis)
        if (!(upper[axis] > lower[axis]))
          throw options.error("Upper corner",
                              "must be above the lower corner in every direction",
                              "Try: exchange the two, or give 'Centre' and 'Size'.");
      cells.fill(1);
      options.add("Cells", cells, "1", Allowed::positive(), "Cells along each edge.");
      angles.assign(n_rotations, 0.);
      options.add("Rotation",
                  angles,
                  "degrees",
                  Allowed::anything(),
                  "About the box's centre; 2D: one angle, counter-clockwise; 3D: about x, then y, "
                  "then z.");
      if (angles.size() != n_rotations)
        throw options.error("Rotation",
                            "has " + std::to_string(angles.size()) + " angles",
                            "Allowed: " + std::to_string(n_rotations) + " number(s) [degrees]");
    }

    void
    make_mesh(dealii::Triangulation<dim> &mesh) const override
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(
        mesh, std::vector<unsigned int>(cells.begin(), cells.end()), lower, upper, true);
      const auto centre = lower + (upper - lower) / 2.;
      dealii::GridTools::transform([&](const auto &vertex) { return turned(vertex, centre); },
                                   mesh);
      mesh.reset_all_manifolds();
      mesh.set_all_manifold_ids(dealii::numbers::flat_manifold_id);
    }

    typename BodyShape<dim>::Sides
    sides(const dealii::Triangulation<dim> &) const override
    {
      const std::vector<std::string> names{"left", "right", "bottom", "top", "back", "front"};
      typename BodyShape<dim>::Sides result;
      for (unsigned int side = 0; side < 2 * dim; ++side)
        result[names[side]] = side;
      return result;
    }

    ShapeSize
    size() const override
    {
      ShapeSize size;
      size.cells = size.volume = 1;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          size.cells *= cells[axis];
          size.volume *= upper[axis] - lower[axis];
          size.slices = std::max<double>(size.slices, cells[axis]);
        }
      // Vertices, lines, ... are products of the vertices and lines along the axes.
      size.parts[0] = 1;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (unsigned int k = axis + 2; k-- > 0;)
          size.parts[k] =
            size.parts[k] * (cells[axis] + 1.) + (k > 0 ? size.parts[k - 1] * cells[axis] : 0.);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          size.faces += 2 * size.cells / cells[axis];
          size.area += 2 * size.volume / (upper[axis] - lower[axis]);
        }
      return size;
    }

  private:
    static constexpr unsigned int n_rotations = dim * (dim - 1) / 2;

    void
    read_centre_and_size(const Options &options)
    {
      const bool         instead = options.given("Centre") || options.given("Size");
      dealii::Point<dim> centre  = lower + (upper - lower) / 2.;
      auto               size    = upper - lower;
      options.add("Centre", centre, "m", Allowed::anything(), "Instead of the corners.");
      options.add("Size", size, "m", Allowed::positive(), "Edge lengths; instead of the corners.");
      if (instead && (options.given("Lower corner") || options.given("Upper corner")))
        throw options.error(options.given("Centre") ? "Centre" : "Size",
                            "contradicts the corners that are given as well",
                            "Try: give either 'Centre' and 'Size' or the two corners.");
      if (instead && !options.is_reference())
        {
          lower = centre - size / 2.;
          upper = centre + size / 2.;
        }
    }

    dealii::Point<dim>
    turned(const dealii::Point<dim> &vertex, const dealii::Point<dim> &centre) const
    {
      dealii::Point<dim> from_centre(vertex - centre);
      // In 3D axis k turns the plane of the two axes that follow it; 2D knows only the last of
      // these.
      for (unsigned int turn = 0; turn < n_rotations; ++turn)
        if (angles[turn] != 0)
          {
            const unsigned int axis = n_rotations == 1 ? 2 : turn;
            rotate(from_centre,
                   (axis + 1) % 3,
                   (axis + 2) % 3,
                   angles[turn] * dealii::numbers::PI / 180);
          }
      return centre + from_centre;
    }

    dealii::Point<dim>            lower;
    dealii::Point<dim>            upper;
    std::array<unsigned int, dim> cells;
    std::vector<double>           angles; ///< [degrees]
  };


  static const RegisterForDimensions<BodyShape, Box>
    box("box", "A block or sheet; sides left, right, bottom, top, back, front.");
} // namespace undine
