// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_checkpoint_state_arrays_h
#define undine_output_checkpoint_state_arrays_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/output/files/selection.h>

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

  /// The array that holds SolidState::fluid_loads in a checkpoint.
  inline const std::string fluid_loads_array = "solid/loads of the fluid";

  /// The array that holds SolidState::contact_forces in a checkpoint, while bodies touch something.
  inline const std::string contact_forces_array = "solid/forces of contact";

  /// The array that holds SolidState::impulse_acceleration in a checkpoint, if there is one.
  inline const std::string impulse_acceleration_array = "solid/acceleration by impulses";

  /// The arrays that hold FluidState::scalar_rates in a checkpoint, followed by the scalar's name.
  inline const std::string scalar_rates_array = "fluid/scalar_rates/";

  /// The array that holds DualVolumeRates::time in a checkpoint, if those rates are in use.
  inline const std::string volume_rate_time_array = "fluid/time of volume rates";

  /// `numbers`, the same on all ranks, of which the first rank writes all.
  StateArray
  numbers_of_first_rank(const std::string         &name,
                        const std::vector<double> &numbers,
                        MPI_Comm                   communicator);

  /// Positions of the nodes of all surfaces in the fluid when its fields were computed [m]: they
  /// determine the topology of the fields of pack(). No array if there is no surface.
  /// unpack_surface() cuts the grid by them and sets all fields to zero on it. Collective. @{
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
  /// first direction running fastest, and so are the sub-cells and sub-faces of divided points. Of
  /// nodes, sub-cells and sub-faces each rank holds a stretch of equal length. Collective.
  template <int dim>
  std::vector<StateArray>
  pack(const Models<dim> &models, const State<dim> &state);

  /// Set the values of `state` from `arrays`, those of pack() for a state of the same shape.
  /// Collective.
  template <int dim>
  void
  unpack(State<dim> &state, const Models<dim> &models, const std::vector<StateArray> &arrays);
} // namespace undine

#endif
