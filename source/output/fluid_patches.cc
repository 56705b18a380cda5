// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fluid_patches.h>
#include <undine/output/fluid_sampler.h>

namespace undine
{
  namespace
  {
    /// The numbers of one corner, in the order of the components.
    template <int dim>
    std::vector<float>
    values_at(const FluidSampler<dim> &sampler, const GridIndex<dim> &corner)
    {
      std::vector<float> values;
      const auto         place    = sampler.corner_position(corner);
      const auto         velocity = sampler.velocity(place);
      for (unsigned int axis = 0; axis < dim; ++axis)
        values.push_back(velocity[axis]);
      values.push_back(sampler.pressure(place));
      values.push_back(sampler.vorticity_magnitude(corner));
      for (const double scalar : sampler.scalars(place))
        values.push_back(scalar);
      return values;
    }


    /// The corners of this rank's cells. Neighbouring cells share them, so each is sampled once.
    template <int dim>
    IndexBox<dim>
    corners_of(const IndexBox<dim> &cells)
    {
      IndexBox<dim> corners = cells;
      if (!cells.empty())
        for (unsigned int axis = 0; axis < dim; ++axis)
          ++corners.upper[axis];
      return corners;
    }


    template <int dim>
    GridIndex<dim>
    corner_of(GridIndex<dim> cell, const unsigned int vertex)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        cell[axis] += (vertex >> axis) & 1;
      return cell;
    }


    template <int dim>
    dealii::DataOutBase::Patch<dim>
    patch_of(const GridIndex<dim>                  &cell,
             const FluidSampler<dim>               &sampler,
             const IndexBox<dim>                   &corners,
             const std::vector<std::vector<float>> &values)
    {
      constexpr unsigned int          n_vertices = dealii::GeometryInfo<dim>::vertices_per_cell;
      dealii::DataOutBase::Patch<dim> patch;
      patch.reference_cell = dealii::ReferenceCells::get_hypercube<dim>();
      patch.data.reinit(values.front().size(), n_vertices);
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          const auto corner   = corner_of<dim>(cell, v);
          const auto position = corners.position(corner);
          patch.vertices[v]   = sampler.corner_position(corner);
          for (unsigned int c = 0; c < values[position].size(); ++c)
            patch.data(c, v) = values[position][c];
        }
      return patch;
    }
  } // namespace


  template <int dim>
  Patches<dim>
  fluid_patches(const FluidModel<dim> &model, const FluidState<dim> &state, const double time)
  {
    const FluidSampler<dim> sampler(model, state, time);
    Patches<dim>            result;
    result.name       = "fluid";
    result.continuity = Patches<dim>::Continuity::continuous;
    result.add_vector("velocity", "m/s");
    result.add_scalar("pressure", "Pa");
    result.add_scalar("vorticity_magnitude", "1/s");
    for (const auto &name : sampler.scalar_names())
      result.add_scalar(name, "");

    const auto                      cells   = model.grid().cells()->owned();
    const auto                      corners = corners_of<dim>(cells);
    std::vector<std::vector<float>> values;
    values.reserve(corners.size());
    for_each(corners,
             [&](const auto &corner) { values.push_back(values_at<dim>(sampler, corner)); });
    result.patches.reserve(cells.size());
    for_each(cells, [&](const auto &cell) {
      result.patches.push_back(patch_of<dim>(cell, sampler, corners, values));
      result.patches.back().patch_index = result.patches.size() - 1;
    });
    return result;
  }


  template Patches<2>
  fluid_patches(const FluidModel<2> &, const FluidState<2> &, double);
  template Patches<3>
  fluid_patches(const FluidModel<3> &, const FluidState<3> &, double);
} // namespace undine
