// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/output/fields/fluid_sampler.h>
#include <undine/output/fields/surface_patches.h>

namespace undine
{
  namespace
  {
    /// A segment or triangle with room for `n_components` numbers in its nodes.
    template <int dim>
    dealii::DataOutBase::Patch<dim - 1, dim>
    empty_patch(const std::array<dealii::Point<dim>, dim> &nodes, const unsigned int n_components)
    {
      dealii::DataOutBase::Patch<dim - 1, dim> patch;
      patch.reference_cell = dealii::ReferenceCells::get_simplex<dim - 1>();
      for (unsigned int node = 0; node < dim; ++node)
        patch.vertices[node] = nodes[node];
      patch.data.reinit(n_components, dim);
      return patch;
    }


    template <int dim>
    void
    add_patch(Patches<dim - 1, dim> &part, const dealii::DataOutBase::Patch<dim - 1, dim> &patch)
    {
      part.patches.push_back(patch);
      part.patches.back().patch_index = part.patches.size() - 1;
    }


    /// Mean over a fragment of what is given in the nodes.
    template <int dim>
    dealii::Tensor<1, dim>
    mean(const typename CutCells<dim>::Fragment    &fragment,
         const typename Surface<dim>::Facet        &facet,
         const std::vector<dealii::Tensor<1, dim>> &values)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int node = 0; node < dim; ++node)
        result += fragment.mean[node] * values[facet[node]];
      return result;
    }


    /// Split a fragment, whose corners run around it, into simplices with the same numbers.
    template <int dim>
    void
    add_fragment(Patches<dim - 1, dim>     &part,
                 const CutCells<dim>       &cells,
                 const int                  fragment,
                 const std::vector<double> &numbers)
    {
      const auto *corners   = cells.corners.points.data() + cells.corners.first[fragment];
      const int   n_corners = cells.corners.first[fragment + 1] - cells.corners.first[fragment];
      for (int last = dim - 1; last < n_corners; ++last)
        {
          std::array<dealii::Point<dim>, dim> nodes;
          nodes[0] = corners[0];
          for (unsigned int node = 1; node < dim; ++node)
            nodes[node] = corners[last + node + 1 - dim];
          auto patch = empty_patch<dim>(nodes, numbers.size());
          for (unsigned int component = 0; component < numbers.size(); ++component)
            for (unsigned int node = 0; node < dim; ++node)
              patch.data(component, node) = numbers[component];
          add_patch<dim>(part, patch);
        }
    }
  } // namespace


  template <int dim>
  Patches<dim - 1, dim>
  obstacle_patches(const Models<dim> &models, const State<dim> &state)
  {
    Patches<dim - 1, dim> result;
    result.name = "obstacles";
    result.add_vector("velocity", "m/s");
    result.add_scalar("obstacle", "1");
    const auto &immersed   = *models.surface;
    const auto &surface    = immersed.surface();
    const auto  velocities = surface_velocities(models, state);
    if (dealii::Utilities::MPI::this_mpi_process(models.fluid->grid().communicator()) != 0)
      return result;
    const unsigned int n_bodies =
      surface.body_names().size() - immersed.obstacles().surface().body_names().size();
    for (unsigned int f = 0; f < surface.facets().size(); ++f)
      if (surface.body(f) >= n_bodies)
        {
          const auto                         &facet = surface.facets()[f];
          std::array<dealii::Point<dim>, dim> nodes;
          for (unsigned int node = 0; node < dim; ++node)
            nodes[node] = state.surface_positions[facet[node]];
          auto patch = empty_patch<dim>(nodes, dim + 1);
          for (unsigned int node = 0; node < dim; ++node)
            {
              for (unsigned int axis = 0; axis < dim; ++axis)
                patch.data(axis, node) = velocities[facet[node]][axis];
              patch.data(dim, node) = surface.body(f) - n_bodies;
            }
          add_patch<dim>(result, patch);
        }
    return result;
  }


  template <int dim>
  Patches<dim - 1, dim>
  cut_surface_patches(const Models<dim> &models, const State<dim> &state)
  {
    Patches<dim - 1, dim> result;
    result.name = "surface";
    result.add_vector("velocity", "m/s");
    result.add_scalar("pressure", "Pa");
    result.add_scalar("body", "1");
    const auto  geometry   = geometry_of(models, state);
    const auto &cells      = geometry->cut_cells();
    const auto &surface    = models.surface->surface();
    const auto  velocities = surface_velocities(models, state);
    const auto  pressures  = geometry->cut_topology().of_cut_cells(state.fluid.pressure.parts());
    for (int cell = 0; cell < static_cast<int>(cells.cells.size()); ++cell)
      if (cells.block.owned().contains(cells.cells[cell].index))
        for (int f = cells.cells[cell].first_fragment; f < cells.end_fragment(cell); ++f)
          {
            const auto &fragment = cells.fragments[f];
            const auto velocity = mean<dim>(fragment, surface.facets()[fragment.facet], velocities);
            std::vector<double> numbers(velocity.begin_raw(), velocity.end_raw());
            numbers.push_back(fragment.component < 0 ? 0. : pressures[fragment.component]);
            numbers.push_back(surface.body(fragment.facet));
            add_fragment(result, cells, f, numbers);
          }
    return result;
  }


  template Patches<1, 2>
  obstacle_patches(const Models<2> &, const State<2> &);
  template Patches<2, 3>
  obstacle_patches(const Models<3> &, const State<3> &);
  template Patches<1, 2>
  cut_surface_patches(const Models<2> &, const State<2> &);
  template Patches<2, 3>
  cut_surface_patches(const Models<3> &, const State<3> &);
} // namespace undine
