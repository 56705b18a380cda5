// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field.h>

#include <algorithm>
#include <utility>

namespace undine
{
  template <int dim>
  Field<dim>::Field(std::shared_ptr<const Lattice<dim>>       lattice,
                    std::shared_ptr<const FluidTopology<dim>> topology)
    : points(std::move(lattice))
    , open(std::move(topology))
    , part_values(open ? open->of(*points).all().size() : 0)
  {
    store(points->owned());
  }


  template <int dim>
  void
  Field<dim>::store(const IndexBox<dim> &new_box)
  {
    const auto old_box     = box;
    const auto old_strides = strides;
    const auto old_values  = std::move(values);
    box                    = new_box;
    strides[0]             = 1;
    for (unsigned int d = 1; d < dim; ++d)
      strides[d] = strides[d - 1] * (box.upper[d - 1] - box.lower[d - 1]);
    values.assign(box.size(), 0.);
    if (!old_values.empty())
      for_each_row(old_box.intersection(box), [&](const GridIndex<dim> &first, const int n) {
        std::ptrdiff_t old = 0;
        for (unsigned int d = 0; d < dim; ++d)
          old += (first[d] - old_box.lower[d]) * old_strides[d];
        std::copy_n(old_values.data() + old, n, data(first));
      });
  }


  template <int dim>
  void
  Field<dim>::exchange(const int width)
  {
    exchange(all_directions<dim>(width));
  }


  template <int dim>
  void
  Field<dim>::exchange(const GridIndex<dim> &width)
  {
    if (open)
      open->of(*points).exchange(part_values);
    for (unsigned int d = 0; d < dim; ++d)
      if (width[d] > layers[d])
        {
          layers = width;
          store(points->with_ghosts(points->blocks().rank(), width));
          break;
        }
    points->ghost_layers(layers, width).update(dealii::make_array_view(values));
  }


  template <int dim>
  std::vector<double>
  Field<dim>::owned_values() const
  {
    std::vector<double> result;
    result.reserve(owned().size());
    for_each_row(owned(), [&](const GridIndex<dim> &first, const int n) {
      result.insert(result.end(), data(first), data(first) + n);
    });
    return result;
  }


  template <int dim>
  void
  Field<dim>::set_owned_values(const std::vector<double> &owned_values)
  {
    auto next = owned_values.begin();
    for_each_row(owned(), [&](const GridIndex<dim> &first, const int n) {
      std::copy_n(next, n, data(first));
      next += n;
    });
  }


  template class Field<2>;
  template class Field<3>;
} // namespace undine
