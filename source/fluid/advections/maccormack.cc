// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection.h>
#include <undine/fluid/interpolation.h>

#include <algorithm>
#include <vector>

namespace undine
{
  /// Semi-Lagrangian step forward, one back, and half of what that round trip changed subtracted:
  ///
  ///     s1 = A(s^n),  s0 = A^-1(s1),  s^{n+1} = s1 + (s^n - s0) / 2
  ///
  /// for fields with a maximum principle limited to the bounds of the samples that made s1. Second
  /// order in space (Selle, Fedkiw, Kim, Liu, Rossignac 2008). Plain semi-Lagrangian where a path
  /// ends at an opening or inflow.
  template <int dim>
  class MacCormack : public Advection<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "MacCormack";
    }

    Field<dim>
    advect(const Flow<dim>              &flow,
           const Field<dim>             &field,
           const BoundaryCondition<dim> &condition) const override
    {
      const auto                &model   = flow.model();
      const bool                 limited = condition.obeys_maximum_principle();
      const double               dt      = flow.dt();
      Field<dim>                 source  = field;
      Field<dim>                 predicted(field.shared_lattice());
      std::vector<BoundedValue>  predictions;
      std::vector<unsigned char> left;

      source.exchange(flow.width());
      fill_boundary_points(source, model, condition, flow.velocity(), flow.time());
      for_each(field.owned(), [&](const GridIndex<dim> &index) {
        const auto trace = flow.trace(field.lattice().point(index), -dt);
        predictions.push_back(interpolate_with_bounds(source, trace.foot));
        left.push_back(trace.left_domain);
        predicted(index) = predictions.back().value;
      });

      predicted.exchange(flow.width());
      fill_boundary_points(predicted, model, condition, flow.velocity(), flow.time() + dt);
      Field<dim>  corrected = predicted;
      std::size_t k         = 0;
      for_each(field.owned(), [&](const GridIndex<dim> &index) {
        const auto &bounds = predictions[k];
        const auto  trace  = flow.trace(field.lattice().point(index), dt);
        if (!left[k] && !trace.left_domain)
          {
            const double returned = interpolate(predicted, trace.foot);
            const double value    = bounds.value + (source(index) - returned) / 2;
            corrected(index) = limited ? std::clamp(value, bounds.smallest, bounds.largest) : value;
          }
        ++k;
      });
      return corrected;
    }
  };


  namespace
  {
    const RegisterForDimensions<Advection, MacCormack>
      registered("MacCormack", "Semi-Lagrangian, corrected by a step back: second order in space.");
  }
} // namespace undine
