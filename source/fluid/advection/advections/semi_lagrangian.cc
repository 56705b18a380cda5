// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/grid/interpolation.h>

#include <utility>

namespace undine
{
  /// s^{n+1}(x) = s^n(foot of x), with multilinear interpolation (F8) (Stam 1999). Never exceeds
  /// the bounds of s^n; smears by about dx^2 / (8 h) of diffusivity.
  template <int dim>
  class SemiLagrangian : public Advection<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "semi-Lagrangian, multilinear";
    }

    std::vector<Field<dim>>
    advect(const CharacteristicTracer<dim> &tracer,
           std::vector<Field<dim>>          fields,
           const GoingOn<dim>              &going_on,
           const BoundaryCondition<dim>    &condition) const override
    {
      const auto sources = completed(tracer, std::move(fields), going_on, condition);
      return advect_along_paths(tracer,
                                sources,
                                going_on,
                                condition,
                                tracer.reach(0),
                                [&](const auto &trace, const GridIndex<dim> &) {
                                  return [&](const std::size_t k) {
                                    return interpolate(sources[k], trace.foot.point);
                                  };
                                });
    }
  };


  namespace
  {
    const RegisterForDimensions<Advection, SemiLagrangian> registered_semi_lagrangian(
      "semi-Lagrangian",
      "Follow the flow back for one step and interpolate there: robust, smears most.");
  }
} // namespace undine
