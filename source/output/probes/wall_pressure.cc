// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>
#include <undine/particle_model/plain_vector.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// The pressure of particles on a disc of a wall, averaged [Pa]. The disc moves with an obstacle
  /// that does.
  template <int dim>
  class WallPressure : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Point",
                      point,
                      "m",
                      Allowed::anything(),
                      "Centre of the disc, on a wall; of an obstacle that moves, at the start.");
      options.add("Radius",
                  radius,
                  "m",
                  Allowed::not_negative(),
                  "Of the disc; at least half a spacing in the plane and 0.71 in space, half the "
                  "diagonal of a lattice's square. Of a thin wall or a corner only the side counts "
                  "on which the point is.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.particles)
        throw options.error("Kind",
                            "measures walls of particles, but the scene has none",
                            "Try: 'fluid point', or 'Scheme = particle'.");
      identities = particles_on_disc(*models.particles);
      if (identities.empty())
        throw options.error("Point",
                            "there is no wall at (" + write_value(point) + ")",
                            "Try: a point on a side of the domain or of an obstacle, and a radius "
                            "above the spacing.");
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      return {
        {name + " pressure", "Pa", mean_pressure(*models.particles, state.particles, identities)}};
    }

  private:
    /// Ascending. The first layer of a wall is half a spacing behind its surface: a particle lies
    /// on the side on which the point is if half a spacing before it, in the direction out of the
    /// wall at the point, there is a surface that faces the same way.
    std::vector<int>
    particles_on_disc(const ParticleModel<dim> &model) const
    {
      const auto  &start   = model.initial_state();
      const double spacing = model.domain().spacing;
      const double along   = std::max(radius, spacing * std::sqrt(dim - 1.) / 2);
      const double reach   = (1 + 1e-6) * std::hypot(along, spacing / 2);
      const auto   out     = model.out_of_wall(point, reach);

      std::vector<int> result;
      for (std::size_t k = 0; k < start.tags.size(); ++k)
        if (start.tags[k].kind() == particles::Kind::wall &&
            (start.tags[k].material() == 0 ||
             start.tags[k].material() == particles::moving_material))
          {
            const auto place = point_of(start.positions[k]);
            const auto way   = model.domain().way(place, point);
            if (way.norm() <= reach &&
                model.out_of_wall(place + spacing / 2 * out, spacing / 4) * out > 0.5)
              result.push_back(start.identities[k]);
          }
      std::sort(result.begin(), result.end());
      return result;
    }

    std::string        name;
    dealii::Point<dim> point;
    double             radius = 0; ///< [m]
    std::vector<int>   identities;
  };


  namespace
  {
    const RegisterForDimensions<Probe, WallPressure>
      wall_pressure("wall pressure", "mean pressure of particles on a disc of a wall");
  }
} // namespace undine
