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
      struct Prediction
      {
        GridIndex<dim> index;
        BoundedValue   found;
      };
      std::vector<Prediction> predictions; // where the way back may correct them

      const bool limited = condition.obeys_maximum_principle();
      const auto source  = completed(flow, field, condition);
      auto       corrected =
        carry(flow, source, condition, flow.width(), [&](const auto &trace, const auto &index) {
          const auto found = interpolate_with_bounds(source, trace.foot);
          if (!trace.left_domain)
            predictions.push_back({index, found});
          return found.value;
        });

      auto predicted = corrected;
      predicted.exchange(flow.width());
      fill_boundary_points(
        predicted, flow.model(), condition, flow.velocity(), flow.time() + flow.dt());
      for (const auto &[index, found] : predictions)
        {
          const auto place = field.lattice().point(index);
          const auto trace = flow.trace(place, flow.dt());
          if (trace.left_domain || trace.near_body)
            continue;
          const double returned = interpolate(predicted, trace.foot);
          const double value    = found.value + (source(index) - returned) / 2;
          corrected(index) = limited ? std::clamp(value, found.smallest, found.largest) : value;
        }
      return corrected;
    }
  };


  namespace
  {
    const RegisterForDimensions<Advection, MacCormack>
      registered("MacCormack", "Semi-Lagrangian, corrected by a step back: second order in space.");
  }
} // namespace undine
