// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/place_in_domain.h>
#include <undine/output/fields/fluid_sampler.h>
#include <undine/output/probes/probe.h>

namespace undine
{
  /// A fixed place in the fluid: velocity [m/s], reduced pressure [Pa] and scalars, interpolated.
  template <int dim>
  class FluidPoint : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Point", point, "m", Allowed::anything(), "Where the fluid is measured.");
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
      const auto             &grid = models.fluid->grid();
      const FluidSampler<dim> sampler(models, state);
      std::vector<double>     values(dim + 1 + sampler.scalar_names().size());
      if (grid.cells()->owned().contains(grid.cell_at(point)))
        values = measure(sampler);
      dealii::Utilities::MPI::sum(values, grid.communicator(), values);

      Columns result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " velocity " + char('x' + axis), "m/s", values[axis]});
      result.push_back({name + " pressure", "Pa", values[dim]});
      for (unsigned int s = 0; s < sampler.scalar_names().size(); ++s)
        result.push_back({name + " " + sampler.scalar_names()[s], "scalar", values[dim + 1 + s]});
      return result;
    }

  private:
    std::vector<double>
    measure(const FluidSampler<dim> &sampler) const
    {
      std::vector<double> values;
      const auto          velocity = sampler.velocity(point);
      for (unsigned int axis = 0; axis < dim; ++axis)
        values.push_back(velocity[axis]);
      values.push_back(sampler.pressure(point));
      for (const double scalar : sampler.scalars(point))
        values.push_back(scalar);
      return values;
    }

    std::string        name;
    dealii::Point<dim> point;
  };


  namespace
  {
    const RegisterForDimensions<Probe, FluidPoint>
      fluid_point("fluid point",
                  "velocity, reduced pressure p - rho g.x and scalars at a fixed place");
  }
} // namespace undine
