// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_solid_mesh_h
#define undine_solid_mesh_solid_mesh_h

#include <undine/solid/mesh/body.h>

#include <deal.II/distributed/shared_tria.h>

#include <vector>

namespace undine
{
  /// Put the meshes of all bodies, mapped and refined, side by side into an empty mesh. Bodies that
  /// touch stay separate. material_id is the index of the body, boundary_id that of the shape's
  /// side. Bodies that are not `kept` are left out. Returns the sides of each body. Throws
  /// InputError if a mesh is not valid.
  template <int dim>
  std::vector<typename BodyShape<dim>::Sides>
  make_solid_mesh(dealii::parallel::shared::Triangulation<dim> &mesh,
                  const std::vector<Body<dim>>                 &bodies,
                  const std::vector<bool>                      &kept);

  /// A face of the boundary and the boundary condition on it.
  template <int dim>
  struct LoadedFace
  {
    typename dealii::Triangulation<dim>::active_cell_iterator cell;
    unsigned int                                              face;
    unsigned int                                              body;     ///< index
    unsigned int                                              boundary; ///< index in the body
  };

  /// The faces that the boundaries of the `kept` bodies select, in the order of the bodies, their
  /// boundaries and the cells; of all ranks. Throws InputError if a boundary selects none, or names
  /// a side that the shape does not have.
  template <int dim>
  std::vector<LoadedFace<dim>>
  select_faces(const dealii::Triangulation<dim>                  &mesh,
               const std::vector<Body<dim>>                      &bodies,
               const std::vector<bool>                           &kept,
               const std::vector<typename BodyShape<dim>::Sides> &sides);
} // namespace undine

#endif
