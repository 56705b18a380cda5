// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_solid_point_h
#define undine_solid_mesh_solid_point_h

#include <undine/solid/mesh/solid_model.h>

namespace undine
{
  /// A material point of one body, found once; reads nodal fields there.
  template <int dim>
  class SolidPoint
  {
  public:
    /// The point of the body `body` (its name) that rests at `position` [m]; outside the body by
    /// rounding is inside. Throws InputError if the body does not exist, or is farther away than a
    /// millionth of a cell. Collective.
    SolidPoint(const SolidModel<dim>    &model,
               const std::string        &body,
               const dealii::Point<dim> &position);

    /// A nodal field (displacement, velocity, ...) at this point. Collective; the same on all
    /// ranks, and for any number of them.
    dealii::Tensor<1, dim>
    value(const dealii::TrilinosWrappers::MPI::Vector &field);

  private:
    MPI_Comm                                     communicator;
    unsigned int                                 owner; ///< rank of the cell
    std::vector<dealii::types::global_dof_index> dofs;  ///< of the cell that this rank owns
    std::vector<double>                          shapes;
    std::vector<unsigned int>                    axes;
    dealii::TrilinosWrappers::MPI::Vector        readable; ///< at the relevant degrees of freedom
  };
} // namespace undine

#endif
