// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_geometry_arrays_h
#define undine_output_checkpoint_geometry_arrays_h

#include <undine/output/checkpoint/state_arrays.h>

#include <string>
#include <vector>

namespace undine
{
  /// A few numbers about each part of the geometry that the values of a state belong to: planes of
  /// the grid, vertices of bodies at rest, nodes of obstacles at `time` [s], particles of bodies at
  /// rest. If a point moves, is added or changes its place in the order, they change: number of
  /// points, sum of all |x|, and for each direction the sum of the coordinates with weights between
  /// -1 and 1 that look random. All on the first rank. Collective.
  template <int dim>
  std::vector<StateArray>
  geometry_arrays(const Models<dim> &models, double time);

  /// The first part of the geometry that differs between a checkpoint and the scene, such as "the
  /// grid of the fluid"; empty if none does. Sums may differ by rounding. Collective.
  std::string
  geometry_difference(const std::vector<StateArray> &of_checkpoint,
                      const std::vector<StateArray> &of_scene,
                      MPI_Comm                       communicator);
} // namespace undine

#endif
