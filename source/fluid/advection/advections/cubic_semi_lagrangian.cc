// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/grid/interpolation.h>

#include <utility>

namespace undine
{
  /// s^{n+1}(x) = s^n(foot of x), with cubic interpolation (F9). Fields with a maximum principle
  /// are limited to the bounds of the samples around the foot (quasi-monotone, Bermejo & Staniforth
  /// 1992). Third order in space, at limited extrema second.
  template <int dim>
  class CubicSemiLagrangian : public Advection<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "semi-Lagrangian, cubic";
    }

    std::vector<Field<dim>>
    advect(const CharacteristicTracer<dim> &tracer,
           std::vector<Field<dim>>          fields,
           const GoingOn<dim>              &going_on,
           const BoundaryCondition<dim>    &condition) const override
    {
      const auto overshoot =
        condition.obeys_maximum_principle() ? Overshoot::clipped : Overshoot::kept;
      const auto sources = completed(tracer, std::move(fields), going_on, condition);
      return advect_along_paths(
        tracer,
        sources,
        going_on,
        condition,
        tracer.reach(1),
        [&](const auto &trace, const GridIndex<dim> &) {
          return [&, at = CubicInterpolation<dim>(sources.front(), trace.foot.point)](
                   const std::size_t k) { return at.value(sources[k], overshoot); };
        });
    }
  };


  namespace
  {
    const RegisterForDimensions<Advection, CubicSemiLagrangian> registered_cubic_semi_lagrangian(
      "cubic",
      "Follow the flow back for one step and interpolate there with cubics: "
      "most accurate.");
  }
} // namespace undine
