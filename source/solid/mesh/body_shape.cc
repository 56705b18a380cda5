// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/body_shape.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    template <int dim, class Action>
    void
    for_each_outer_face(const dealii::Triangulation<dim> &mesh, const Action &action)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            action(face);
    }
  } // namespace


  template <int dim>
  ShapeSize
  BodyShape<dim>::size() const
  {
    dealii::Triangulation<dim> mesh;
    make_mesh(mesh);
    ShapeSize              size;
    dealii::Tensor<1, dim> extents; // the sum of those of the cells
    size.cells = mesh.n_active_cells();
    size.parts = {{double(mesh.n_used_vertices()),
                   double(mesh.n_active_lines()),
                   double(mesh.n_active_quads()),
                   double(mesh.n_active_hexs())}};
    for (const auto &cell : mesh.active_cell_iterators())
      for (unsigned int axis = 0; axis < dim; ++axis)
        extents[axis] += cell->extent_in_direction(axis);
    const auto box = dealii::GridTools::compute_bounding_box(mesh);
    for (unsigned int axis = 0; axis < dim; ++axis)
      size.slices = std::max(size.slices, box.side_length(axis) * size.cells / extents[axis]);
    for_each_outer_face(mesh, [&](const auto &face) {
      size.faces += 1;
      size.is_curved = size.is_curved || dynamic_cast<const dealii::FlatManifold<dim> *>(
                                           &face->get_manifold()) == nullptr;
    });
    if (size.is_curved)
      mesh.refine_global(2); // few flat faces enclose much less than the curved boundary
    size.volume = dealii::GridTools::volume(mesh);
    for_each_outer_face(mesh, [&](const auto &face) { size.area += face->measure(); });
    return size;
  }


  template class BodyShape<2>;
  template class BodyShape<3>;
} // namespace undine
