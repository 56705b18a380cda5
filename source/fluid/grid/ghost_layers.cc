// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/ghost_layers.h>

#include <undine/fluid/grid/lattice.h>

#include <deal.II/base/array_view.h>

#include <map>

namespace undine
{
  template <int dim>
  GhostLayers<dim>::GhostLayers(const Lattice<dim>   &lattice,
                                const GridIndex<dim> &stored,
                                const GridIndex<dim> &width)
  {
    using dealii::types::global_dof_index;
    const auto rank = lattice.blocks().rank();
    const auto box  = lattice.with_ghosts(rank, stored);
    // Both are lists of what is stored; what does not take part is "invalid" there.
    std::vector<global_dof_index> owned(box.size(), dealii::numbers::invalid_dof_index);
    std::vector<global_dof_index> ghosts(owned);
    for_each(lattice.owned(), [&](const GridIndex<dim> &index) {
      owned[box.position(index)] = lattice.number(index);
    });

    std::map<global_dof_index, std::size_t> first_of; // a point can have several images here
    for_each(lattice.with_ghosts(rank, width), [&](const GridIndex<dim> &index) {
      if (lattice.owned().contains(index) || lattice.is_boundary_point(index))
        return;
      const auto point    = lattice.wrapped(index);
      const auto position = box.position(index);
      if (lattice.owned().contains(point))
        images.emplace_back(box.position(point), position);
      else
        {
          const auto number            = lattice.number(point);
          const auto [first, is_first] = first_of.try_emplace(number, position);
          if (is_first)
            ghosts[position] = number;
          else
            images.emplace_back(first->second, position);
        }
    });
    partitioner.reinit(owned, ghosts, lattice.blocks().communicator());
  }


  template <int dim>
  template <typename Number>
  void
  GhostLayers<dim>::update(const dealii::ArrayView<Number> &values) const
  {
    partitioner.export_to_ghosted_array(
      dealii::ArrayView<const Number>(values.data(), values.size()), values);
    for (const auto &[from, to] : images)
      values[to] = values[from];
  }


#define INSTANTIATE(dim)                                                           \
  template class GhostLayers<dim>;                                                 \
  template void GhostLayers<dim>::update(const dealii::ArrayView<double> &) const; \
  template void GhostLayers<dim>::update(const dealii::ArrayView<float> &) const;

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
