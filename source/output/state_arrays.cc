// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/state_arrays.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    using NodalVector = dealii::TrilinosWrappers::MPI::Vector;
    using Index       = dealii::types::global_dof_index;

    /// Carries nodal vectors between the solid's distribution over the ranks and stretches of equal
    /// length in canonical order. In the latter the solid's own entries are ghosts.
    template <int dim>
    class CanonicalVector
    {
    public:
      explicit CanonicalVector(const SolidModel<dim> &model)
        : model(model)
        , order(model.canonical_order())
      {
        const Index         n       = order.size();
        const MPI_Comm      comm    = model.communicator();
        const std::uint64_t n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
        const std::uint64_t rank    = dealii::Utilities::MPI::this_mpi_process(comm);

        dealii::IndexSet stretch(n), mine(n);
        first = n * rank / n_ranks;
        stretch.add_range(first, n * (rank + 1) / n_ranks);
        std::vector<Index> numbers;
        for (const Index dof : model.locally_owned())
          numbers.push_back(order[dof]);
        std::sort(numbers.begin(), numbers.end());
        mine.add_indices(numbers.begin(), numbers.end());
        vector.reinit(stretch, mine, comm);
      }

      StateArray
      pack(const std::string &name, const NodalVector &nodal)
      {
        vector.zero_out_ghost_values();
        vector = 0;
        for (const Index dof : model.locally_owned())
          vector(order[dof]) = nodal(dof);
        vector.compress(dealii::VectorOperation::add); // every entry comes from one rank
        const hsize_t count = vector.locally_owned_size();
        return {name,
                {{vector.size()}, {first}, {count}},
                std::vector<double>(vector.begin(), vector.begin() + count)};
      }

      void
      unpack(NodalVector &nodal, const StateArray &array)
      {
        std::copy(array.values.begin(), array.values.end(), vector.begin());
        vector.update_ghost_values();
        for (const Index dof : model.locally_owned())
          nodal(dof) = vector(order[dof]);
        nodal.compress(dealii::VectorOperation::insert);
      }

    private:
      const SolidModel<dim>                             &model;
      std::vector<Index>                                 order;
      hsize_t                                            first;
      dealii::LinearAlgebra::distributed::Vector<double> vector;
    };


    /// Call `action(name, vector)` for the nodal vectors that are in use.
    template <class Solid, class Action>
    void
    for_each_vector(Solid &solid, const Action &action)
    {
      if (solid.displacement.size() > 0)
        action("solid/displacement", solid.displacement);
      if (solid.velocity.size() > 0)
        action("solid/velocity", solid.velocity);
      if (solid.acceleration.size() > 0)
        action("solid/acceleration", solid.acceleration);
    }


    /// Call `action(name, field)` for all fields of the fluid.
    template <int dim, class Fluid, class Action>
    void
    for_each_field(Fluid &fluid, const Action &action)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        action(std::string("fluid/velocity_") + char('x' + axis), fluid.velocity[axis]);
      for (unsigned int axis = 0; axis < dim; ++axis)
        action(std::string("fluid/acceleration_") + char('x' + axis), fluid.acceleration[axis]);
      action("fluid/pressure", fluid.pressure);
      for (auto &scalar : fluid.scalars)
        action("fluid/scalars/" + scalar.first, scalar.second);
    }


    /// HDF5's last direction runs fastest, the lattice's first one does.
    template <int dim>
    Selection
    selection_of(const Field<dim> &field)
    {
      Selection selection;
      for (unsigned int d = dim; d-- > 0;)
        {
          const auto &box = field.owned();
          selection.size.push_back(field.lattice().shape()[d]);
          selection.offset.push_back(box.empty() ? 0 : box.lower[d]);
          selection.count.push_back(box.empty() ? 0 : box.upper[d] - box.lower[d]);
        }
      return selection;
    }
  } // namespace


  template <int dim>
  std::vector<StateArray>
  pack(const Models<dim> &models, const State<dim> &state)
  {
    std::vector<StateArray> arrays;
    if (models.solid)
      {
        CanonicalVector<dim> canonical(*models.solid);
        for_each_vector(state.solid, [&](const std::string &name, const NodalVector &vector) {
          arrays.push_back(canonical.pack(name, vector));
        });
      }
    if (models.fluid)
      for_each_field<dim>(state.fluid, [&](const std::string &name, const Field<dim> &field) {
        arrays.push_back({name, selection_of<dim>(field), field.owned_values()});
      });
    return arrays;
  }


  template <int dim>
  void
  unpack(State<dim> &state, const Models<dim> &models, const std::vector<StateArray> &arrays)
  {
    auto array = arrays.begin();
    if (models.solid)
      {
        CanonicalVector<dim> canonical(*models.solid);
        for_each_vector(state.solid, [&](const std::string &, NodalVector &vector) {
          canonical.unpack(vector, *array++);
        });
      }
    if (models.fluid)
      for_each_field<dim>(state.fluid, [&](const std::string &, Field<dim> &field) {
        field.set_owned_values((array++)->values);
        field.exchange();
      });
  }


  template std::vector<StateArray>
  pack(const Models<2> &, const State<2> &);
  template std::vector<StateArray>
  pack(const Models<3> &, const State<3> &);
  template void
  unpack(State<2> &, const Models<2> &, const std::vector<StateArray> &);
  template void
  unpack(State<3> &, const Models<3> &, const std::vector<StateArray> &);
} // namespace undine
