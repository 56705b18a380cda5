// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_h
#define undine_fluid_advection_h

#include <undine/fluid/flow.h>

#include <string>

namespace undine
{
  /// How a field is carried with the flow for one step: ds/dt + v.grad s = 0. The same code serves
  /// scalars in cells and velocities on faces.
  template <int dim>
  class Advection
  {
  public:
    virtual ~Advection() = default;

    virtual void
    add_options(const Options &options) = 0;

    /// In a few words: "MacCormack, limited".
    virtual std::string
    summary() const = 0;

    /// The field at t + h from the field at t. Collective.
    virtual Field<dim>
    advect(const Flow<dim>              &flow,
           const Field<dim>             &field,
           const BoundaryCondition<dim> &condition) const = 0;
  };
} // namespace undine

#endif
