// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/boundary_flux.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace undine
{
  namespace
  {
    /// Call action(fragment) for all fragments of owned cells, or those of the halo too, that fluid
    /// touches.
    template <int dim, class Action>
    void
    for_each_wet_fragment(const CutCells<dim> &cut,
                          const Action        &action,
                          const bool           in_halo = false)
    {
      for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
        if (in_halo || cut.block.owned().contains(cut.cells[cell].index))
          for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
            if (cut.fragments[f].component != cut.no_component)
              action(cut.fragments[f]);
    }


    /// The part of its facet that a fragment is, and stays wherever that moves [1].
    template <int dim, class Fragment>
    double
    share_of_facet(const Fragment                        &fragment,
                   const Surface<dim>                    &surface,
                   const std::vector<dealii::Point<dim>> &place)
    {
      const auto   whole = area_vector(surface, fragment.facet, place);
      const double size  = whole.norm_square();
      return size > 0 ? fragment.area_vector * whole / size : 0.;
    }


    template <int dim>
    std::vector<dealii::Tensor<1, dim>>
    summed_over_ranks(const std::vector<dealii::Tensor<1, dim>> &values,
                      const MPI_Comm                             communicator)
    {
      std::vector<double> numbers;
      for (const auto &value : values)
        numbers.insert(numbers.end(), value.begin_raw(), value.end_raw());
      dealii::Utilities::MPI::sum(numbers, communicator, numbers);
      std::vector<dealii::Tensor<1, dim>> result(values.size());
      for (std::size_t k = 0; k < numbers.size(); ++k)
        result[k / dim][k % dim] = numbers[k];
      return result;
    }
  } // namespace


  template <int dim>
  BoundaryFlux<dim>::BoundaryFlux(const CutCells<dim> &cut, const Surface<dim> &surface)
    : n_components(cut.components.size())
    , n_nodes(surface.n_nodes())
  {
    add_entries(cut, surface, [](const auto &fragment) { return fragment.area_vector; });
  }


  template <int dim>
  BoundaryFlux<dim>::BoundaryFlux(const CutCells<dim>                   &cut,
                                  const Surface<dim>                    &surface,
                                  const std::vector<dealii::Point<dim>> &place,
                                  const std::vector<dealii::Point<dim>> &before,
                                  const std::vector<dealii::Point<dim>> &after)
    : n_components(cut.components.size())
    , n_nodes(surface.n_nodes())
  {
    add_entries(cut, surface, [&](const auto &fragment) {
      return share_of_facet(fragment, surface, place) *
             mean_area_vector(surface, fragment.facet, before, after);
    });
  }


  template <int dim>
  template <class AreaVector>
  void
  BoundaryFlux<dim>::add_entries(const CutCells<dim> &cut,
                                 const Surface<dim>  &surface,
                                 const AreaVector    &area_vector)
  {
    // Cell by cell: components of one cell come after those of the last.
    std::vector<Entry>        of_cell;
    std::vector<unsigned int> order;
    const auto                append = [&] {
      order.resize(of_cell.size());
      std::iota(order.begin(), order.end(), 0u);
      // As they came if they are of one pair: sums do not depend on what else a rank knows.
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return std::tie(of_cell[a].component, of_cell[a].node, a) <
               std::tie(of_cell[b].component, of_cell[b].node, b);
      });
      for (const unsigned int k : order)
        if (const auto &entry = of_cell[k]; !all_entries.empty() &&
                                            all_entries.back().component == entry.component &&
                                            all_entries.back().node == entry.node)
          all_entries.back().value += entry.value;
        else
          all_entries.push_back(entry);
      of_cell.clear();
    };
    int cell = -1;
    for_each_wet_fragment(cut, [&](const auto &fragment) {
      if (const int here = cut.components[fragment.component].cell; here != cell)
        append(), cell = here;
      const dealii::Tensor<1, dim> area = area_vector(fragment);
      for (unsigned int k = 0; k < dim; ++k)
        of_cell.push_back(
          {fragment.component, surface.facets()[fragment.facet][k], fragment.mean[k] * area});
    });
    append();
  }


  template <int dim>
  std::vector<double>
  BoundaryFlux<dim>::flux(const std::vector<dealii::Tensor<1, dim>> &velocities) const
  {
    AssertDimension(velocities.size(), n_nodes);
    std::vector<double> result(n_components, 0.);
    for (const auto &entry : all_entries)
      result[entry.component] += entry.value * velocities[entry.node];
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  BoundaryFlux<dim>::local_forces(const std::vector<double> &pressures) const
  {
    AssertDimension(pressures.size(), n_components);
    std::vector<dealii::Tensor<1, dim>> result(n_nodes);
    for (const auto &entry : all_entries)
      result[entry.node] += pressures[entry.component] * entry.value;
    return result;
  }


  template <int dim>
  std::vector<double>
  swept_volumes(const CutCells<dim>                       &cut,
                const Surface<dim>                        &surface,
                const std::vector<dealii::Point<dim>>     &place,
                const std::vector<dealii::Point<dim>>     &before,
                const std::vector<dealii::Tensor<1, dim>> &increment,
                const bool                                 in_halo)
  {
    std::vector<double> result(cut.components.size(), 0.);
    auto                after = before;
    for (std::size_t node = 0; node < after.size(); ++node)
      after[node] += increment[node];
    const auto add = [&](const auto &fragment) {
      dealii::Tensor<1, dim> mean_increment;
      for (unsigned int k = 0; k < dim; ++k)
        mean_increment += fragment.mean[k] * increment[surface.facets()[fragment.facet][k]];
      result[fragment.component] += share_of_facet(fragment, surface, place) * mean_increment *
                                    mean_area_vector(surface, fragment.facet, before, after);
    };
    for_each_wet_fragment(cut, add, in_halo);
    return result;
  }


  template <int dim>
  SweptVolumeFlux
  swept_volume_flux(const BoundaryFlux<dim>                   &boundary_flux,
                    const CutCells<dim>                       &cut,
                    const CutTopology<dim>                    &parts,
                    const Surface<dim>                        &surface,
                    const std::vector<dealii::Tensor<1, dim>> &velocities,
                    const StepAccuracy                        &accuracy)
  {
    constexpr double relative = 1e-8;
    const double     rounding =
      16 * std::numeric_limits<double>::epsilon() * accuracy.largest_coordinate;
    SweptVolumeFlux     result;
    std::vector<double> uncertainties(cut.components.size(), 0.);
    for_each_wet_fragment(cut, [&](const auto &fragment) {
      const int component = parts.open_components[fragment.component];
      if (component < 0)
        return;
      double speed = 0, flux = 0;
      for (unsigned int k = 0; k < dim; ++k)
        {
          const auto &velocity = velocities[surface.facets()[fragment.facet][k]];
          speed                = std::max(speed, velocity.norm());
          flux += fragment.mean[k] * velocity * fragment.area_vector;
        }
      result.contributions.push_back({component, surface.body(fragment.facet), flux});
      if (speed == 0)
        return;
      // What its corners are uncertain makes the area uncertain by the length of its rim.
      const double area = fragment.area_vector.norm();
      const double rim  = std::pow(area, (dim - 2) / (dim - 1.));
      uncertainties[fragment.component] +=
        relative * area * speed + rounding * (area / accuracy.dt + rim * speed);
    });
    result.fluxes        = parts.of_fluid_topology(boundary_flux.flux(velocities));
    result.uncertainties = parts.of_fluid_topology(uncertainties);
    result.bodies        = surface.body_names();
    return result;
  }


  template <int dim>
  std::vector<double>
  wetted_areas(const CutCells<dim> &cut, const Surface<dim> &surface, const std::size_t n_nodes)
  {
    std::vector<double> result(cut.components.size(), 0.);
    for_each_wet_fragment(cut, [&](const auto &fragment) {
      if (surface.facets()[fragment.facet][0] < n_nodes)
        result[fragment.component] += fragment.area_vector.norm();
    });
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  nodal_forces(const BoundaryFlux<dim>   &boundary_flux,
               const std::vector<double> &pressures,
               const MPI_Comm             communicator)
  {
    return summed_over_ranks<dim>(boundary_flux.local_forces(pressures), communicator);
  }


  template <int dim>
  std::vector<double>
  pressures_on_facets(const CutCells<dim>                   &cut,
                      const Surface<dim>                    &surface,
                      const std::vector<dealii::Point<dim>> &place,
                      const std::vector<double>             &pressures,
                      const MPI_Comm                         communicator)
  {
    AssertDimension(pressures.size(), cut.components.size());
    std::vector<double> result(surface.facets().size() * dim);
    for_each_wet_fragment(cut, [&](const auto &fragment) {
      const double share = share_of_facet(fragment, surface, place);
      for (unsigned int k = 0; k < dim; ++k)
        result[fragment.facet * dim + k] +=
          share * fragment.mean[k] * pressures[fragment.component];
    });
    dealii::Utilities::MPI::sum(result, communicator, result);
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  gravity_loads(const CutCells<dim>                   &cut,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions,
                const std::vector<double>             &densities,
                const dealii::Tensor<1, dim>          &gravity,
                const MPI_Comm                         communicator)
  {
    AssertDimension(densities.size(), cut.components.size());
    std::vector<dealii::Tensor<1, dim>> result(surface.n_nodes());
    for_each_wet_fragment(cut, [&](const auto &fragment) {
      const auto &nodes = surface.facets()[fragment.facet];
      for (unsigned int i = 0; i < dim; ++i)
        {
          double mean = 0; // of (g.x) N_i
          for (unsigned int j = 0; j < dim; ++j)
            mean += gravity * positions[nodes[j]] * fragment.product(i, j);
          result[nodes[i]] += densities[fragment.component] * mean * fragment.area_vector;
        }
    });
    return summed_over_ranks<dim>(result, communicator);
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template class BoundaryFlux<dim>;                                                                \
  template SweptVolumeFlux swept_volume_flux(const BoundaryFlux<dim> &, const CutCells<dim> &,            \
                                      const CutTopology<dim> &, const Surface<dim> &,                 \
                                      const std::vector<dealii::Tensor<1, dim>> &,                 \
                                      const StepAccuracy &);                                       \
  template std::vector<double> swept_volumes(const CutCells<dim> &, const Surface<dim> &,          \
    const std::vector<dealii::Point<dim>> &, const std::vector<dealii::Point<dim>> &,              \
    const std::vector<dealii::Tensor<1, dim>> &, bool);                                            \
  template std::vector<double> wetted_areas(const CutCells<dim> &, const Surface<dim> &,           \
                                            const std::size_t);                                    \
  template std::vector<dealii::Tensor<1, dim>> nodal_forces(const BoundaryFlux<dim> &,             \
                                                            const std::vector<double> &, MPI_Comm);\
  template std::vector<double> pressures_on_facets(const CutCells<dim> &, const Surface<dim> &, \
    const std::vector<dealii::Point<dim>> &, const std::vector<double> &, MPI_Comm); \
  template std::vector<dealii::Tensor<1, dim>> gravity_loads(                                      \
    const CutCells<dim> &, const Surface<dim> &, const std::vector<dealii::Point<dim>> &,          \
    const std::vector<double> &, const dealii::Tensor<1, dim> &, MPI_Comm);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
