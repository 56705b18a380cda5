// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_state_arrays_h
#define undine_output_checkpoint_state_arrays_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/files/hdf5_file.h>

#include <string>
#include <vector>

namespace undine
{
  /// A named array whose whole does not depend on the number of ranks, and this rank's box of it.
  struct StateArray
  {
    std::string         name; ///< "solid/velocity", "fluid/pressure"
    Selection           selection;
    std::vector<double> values;
  };

  /// Where the surfaces of what stands in the fluid were, node by node: it decides which parts the
  /// fields of pack() have. No array if nothing does. The reverse leaves all fields zero, on the
  /// grid as those surfaces cut it. Collective. @{
  template <int dim>
  std::vector<StateArray>
  pack_surface(const Models<dim> &models, const State<dim> &state);

  template <int dim>
  void
  unpack_surface(State<dim>                    &state,
                 const Models<dim>             &models,
                 const std::vector<StateArray> &arrays);
  /// @}

  /// Everything else in `state` but its clock. Nodal vectors are in the order of
  /// SolidModel::canonical_order(); fields of the fluid are in the order of their lattice, the
  /// first direction running fastest, and so are the parts of its divided points. Of nodes and
  /// parts each rank holds a stretch of equal length. Collective.
  template <int dim>
  std::vector<StateArray>
  pack(const Models<dim> &models, const State<dim> &state);

  /// The reverse. `arrays` are those of pack() for a state of the same parts, with other values.
  /// Collective.
  template <int dim>
  void
  unpack(State<dim> &state, const Models<dim> &models, const std::vector<StateArray> &arrays);
} // namespace undine

#endif
