// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_node_damping_h
#define undine_fluid_viscosity_node_damping_h

#include <vector>

namespace undine
{
  /// An entry of a matrix over the nodes of surfaces for velocities along one axis: the force in
  /// `row` over the velocity of `column` with which a fluid resists [kg/s].
  struct NodeDamping
  {
    unsigned int row = 0, column = 0;
    double       value = 0;

    /// As boost's archives ask for it, in which values go between ranks.
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &row &column &value;
    }
  };

  /// Entries of a symmetric matrix, sums of which count where there are several in one place.
  using NodeDampings = std::vector<NodeDamping>;
} // namespace undine

#endif
