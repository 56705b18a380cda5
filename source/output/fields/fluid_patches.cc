// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/fluid_patches.h>
#include <undine/output/fields/fluid_sampler.h>

namespace undine
{
  namespace
  {
    /// Cells along the edge of a patch, where as many are left. Patches share no points: larger
    /// ones repeat fewer (in 3D two numbers a cell instead of eight).
    constexpr int cells_of_patch = 4;


    /// From the lower vertex of a cube of `length` cells a direction to another one.
    template <int dim>
    GridIndex<dim>
    moved_to_vertex(GridIndex<dim> index, const unsigned int vertex, const int length)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        index[axis] += ((vertex >> axis) & 1) * length;
      return index;
    }


    /// The vertex opposite to the lower one.
    template <int dim>
    constexpr unsigned int last_vertex = (1u << dim) - 1;


    /// The numbers in the corners of this rank's cells, each sampled once.
    template <int dim>
    class CornerValues
    {
    public:
      CornerValues(const FluidSampler<dim> &sampler, const IndexBox<dim> &cells)
        : sampler(sampler)
        , corners(cells)
        , n_sampled(dim + 2 + sampler.scalar_names().size())
        , n_components(n_sampled + (sampler.divided_cells() ? 2 : 0))
      {
        if (cells.empty())
          return;
        for (unsigned int axis = 0; axis < dim; ++axis)
          ++corners.upper[axis];
        values.reserve(corners.size() * n_sampled);
        for_each(corners, [&](const auto &corner) { sample(corner); });
      }

      /// The cube of `n` cells a direction that begins at cell `first`; no body in it.
      dealii::DataOutBase::Patch<dim>
      patch(const GridIndex<dim> &first, const int n) const
      {
        dealii::DataOutBase::Patch<dim> result;
        result.reference_cell       = dealii::ReferenceCells::get_hypercube<dim>();
        result.n_subdivisions       = n;
        result.points_are_available = true; // a graded patch does not divide evenly
        for (const unsigned int v : dealii::GeometryInfo<dim>::vertex_indices())
          result.vertices[v] = sampler.corner_position(moved_to_vertex(first, v, n));

        const IndexBox<dim> points{first, moved_to_vertex(first, last_vertex<dim>, n + 1)};
        result.data.reinit(n_components + dim, points.size());
        unsigned int point = 0;
        for_each(points, [&](const auto &corner) {
          const float *source = values.data() + corners.position(corner) * n_sampled;
          for (unsigned int c = 0; c < n_sampled; ++c)
            result.data(c, point) = source[c];
          const auto place = sampler.corner_position(corner);
          for (unsigned int axis = 0; axis < dim; ++axis)
            result.data(n_components + axis, point) = place[axis];
          ++point;
        });
        if (n_components > n_sampled)
          mark(result, 0, 1);
        return result;
      }

      /// A cell as component `number` of it, whose centroid is given, has it.
      dealii::DataOutBase::Patch<dim>
      patch(const GridIndex<dim>     &cell,
            const int                 number,
            const double              fraction,
            const dealii::Point<dim> &centroid) const
      {
        auto       result   = patch(cell, 1);
        const auto velocity = sampler.velocity(centroid);
        const auto pressure = sampler.pressure(centroid);
        const auto scalars  = sampler.scalars(centroid);
        for (unsigned int point = 0; point < result.data.n_cols(); ++point)
          if (!sampler.is_clear(centroid, result.vertices[point]))
            set(result, point, velocity, pressure, scalars);
        mark(result, number, fraction);
        return result;
      }

      /// A cell in a body.
      dealii::DataOutBase::Patch<dim>
      body_patch(const GridIndex<dim> &cell) const
      {
        auto                      result = patch(cell, 1);
        const std::vector<double> nothing(sampler.scalar_names().size());
        for (unsigned int point = 0; point < result.data.n_cols(); ++point)
          set(result, point, sampler.surface_velocity(result.vertices[point]), 0, nothing);
        mark(result, -1, 0);
        return result;
      }

    private:
      /// True if there is no fluid in any cell around a corner.
      bool
      in_bodies(const GridIndex<dim> &corner) const
      {
        using Kind          = typename SubLattice<dim>::Kind;
        const auto *divided = sampler.divided_cells();
        bool        result  = divided != nullptr;
        for (unsigned int v = 0; result && v <= last_vertex<dim>; ++v)
          {
            const auto cell = moved_to_vertex(corner, v, -1);
            const auto kind = divided->kind(cell);
            result          = kind == Kind::closed ||
                     (kind == Kind::divided && divided->first(cell) == divided->last(cell));
          }
        return result;
      }

      void
      set(dealii::DataOutBase::Patch<dim> &patch,
          const unsigned int               point,
          const dealii::Tensor<1, dim>    &velocity,
          const double                     pressure,
          const std::vector<double>       &scalars) const
      {
        for (unsigned int axis = 0; axis < dim; ++axis)
          patch.data(axis, point) = velocity[axis];
        patch.data(dim, point) = pressure;
        for (unsigned int s = 0; s < scalars.size(); ++s)
          patch.data(dim + 2 + s, point) = scalars[s];
      }

      void
      mark(dealii::DataOutBase::Patch<dim> &patch, const int component, const double fraction) const
      {
        for (unsigned int point = 0; point < patch.data.n_cols(); ++point)
          {
            patch.data(n_sampled, point)     = component;
            patch.data(n_sampled + 1, point) = fraction;
          }
      }

      void
      sample(const GridIndex<dim> &corner)
      {
        if (in_bodies(corner)) // body_patch() knows what is there
          {
            values.insert(values.end(), n_sampled, 0.f);
            return;
          }
        const auto place    = sampler.corner_position(corner);
        const auto velocity = sampler.velocity(place);
        for (unsigned int axis = 0; axis < dim; ++axis)
          values.push_back(velocity[axis]);
        values.push_back(sampler.pressure(place));
        values.push_back(sampler.vorticity_magnitude(corner));
        for (const double scalar : sampler.scalars(place))
          values.push_back(scalar);
      }

      const FluidSampler<dim> &sampler;
      IndexBox<dim>            corners;
      unsigned int             n_sampled;    ///< numbers in a corner
      unsigned int             n_components; ///< and those that belong to cells
      std::vector<float>       values;       ///< [corner * n_sampled + component]
    };


    /// True if the fluid fills all cells of the box.
    template <int dim>
    bool
    is_whole(const IndexBox<dim> &cells, const SubLattice<dim> *divided)
    {
      bool result = true;
      if (divided)
        for_each(cells, [&](const GridIndex<dim> &cell) {
          result = result && divided->kind(cell) == SubLattice<dim>::Kind::whole;
        });
      return result;
    }


    /// Call `action(first, n)` for cubes of n cells a direction that fill the box; n is 1 where
    /// there are bodies.
    template <int dim, class Action>
    void
    for_each_cube(const IndexBox<dim> &cells, const SubLattice<dim> *divided, const Action &action)
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
        const auto inside = cube.intersection(cells);
        if (inside == cube && is_whole(inside, divided))
          action(cube.lower, cells_of_patch);
        else
          for_each(inside, [&](const auto &cell) { action(cell, 1); });
      });
    }


    /// The patches of a cell that bodies divide or fill.
    template <int dim>
    std::vector<dealii::DataOutBase::Patch<dim>>
    divided_patches(const CornerValues<dim> &values,
                    const SubLattice<dim>   &divided,
                    const GridIndex<dim>    &cell,
                    const double             volume)
    {
      std::vector<dealii::DataOutBase::Patch<dim>> result;
      const int                                    first = divided.first(cell);
      for (int k = first; k < divided.last(cell); ++k)
        {
          const auto &part = divided.all()[k];
          result.push_back(values.patch(cell, k - first, part.measure / volume, part.place));
        }
      if (result.empty())
        result.push_back(values.body_patch(cell));
      return result;
    }
  } // namespace


  template <int dim>
  Patches<dim>
  fluid_patches(const Models<dim> &models, const State<dim> &state)
  {
    const auto             &grid = models.fluid->grid();
    const FluidSampler<dim> sampler(models, state);
    const auto             *divided = sampler.divided_cells();
    Patches<dim>            result;
    result.name = "fluid";
    result.continuity =
      divided ? Patches<dim>::Continuity::discontinuous : Patches<dim>::Continuity::continuous;
    result.add_vector("velocity", "m/s");
    result.add_scalar("pressure", "Pa");
    result.add_scalar("vorticity_magnitude", "1/s");
    for (const auto &name : sampler.scalar_names())
      result.add_scalar(name, "");
    if (divided)
      {
        result.add_scalar("component", "1");
        result.add_scalar("fluid_fraction", "1");
      }

    const auto              cells = grid.cells()->owned();
    const CornerValues<dim> values(sampler, cells);
    for_each_cube(cells, divided, [&](const GridIndex<dim> &first, const int n) {
      if (is_whole<dim>({first, moved_to_vertex(first, last_vertex<dim>, n)}, divided))
        result.patches.push_back(values.patch(first, n));
      else
        for (auto &patch : divided_patches(values, *divided, first, grid.cell_volume(first)))
          result.patches.push_back(std::move(patch));
    });
    for (unsigned int k = 0; k < result.patches.size(); ++k)
      result.patches[k].patch_index = k;
    return result;
  }


  template Patches<2>
  fluid_patches(const Models<2> &, const State<2> &);
  template Patches<3>
  fluid_patches(const Models<3> &, const State<3> &);
} // namespace undine
