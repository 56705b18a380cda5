// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>
#include <undine/particle_model/plain_vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace undine
{
  /// The coordinate of the surface of a fluid of particles around a place, along the last axis [m]:
  /// the mean over columns a spacing wide of where the highest particle's surface is, by
  /// SurfaceOffset. Without fluid there, where the domain begins.
  template <int dim>
  class SurfaceHeight : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Point",
                      point,
                      "m",
                      Allowed::anything(),
                      "Above or below which the height is measured; its last coordinate does not "
                      "matter.");
      options.add("Radius",
                  radius,
                  "m",
                  Allowed::not_negative(),
                  "Particles nearer to the vertical through the point count; at least those within "
                  "two spacings.");
      options.add("Gap",
                  gap,
                  "spacings",
                  Allowed::between(1, 10),
                  "Particles that are farther apart than this do not belong together; only the "
                  "largest part counts.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.particles || !models.particles->has_fluid())
        throw options.error("Kind",
                            "the scene has no fluid of particles",
                            "Try: remove the probe, or 'Scheme = particle' and a section 'Fluid'.");
      const auto &box = models.particles->domain();
      for (unsigned int axis = 0; axis + 1 < dim; ++axis)
        if (point[axis] < box.lower[axis] || point[axis] > box.upper[axis])
          throw options.error("Point",
                              "is not above the domain",
                              "Allowed: from (" + write_value(box.lower) + ") to (" +
                                write_value(box.upper) + ") m.");
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      const auto                                      &box     = models.particles->domain();
      const double                                     spacing = box.spacing;
      const double                                     within  = std::max(radius, 2 * spacing);
      const SurfaceOffset<dim>                         offset(*models.particles, state.particles);
      std::map<std::array<long, dim - 1>, std::size_t> highest; // particle, by column
      for (const auto k : main_part_of_fluid(box, state.particles, gap * spacing))
        {
          const auto               &x      = state.particles.positions[k];
          const auto                way    = box.way(point_of(x), point);
          double                    square = 0;
          std::array<long, dim - 1> column{};
          for (unsigned int axis = 0; axis + 1 < dim; ++axis)
            {
              square += way[axis] * way[axis];
              column[axis] = std::lround(std::floor((x[axis] - box.lower[axis]) / spacing));
            }
          if (square > within * within)
            continue;
          const auto found = highest.emplace(column, k).first;
          if (x[dim - 1] > state.particles.positions[found->second][dim - 1])
            found->second = k;
        }
      double sum = 0;
      for (const auto &[column, k] : highest)
        sum += state.particles.positions[k][dim - 1] + offset(k);
      return {{name + " height", "m", highest.empty() ? box.lower[dim - 1] : sum / highest.size()}};
    }

  private:
    std::string        name;
    dealii::Point<dim> point;
    double             radius = 0;   ///< [m]
    double             gap    = 1.5; ///< [spacings]
  };


  namespace
  {
    const RegisterForDimensions<Probe, SurfaceHeight>
      surface_height("surface height", "where the surface of a fluid of particles is at a place");
  }
} // namespace undine
