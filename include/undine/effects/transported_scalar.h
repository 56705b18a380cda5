// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_effects_transported_scalar_h
#define undine_effects_transported_scalar_h

#include <undine/base/options/expression.h>
#include <undine/base/options/options.h>
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// An advected field, prescribed at inflows and where the scene says so, without flux
  /// elsewhere.
  template <int dim>
  class TransportedScalar : public BoundaryCondition<dim>
  {
  public:
    explicit TransportedScalar(const std::string &name_)
      : name(name_)
    {
    }

    void
    add_options(const Options &options)
    {
      options.add("Initial value", initial, "", Allowed::constant_in_time(), "At the start.");
      options.add("Source",
                  source,
                  "1/s",
                  Allowed::anything(),
                  "Rate at which the value grows, besides transport.");
      options.add("Inflow value",
                  inflow,
                  "",
                  Allowed::anything(),
                  "Of fluid that comes in through inflows and openings; the initial value if not "
                  "given.");
      if (!options.given("Inflow value"))
        inflow = initial;
      options.add("Neglected variation",
                  neglected,
                  "1",
                  Allowed::between(0, 0.01),
                  "Where within reach of the flow values differ by no more than this share of the "
                  "field's range, nothing is advected: what holds no smoke costs nothing. 0: "
                  "everything is advected.");
      options.add("Diffusivity", diffusivity, "m^2/s", Allowed::not_negative(), "Its own.");
      options.add("Dirichlet boundaries",
                  dirichlet_boundaries,
                  "",
                  Allowed::anything(),
                  "Names of boundaries on which the value is prescribed, such as heated walls.");
      options.add("Dirichlet value",
                  prescribed,
                  "",
                  Allowed::anything(),
                  "On the boundaries where it is prescribed.");
      if (!options.is_reference() && options.given("Dirichlet value") &&
          dirichlet_boundaries.empty())
        throw options.error("Dirichlet value",
                            "is given, but no boundary to hold it",
                            "Name boundaries of the fluid in 'Dirichlet boundaries'.");
    }

    /// Is it one of those on which the scene prescribes the value?
    bool
    is_listed(const Boundary<dim> &boundary) const
    {
      return std::find(dirichlet_boundaries.begin(), dirichlet_boundaries.end(), boundary.name) !=
             dirichlet_boundaries.end();
    }

    bool
    is_dirichlet(const Boundary<dim> &boundary) const override
    {
      return boundary.kind == BoundaryKind::inflow || is_listed(boundary);
    }

    double
    dirichlet_value(const Boundary<dim> &boundary,
                    const unsigned int,
                    const dealii::Point<dim> &place,
                    const double              time) const override
    {
      return is_listed(boundary) ? prescribed.value(place, time) : inflow.value(place, time);
    }

    double
    entering_value(const dealii::Point<dim> &place, const double time) const override
    {
      return inflow.value(place, time);
    }

    bool
    obeys_maximum_principle() const override
    {
      return true;
    }

    double
    neglected_variation() const override
    {
      return neglected;
    }

    /// What the source at `time` adds in `length` [s].
    void
    add_source(Field<dim> &values, const double time, const double length) const
    {
      const auto *divided = values.divided();
      for (const auto &[index, rate] : sources(values, time))
        if (!divided || divided->kind(index) == SubLattice<dim>::Kind::whole)
          values(index) += length * rate;
      for (std::size_t k = 0; k < values.parts().size(); ++k)
        if (divided->owns(k))
          values.parts()[k] += length * source.value(divided->all()[k].place, time);
    }

    /// [bytes]
    std::size_t
    memory_of_sources() const
    {
      return known_sources ? known_sources->capacity() * sizeof(known_sources->front()) : 0;
    }

    /// Does anything change it besides the flow?
    bool
    changes() const
    {
      return diffusivity > 0 || !source.is_zero();
    }

    std::string              name;
    Expression<dim>          initial, source, inflow, prescribed;
    std::vector<std::string> dirichlet_boundaries;
    double                   diffusivity = 0;
    double                   neglected   = 1e-6;

    /// Matrix of the last step size: a cache.
    mutable std::unique_ptr<ImplicitDiffusion<dim>> equation;

  private:
    using Sources = std::vector<std::pair<GridIndex<dim>, double>>;

    /// The source in the middle of owned cells, where it is not zero. Found once if the time does
    /// not matter.
    const Sources &
    sources(const Field<dim> &values, const double time) const
    {
      if (!known_sources || source.names_time())
        {
          known_sources.emplace();
          for_each(values.owned(), [&](const GridIndex<dim> &index) {
            const double rate = source.value(values.lattice().point(index), time);
            if (rate != 0)
              known_sources->emplace_back(index, rate);
          });
        }
      return *known_sources;
    }

    mutable std::optional<Sources> known_sources; ///< a cache
  };
} // namespace undine

#endif
