// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/probe.h>

#include <cmath>

namespace undine
{
  /// The fluid of particles in a region: its mass [kg, in the plane kg/m], momentum and kinetic
  /// energy.
  template <int dim>
  class FluidRegion : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Region",
                      region,
                      "",
                      Allowed::constant_in_time(),
                      "Fluid counts where this is positive, in particles' centres.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.particles || !models.particles->has_fluid())
        throw options.error("Kind",
                            "the scene has no fluid of particles",
                            "Try: remove the probe, or 'Scheme = particle' and a section 'Fluid'.");
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      const auto  &particles = state.particles;
      const double mass =
        models.particles->setup().fluid_density * std::pow(models.particles->domain().spacing, dim);
      double                 count = 0, energy = 0;
      dealii::Tensor<1, dim> momentum;
      for (std::size_t k = 0; k < particles.tags.size(); ++k)
        {
          dealii::Point<dim> place;
          for (unsigned int axis = 0; axis < dim; ++axis)
            place[axis] = particles.positions[k][axis];
          if (particles.tags[k].kind() != particles::Kind::fluid || !(region.value(place, 0.) > 0))
            continue;
          ++count;
          for (unsigned int axis = 0; axis < dim; ++axis)
            {
              const double v = particles.velocities[k][axis];
              momentum[axis] += mass * v;
              energy += mass * v * v / 2;
            }
        }
      Columns result{{name + " mass", "kg", mass * count}};
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " momentum " + char('x' + axis), "kg m/s", momentum[axis]});
      result.push_back({name + " kinetic energy", "J", energy});
      return result;
    }

  private:
    std::string     name;
    Expression<dim> region;
  };


  namespace
  {
    const RegisterForDimensions<Probe, FluidRegion>
      fluid_region("fluid region", "mass, momentum and energy of the particles in a region");
  }
} // namespace undine
