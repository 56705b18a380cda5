// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>

namespace undine
{
  template <int dim>
  void
  set_means(Field<dim> &field, const MacGrid<dim> &grid)
  {
    const auto *divided = field.divided();
    if (divided == nullptr)
      return;
    const unsigned int axis = field.lattice().normal_axis();
    for_each(field.owned(), [&](const GridIndex<dim> &index) {
      if (divided->kind(index) == SubLattice<dim>::Kind::whole)
        return;
      double moment = 0, measure = 0;
      for_each_part(*divided, index, [&](const int part) {
        moment += divided->all()[part].measure * field.parts()[part];
        measure += divided->all()[part].measure;
      });
      if (axis < dim)
        measure = grid.face_area(axis, index);
      field(index) = measure > 0 ? moment / measure : 0.;
    });
  }


  template <int dim>
  void
  set_means(Velocity<dim> &velocity, const MacGrid<dim> &grid)
  {
    for (auto &component : velocity.components)
      set_means(component, grid);
  }


  template <int dim>
  void
  set_volumes(Field<dim> &volumes, const MacGrid<dim> &grid)
  {
    const auto *divided = volumes.divided();
    for_each(volumes.owned(), [&](const GridIndex<dim> &cell) {
      if (!divided || divided->kind(cell) == SubLattice<dim>::Kind::whole)
        volumes(cell) = grid.cell_volume(cell);
    });
    for (std::size_t c = 0; c < volumes.parts().size(); ++c)
      volumes.parts()[c] = divided->all()[c].measure;
  }


  template <int dim>
  void
  add(Field<dim> &field, const double factor, const Field<dim> &change)
  {
    for_each_row(field.owned(), [&](const GridIndex<dim> &first, const int n) {
      double       *values = field.data(first);
      const double *more   = change.data(first);
      for (int i = 0; i < n; ++i)
        values[i] += factor * more[i];
    });
    for (std::size_t k = 0; k < field.parts().size(); ++k)
      field.parts()[k] += factor * change.parts()[k];
  }


  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      add(velocity[axis], factor, acceleration[axis]);
  }


  template <int dim>
  void
  scale(Velocity<dim> &velocity, const double factor)
  {
    for (auto &component : velocity.components)
      {
        for_each_row(component.owned(), [&](const GridIndex<dim> &first, const int n) {
          double *values = component.data(first);
          for (int i = 0; i < n; ++i)
            values[i] *= factor;
        });
        for (double &value : component.parts())
          value *= factor;
      }
  }


  template <int dim>
  void
  exchange(Velocity<dim> &velocity)
  {
    for (auto &component : velocity.components)
      component.exchange(1);
  }


#define INSTANTIATE(dim)                                                   \
  template void set_means(Velocity<dim> &, const MacGrid<dim> &);          \
  template void set_means(Field<dim> &, const MacGrid<dim> &);             \
  template void set_volumes(Field<dim> &, const MacGrid<dim> &);           \
  template void add(Field<dim> &, const double, const Field<dim> &);       \
  template void add(Velocity<dim> &, const double, const Velocity<dim> &); \
  template void scale(Velocity<dim> &, const double);                      \
  template void exchange(Velocity<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
