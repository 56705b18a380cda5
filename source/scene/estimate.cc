// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/scene/cost_figures.h>
#include <undine/scene/estimate.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace undine
{
  namespace
  {
    void
    add_grid(Estimate &result, const SceneSize &size, const unsigned int n_ranks)
    {
      const auto &grid    = size.grid;
      const auto &figures = cost_figures::grid[size.dimension - 2];
      result.memory += grid.cells * (figures.bytes + grid.advected * figures.bytes_advected +
                                     grid.implicit * figures.bytes_implicit) +
                       grid.cut_cells * figures.bytes_cut +
                       n_ranks * grid.facets * figures.bytes_facet;
      result.seconds +=
        size.stages *
        (grid.cells * (figures.projection + (grid.moves ? figures.moving : 0) +
                       grid.advected * figures.advected + grid.implicit * figures.implicit) +
         grid.cut_cells *
           (grid.advected * figures.advected_cut + grid.implicit * cost_figures::implicit_cut +
            (size.is_coupled ? figures.cut_coupled : 0)) +
         (size.has_contact ? grid.facets * figures.contact : 0));
      const double values = size.dimension + 1. + grid.scalars;
      result.picture += grid.cells * values * cost_figures::picture_value;
      // Velocity, its acceleration and change are kept, pressure, scalars and their rates.
      result.checkpoint +=
        sizeof(double) * grid.cells * (3. * size.dimension + 1 + 2. * grid.scalars);
    }


    void
    add_solid(Estimate &result, const SceneSize &size)
    {
      const auto &solid   = size.solid;
      const auto &figures = cost_figures::solid;
      result.memory += solid.entries * figures.bytes_entry;
      result.seconds += size.stages * solid.entries * figures.entry;
      if (solid.is_direct)
        {
          result.memory += figures.bytes_factor * std::sqrt(solid.work * solid.unknowns);
          result.seconds += size.stages * solid.work * figures.factor;
        }
      if (size.is_coupled)
        {
          result.memory += solid.entries * figures.bytes_coupled;
          result.seconds += size.stages * (size.grid.cells * figures.coupled_cell +
                                           solid.entries * figures.coupled_entry);
        }
      result.picture += solid.unknowns * cost_figures::picture_unknown;
      result.checkpoint += 3 * sizeof(double) * solid.unknowns;
    }


    void
    add_particles(Estimate &result, const SceneSize &size)
    {
      const auto  &particles = size.particles;
      const auto  &figures   = cost_figures::particles[size.dimension - 2];
      const double n         = particles.all();
      result.memory += n * figures.bytes_state;
      if (!particles.on_device)
        result.memory +=
          (particles.is_double ? cost_figures::double_precision : 1) *
            (n * (figures.bytes + (n > cost_figures::multigrid_from ? figures.multigrid : 0)) +
             particles.solid * figures.bytes_solid) +
          particles.grid_cells * figures.bytes_cell;
      result.seconds += particles.sub_steps * n * figures.sub_step +
                        particles.elastic_steps * particles.solid * figures.elastic;
      result.picture += particles.all() * cost_figures::picture_particle;
      result.checkpoint += sizeof(double) * particles.all() * (2. * size.dimension + 3);
    }
  } // namespace


  Estimate
  estimate(const SceneSize &size, const unsigned int n_ranks)
  {
    Estimate result;
    if (size.has_contact)
      result.uncertainty_of_seconds = Estimate::uncertainty_with_contact;
    result.program =
      cost_figures::program + (size.is_coupled ? cost_figures::program_of_coupling : 0);
    result.memory = n_ranks * result.program;
    if (size.grid.cells > 0)
      add_grid(result, size, n_ranks);
    if (size.solid.elements > 0)
      add_solid(result, size);
    if (size.particles.all() > 0)
      add_particles(result, size);
    result.seconds =
      cost_figures::least_step + result.seconds / std::pow(n_ranks, cost_figures::gain_of_ranks);
    return result;
  }


  std::string
  describe(const SceneSize &size)
  {
    std::vector<std::string> parts;
    if (size.grid.cells > 0)
      parts.push_back(fmt::format("{:.8g} cells", size.grid.cells));
    if (size.grid.cut_cells > 0)
      parts.push_back(fmt::format("about {:.2g} of them cut by surfaces", size.grid.cut_cells));
    if (size.solid.elements > 0)
      parts.push_back(fmt::format(
        "{:.8g} elements with about {:.3g} unknowns", size.solid.elements, size.solid.unknowns));
    if (const auto &particles = size.particles; particles.all() > 0)
      parts.push_back(
        fmt::format("about {:.3g} particles, {:.3g} of them of fluid, in about {:.2g} "
                    "sub-steps a frame",
                    particles.all(),
                    particles.fluid,
                    std::max(particles.sub_steps, particles.elastic_steps)));
    return fmt::format("{}", fmt::join(parts, ", "));
  }
} // namespace undine
