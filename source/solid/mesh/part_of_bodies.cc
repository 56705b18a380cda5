// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/part_of_bodies.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    using Index = dealii::types::global_dof_index;


    /// Those owned and those listed.
    dealii::IndexSet
    with(const dealii::IndexSet &owned, std::vector<Index> more)
    {
      std::sort(more.begin(), more.end());
      auto result = owned;
      result.add_indices(more.begin(), more.end());
      result.compress();
      return result;
    }


    template <int dim>
    typename SolidModel<dim>::Vector
    readable(const typename SolidModel<dim>::Vector &vector,
             const SolidModel<dim>                  &model,
             const dealii::IndexSet                 &indices)
    {
      typename SolidModel<dim>::Vector result(model.locally_owned(), indices, model.communicator());
      result = vector;
      return result;
    }
  } // namespace


  template <int dim>
  PartOfBodies<dim>::PartOfBodies(const SolidModel<dim> &all, const SolidModel<dim> &part)
    : all(all)
    , part(part)
    , in_part(all.dof_handler().n_dofs(), dealii::numbers::invalid_dof_index)
    , in_all(part.dof_handler().n_dofs(), dealii::numbers::invalid_dof_index)
  {
    // Meshes list the cells of their bodies in the same order.
    std::vector<Index> here(all.dof_handler().get_fe().n_dofs_per_cell()), there(here.size());
    auto               cell_of_part = part.dof_handler().begin_active();
    for (const auto &cell : all.dof_handler().active_cell_iterators())
      if (part.has(cell->material_id()))
        {
          AssertDimension(cell->material_id(), cell_of_part->material_id());
          cell->get_dof_indices(here);
          cell_of_part->get_dof_indices(there);
          for (unsigned int i = 0; i < here.size(); ++i)
            {
              in_part[here[i]] = there[i];
              in_all[there[i]] = here[i];
            }
          ++cell_of_part;
        }
    std::vector<Index> wanted;
    for (const Index dof : part.locally_owned())
      wanted.push_back(in_all[dof]);
    read_of_all = with(all.locally_owned(), wanted);
    wanted.clear();
    for (const Index dof : all.locally_owned())
      if (in_part[dof] != dealii::numbers::invalid_dof_index)
        wanted.push_back(in_part[dof]);
    read_of_part = with(part.locally_owned(), wanted);
  }


  template <int dim>
  typename PartOfBodies<dim>::Vector
  PartOfBodies<dim>::taken_from(const Vector &of_all) const
  {
    const Vector known  = readable(of_all, all, read_of_all);
    Vector       result = part.vector();
    auto         entry  = result.begin(); // in the order of the owned degrees of freedom
    for (const Index dof : part.locally_owned())
      *entry++ = known(in_all[dof]);
    return result;
  }


  template <int dim>
  void
  PartOfBodies<dim>::put_into(Vector &of_all, const Vector &of_part) const
  {
    const Vector known = readable(of_part, part, read_of_part);
    auto         entry = of_all.begin(); // in the order of the owned degrees of freedom
    for (const Index dof : all.locally_owned())
      {
        if (in_part[dof] != dealii::numbers::invalid_dof_index)
          *entry = known(in_part[dof]);
        ++entry;
      }
  }


  template <int dim>
  SolidState
  PartOfBodies<dim>::taken_from(const SolidState &of_all) const
  {
    const auto if_known = [&](const Vector &vector) {
      return vector.size() > 0 ? taken_from(vector) : Vector();
    };
    return {taken_from(of_all.displacement),
            taken_from(of_all.velocity),
            taken_from(of_all.acceleration),
            if_known(of_all.fluid_loads),
            if_known(of_all.contact_forces),
            if_known(of_all.impulse_acceleration)};
  }


  template <int dim>
  void
  PartOfBodies<dim>::put_into(SolidState &of_all, const SolidState &of_part) const
  {
    put_into(of_all.displacement, of_part.displacement);
    put_into(of_all.velocity, of_part.velocity);
    put_into(of_all.acceleration, of_part.acceleration);
    const auto if_known = [&](Vector &vector, const Vector &of_these) {
      if (of_these.size() == 0)
        return;
      if (vector.size() == 0)
        vector = all.vector();
      put_into(vector, of_these);
    };
    if_known(of_all.fluid_loads, of_part.fluid_loads);
    of_all.contact_forces.clear(); // bodies that sleep have no rates
    if_known(of_all.contact_forces, of_part.contact_forces);
    if_known(of_all.impulse_acceleration, of_part.impulse_acceleration);
    if (of_part.impulse_acceleration.size() == 0 && of_all.impulse_acceleration.size() > 0)
      put_into(of_all.impulse_acceleration, part.vector()); // those that sleep keep theirs
  }


  template class PartOfBodies<2>;
  template class PartOfBodies<3>;
} // namespace undine
