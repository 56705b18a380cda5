// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/measure_region.h>
#include <undine/fluid/grid/place_in_domain.h>
#include <undine/output/probes/probe.h>

namespace undine
{
  /// The fluid around a place up to bodies, obstacles and the sides of the domain: its volume
  /// [m^dim], and what flows in through the domain's boundaries [m^dim/s].
  template <int dim>
  class ChamberProbe : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Point",
                      point,
                      "m",
                      Allowed::anything(),
                      "A place that always lies in the chamber, not in a body.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.fluid)
        throw options.error("Kind",
                            "the scene has no fluid on a grid",
                            "Try: remove the probe; particles have 'wall pressure' and 'front'.");
      check_in_domain(options, "Point", point, models.fluid->grid());
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      const auto unit = "m^" + std::to_string(dim);
      try
        {
          const auto region = measure_region(models, state, point);
          return {{name + " volume", unit, region.volume},
                  {name + " inflow", unit + "/s", region.inflow}};
        }
      catch (const SolveError &error)
        {
          throw SolveError("Probes/" + name + ", 'Point': " + error.what());
        }
    }

  private:
    std::string        name;
    dealii::Point<dim> point;
  };


  namespace
  {
    const RegisterForDimensions<Probe, ChamberProbe>
      chamber("chamber", "volume of the fluid around a place, and what flows into it");
  }
} // namespace undine
