// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/grid/interpolation.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace undine
{
  /// Semi-Lagrangian step forward, one back, and half of what that round trip changed subtracted:
  ///
  ///     s1 = A(s^n),  s0 = A^-1(s1),  s^{n+1} = s1 + (s^n - s0) / 2                       (F10)
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

    std::vector<Field<dim>>
    advect(const CharacteristicTracer<dim> &tracer,
           std::vector<Field<dim>>          fields,
           const GoingOn<dim>              &going_on,
           const BoundaryCondition<dim>    &condition) const override
    {
      const auto  sources = completed(tracer, std::move(fields), going_on, condition);
      Predictions predictions(sources.size());
      auto        corrected = advect_along_paths(tracer,
                                          sources,
                                          going_on,
                                          condition,
                                          tracer.width(),
                                          [&](const auto &trace, const auto &index) {
                                            return [&](const std::size_t k) {
                                              const auto found = interpolate_with_bounds(
                                                sources[k], trace.foot.point);
                                              if (!trace.left_domain)
                                                predictions[k].push_back({index, found});
                                              return found.value;
                                            };
                                          });

      auto predicted = corrected;
      for (std::size_t k = 0; k < predicted.size(); ++k)
        {
          const double end = tracer.time() + tracer.dt();
          predicted[k].exchange(tracer.width());
          fill_boundary_points(predicted[k],
                               tracer.model().boundaries(),
                               condition,
                               tracer.velocity(),
                               going_on.times.empty() ? end : going_on.times[k],
                               {end});
        }
      const bool limited = condition.obeys_maximum_principle();
      for (std::size_t i = 0; i < predictions.front().size(); ++i)
        {
          const auto &index = predictions.front()[i].index;
          const auto  trace = tracer.trace(sources.front().lattice().point(index), tracer.dt());
          if (trace.left_domain || trace.near_body)
            continue;
          for (std::size_t k = 0; k < sources.size(); ++k)
            {
              const auto  &found    = predictions[k][i].found;
              const double returned = interpolate(predicted[k], trace.foot.point);
              const double value    = found.value + (sources[k](index) - returned) / 2;
              corrected[k](index) =
                limited ? std::clamp(value, found.smallest, found.largest) : value;
            }
        }
      return corrected;
    }

  private:
    struct Prediction
    {
      GridIndex<dim> index;
      BoundedValue   found;
    };

    /// Of each field where the step back may correct it: at the same points.
    using Predictions = std::vector<std::vector<Prediction>>;
  };


  namespace
  {
    const RegisterForDimensions<Advection, MacCormack>
      registered_maccormack("MacCormack",
                            "Semi-Lagrangian, corrected by a step back: second order in space.");
  }
} // namespace undine
