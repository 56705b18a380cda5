// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fluid_patches.h>
#include <undine/output/fluid_sampler.h>

namespace undine
{
  namespace
  {
    /// Cells along the edge of a patch, where as many are left. Patches share no points: larger
    /// ones repeat fewer (in 3D two numbers a cell instead of eight).
    constexpr int cells_of_patch = 4;


    /// The numbers in the corners of this rank's cells, each sampled once.
    template <int dim>
    class CornerValues
    {
    public:
      CornerValues(const FluidSampler<dim> &sampler, const IndexBox<dim> &cells)
        : sampler(sampler)
        , corners(cells)
        , n_components(dim + 2 + sampler.scalar_names().size())
      {
        if (cells.empty())
          return;
        for (unsigned int axis = 0; axis < dim; ++axis)
          ++corners.upper[axis];
        values.reserve(corners.size() * n_components);
        for_each(corners, [&](const auto &corner) { sample(corner); });
      }

      /// The cube of `n` cells a direction that begins at cell `first`.
      dealii::DataOutBase::Patch<dim>
      patch(const GridIndex<dim> &first, const int n) const
      {
        dealii::DataOutBase::Patch<dim> result;
        result.reference_cell       = dealii::ReferenceCells::get_hypercube<dim>();
        result.n_subdivisions       = n;
        result.points_are_available = true; // a graded patch does not divide evenly
        for (const unsigned int v : dealii::GeometryInfo<dim>::vertex_indices())
          result.vertices[v] = sampler.corner_position(moved_to_vertex(first, v, n));

        const IndexBox<dim> points{first, moved_to_vertex(first, (1u << dim) - 1, n + 1)};
        result.data.reinit(n_components + dim, points.size());
        unsigned int point = 0;
        for_each(points, [&](const auto &corner) {
          const float *source = values.data() + corners.position(corner) * n_components;
          for (unsigned int c = 0; c < n_components; ++c)
            result.data(c, point) = source[c];
          const auto place = sampler.corner_position(corner);
          for (unsigned int axis = 0; axis < dim; ++axis)
            result.data(n_components + axis, point) = place[axis];
          ++point;
        });
        return result;
      }

    private:
      void
      sample(const GridIndex<dim> &corner)
      {
        const auto place    = sampler.corner_position(corner);
        const auto velocity = sampler.velocity(place);
        for (unsigned int axis = 0; axis < dim; ++axis)
          values.push_back(velocity[axis]);
        values.push_back(sampler.pressure(place));
        values.push_back(sampler.vorticity_magnitude(corner));
        for (const double scalar : sampler.scalars(place))
          values.push_back(scalar);
      }

      static GridIndex<dim>
      moved_to_vertex(GridIndex<dim> index, const unsigned int vertex, const int distance)
      {
        for (unsigned int axis = 0; axis < dim; ++axis)
          index[axis] += ((vertex >> axis) & 1) * distance;
        return index;
      }

      const FluidSampler<dim> &sampler;
      IndexBox<dim>            corners;
      unsigned int             n_components;
      std::vector<float>       values; ///< [corner * n_components + component]
    };


    /// Call `action(first, n)` for cubes of n cells a direction that fill the box.
    template <int dim, class Action>
    void
    for_each_cube(const IndexBox<dim> &cells, const Action &action)
    {
      IndexBox<dim> blocks; // of cells_of_patch cells a direction, the last ones perhaps cut
      for (unsigned int axis = 0; axis < dim; ++axis)
        blocks.upper[axis] =
          (cells.upper[axis] - cells.lower[axis] + cells_of_patch - 1) / cells_of_patch;
      for_each(blocks, [&](const auto &block) {
        IndexBox<dim> cube;
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            cube.lower[axis] = cells.lower[axis] + block[axis] * cells_of_patch;
            cube.upper[axis] = cube.lower[axis] + cells_of_patch;
          }
        if (cube.intersection(cells) == cube)
          action(cube.lower, cells_of_patch);
        else
          for_each(cube.intersection(cells), [&](const auto &cell) { action(cell, 1); });
      });
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

    const auto              cells = model.grid().cells()->owned();
    const CornerValues<dim> values(sampler, cells);
    for_each_cube(cells, [&](const GridIndex<dim> &first, const int n) {
      result.patches.push_back(values.patch(first, n));
      result.patches.back().patch_index = result.patches.size() - 1;
    });
    return result;
  }


  template Patches<2>
  fluid_patches(const FluidModel<2> &, const FluidState<2> &, double);
  template Patches<3>
  fluid_patches(const FluidModel<3> &, const FluidState<3> &, double);
} // namespace undine
