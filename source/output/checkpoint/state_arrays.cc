// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/output/checkpoint/account_array.h>
#include <undine/output/checkpoint/budget_array.h>
#include <undine/output/checkpoint/history_arrays.h>
#include <undine/output/checkpoint/impulses_array.h>
#include <undine/output/checkpoint/particle_arrays.h>
#include <undine/output/checkpoint/sleep_array.h>
#include <undine/output/checkpoint/state_arrays.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <map>
#include <memory>

namespace undine
{
  namespace
  {
    using NodalVector = dealii::TrilinosWrappers::MPI::Vector;
    using Index       = dealii::types::global_dof_index;

    /// Carries numbered values between the ranks that own them and stretches of equal length in the
    /// order of the numbers. In the latter the owners' entries are ghosts.
    class CanonicalVector
    {
    public:
      /// `numbers` below n of this rank's values; every number is on one rank. Collective.
      CanonicalVector(const Index n, const std::vector<Index> &numbers, const MPI_Comm communicator)
        : numbers(numbers)
      {
        if (n == 0)
          return; // nothing can be shared out
        const std::uint64_t n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
        const std::uint64_t rank    = dealii::Utilities::MPI::this_mpi_process(communicator);

        dealii::IndexSet stretch(n), mine(n);
        first = n * rank / n_ranks;
        stretch.add_range(first, n * (rank + 1) / n_ranks);
        auto sorted = numbers;
        std::sort(sorted.begin(), sorted.end());
        mine.add_indices(sorted.begin(), sorted.end());
        vector.reinit(stretch, mine, communicator);
      }

      /// `values` in the order of the numbers given.
      StateArray
      pack(const std::string &name, const std::vector<double> &values)
      {
        vector.zero_out_ghost_values();
        vector = 0;
        for (std::size_t k = 0; k < numbers.size(); ++k)
          vector(numbers[k]) = values[k];
        vector.compress(dealii::VectorOperation::add); // every entry comes from one rank
        const hsize_t count = vector.locally_owned_size();
        return {name,
                {{vector.size()}, {first}, {count}},
                std::vector<double>(vector.begin(), vector.begin() + count)};
      }

      bool
      empty() const
      {
        return vector.size() == 0;
      }

      std::vector<double>
      unpack(const StateArray &array)
      {
        std::copy(array.values.begin(), array.values.end(), vector.begin());
        vector.update_ghost_values();
        std::vector<double> values;
        for (const Index number : numbers)
          values.push_back(vector(number));
        return values;
      }

    private:
      std::vector<Index>                                 numbers;
      hsize_t                                            first = 0;
      dealii::LinearAlgebra::distributed::Vector<double> vector;
    };


    template <int dim>
    CanonicalVector
    canonical_nodes(const SolidModel<dim> &model)
    {
      const auto         order = model.canonical_order();
      std::vector<Index> numbers;
      for (const Index dof : model.locally_owned())
        numbers.push_back(order[dof]);
      return CanonicalVector(order.size(), numbers, model.communicator());
    }


    /// The sub-cells or sub-faces of divided points, in the order of the points in the whole
    /// lattice. Values are those of the ones that a rank owns.
    template <int dim>
    CanonicalVector
    canonical_parts(const Lattice<dim> &lattice, const SubLattice<dim> &divided)
    {
      const IndexBox<dim> whole{{}, lattice.shape()};
      std::vector<Index>  mine, all; // of each the position of its point
      for (std::size_t k = 0; k < divided.all().size(); ++k)
        if (divided.owns(k))
          mine.push_back(whole.position(divided.all()[k].index));
      const auto communicator = lattice.blocks().communicator();
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, mine))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      std::sort(all.begin(), all.end());

      std::vector<Index> numbers;
      for (std::size_t k = 0; k < divided.all().size(); ++k)
        if (divided.owns(k))
          {
            const auto &index = divided.all()[k].index;
            const auto  first = std::lower_bound(all.begin(), all.end(), whole.position(index));
            numbers.push_back(first - all.begin() + k - divided.first(index));
          }
      return CanonicalVector(all.size(), numbers, communicator);
    }


    /// Those of all lattices, made when they are asked for.
    template <int dim>
    class CanonicalParts
    {
    public:
      CanonicalVector &
      of(const Field<dim> &field)
      {
        auto &entry = vectors[field.divided()];
        if (!entry)
          entry =
            std::make_unique<CanonicalVector>(canonical_parts(field.lattice(), *field.divided()));
        return *entry;
      }

    private:
      std::map<const SubLattice<dim> *, std::unique_ptr<CanonicalVector>> vectors;
    };


    template <int dim>
    std::vector<double>
    owned_parts(const Field<dim> &field)
    {
      std::vector<double> values;
      for (std::size_t k = 0; k < field.parts().size(); ++k)
        if (field.divided()->owns(k))
          values.push_back(field.parts()[k]);
      return values;
    }


    template <int dim>
    void
    set_owned_parts(Field<dim> &field, const std::vector<double> &values)
    {
      auto value = values.begin();
      for (std::size_t k = 0; k < field.parts().size(); ++k)
        if (field.divided()->owns(k))
          field.parts()[k] = *value++;
    }


    /// Call `action(name, vector)` for the nodal vectors that are in use.
    template <class State, class Action>
    void
    for_each_vector(State &state, const Action &action)
    {
      auto &solid = state.solid;
      if (solid.displacement.size() > 0)
        action("solid/displacement", solid.displacement);
      if (solid.velocity.size() > 0)
        action("solid/velocity", solid.velocity);
      if (solid.acceleration.size() > 0)
        action("solid/acceleration", solid.acceleration);
      if (solid.fluid_loads.size() > 0)
        action(fluid_loads_array, solid.fluid_loads);
      if (solid.contact_forces.size() > 0)
        action(contact_forces_array, solid.contact_forces);
      if (solid.impulse_acceleration.size() > 0)
        action(impulse_acceleration_array, solid.impulse_acceleration);
      for_each_sample(state.history, [&](const std::string &name, auto &sample) {
        action(name + "/bodies", sample.bodies);
      });
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
      for (unsigned int axis = 0; axis < dim; ++axis)
        action(std::string("fluid/change_") + char('x' + axis), fluid.change[axis]);
      for (unsigned int axis = 0; axis < dim && is_in_use(fluid.volume_rates); ++axis)
        for (const unsigned int end : {0, 1})
          action(std::string("fluid/volume_rates_") + (end == 0 ? "below_" : "above_") +
                   char('x' + axis),
                 fluid.volume_rates.halves[end][axis]);
      action("fluid/pressure", fluid.pressure);
      for (auto &scalar : fluid.scalars)
        action("fluid/scalars/" + scalar.first, scalar.second);
      for (auto &rate : fluid.scalar_rates)
        action(scalar_rates_array + rate.first, rate.second);
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


    /// Points or vectors in all nodes of the surface, zero if they are not known yet. All ranks
    /// have all of them: the first one's go to the file.
    template <int dim, class VectorType>
    StateArray
    pack_replicated(const std::string             &name,
                    const Models<dim>             &models,
                    const std::vector<VectorType> &vectors)
    {
      const bool first =
        dealii::Utilities::MPI::this_mpi_process(models.fluid->grid().communicator()) == 0;
      const hsize_t n_nodes = models.surface->surface().n_nodes();
      StateArray    array{name, {{n_nodes, dim}, {0, 0}, {0, dim}}, {}};
      if (!first)
        return array;
      array.selection.count[0] = n_nodes;
      for (const auto &vector : vectors)
        array.values.insert(array.values.end(), vector.begin_raw(), vector.end_raw());
      array.values.resize(n_nodes * dim, 0.);
      return array;
    }
  } // namespace


  StateArray
  numbers_of_first_rank(const std::string         &name,
                        const std::vector<double> &numbers,
                        const MPI_Comm             communicator)
  {
    const hsize_t size = numbers.size();
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      return {name, {{size}, {0}, {size}}, numbers};
    return {name, {{size}, {0}, {0}}, {}};
  }


  template <int dim>
  std::vector<StateArray>
  pack_surface(const Models<dim> &models, const State<dim> &state)
  {
    if (!models.surface || !models.fluid)
      return {};
    return {pack_replicated("surface/positions", models, state.surface_positions)};
  }


  template <int dim>
  void
  unpack_surface(State<dim>                    &state,
                 const Models<dim>             &models,
                 const std::vector<StateArray> &arrays)
  {
    if (arrays.empty())
      return;
    const auto unpack_replicated = [&](auto &vectors, const StateArray &array) {
      const auto values =
        dealii::Utilities::MPI::broadcast(models.fluid->grid().communicator(), array.values);
      vectors.resize(values.size() / dim);
      for (std::size_t k = 0; k < values.size(); ++k)
        vectors[k / dim][k % dim] = values[k];
    };
    unpack_replicated(state.surface_positions, arrays[0]);
    const auto topology = geometry_of(models, state)->cut_topology().open;
    for_each_field<dim>(state.fluid, [&](const std::string &, Field<dim> &field) {
      field = Field<dim>(field.shared_lattice(), topology);
    });
  }


  template <int dim>
  std::vector<StateArray>
  pack(const Models<dim> &models, const State<dim> &state)
  {
    if (models.particles)
      return pack_particles(state.particles, models.particles->setup().spacing);
    std::vector<StateArray> arrays;
    if (state.history.in_use())
      arrays.push_back(pack_numbers(state.history, models.communicator()));
    if (state.sleep.in_use())
      arrays.push_back(pack_sleep(state.sleep, models.communicator()));
    if (state.budget_rates.known)
      arrays.push_back(pack_budget(state.budget_rates, models.communicator()));
    if (state.account)
      arrays.push_back(pack_account(*state.account, models.communicator()));
    if (state.impulses)
      arrays.push_back(pack_impulses(*state.impulses, models.communicator()));
    if (models.solid)
      {
        auto canonical = canonical_nodes(*models.solid);
        for_each_vector(state, [&](const std::string &name, const NodalVector &vector) {
          std::vector<double> values;
          for (const Index dof : models.solid->locally_owned())
            values.push_back(vector(dof));
          arrays.push_back(canonical.pack(name, values));
        });
      }
    if (!models.fluid)
      return arrays;
    CanonicalParts<dim> parts;
    const auto          add = [&](const std::string &name, const Field<dim> &field) {
      arrays.push_back({name, selection_of<dim>(field), field.owned_values()});
      if (field.divided() && !parts.of(field).empty())
        arrays.push_back(parts.of(field).pack("parts/" + name, owned_parts(field)));
    };
    if (is_in_use(state.fluid.volume_rates))
      arrays.push_back(numbers_of_first_rank(
        volume_rate_time_array, {state.fluid.volume_rates.time}, models.communicator()));
    for_each_field<dim>(state.fluid, add);
    for_each_field_of_samples<dim>(state.history, add);
    return arrays;
  }


  template <int dim>
  void
  unpack(State<dim> &state, const Models<dim> &models, const std::vector<StateArray> &arrays)
  {
    if (models.particles)
      return unpack_particles(state.particles, arrays);
    auto array = arrays.begin();
    if (state.history.in_use())
      unpack_numbers(state.history, *array++, models.communicator());
    if (state.sleep.in_use())
      unpack_sleep(state.sleep, *array++, models.communicator());
    if (state.budget_rates.known)
      unpack_budget(state.budget_rates, *array++, models.communicator());
    if (state.account)
      state.account = unpack_account(*array++, models.communicator());
    if (state.impulses)
      unpack_impulses(*state.impulses, *array++, models.communicator());
    if (models.solid)
      {
        auto canonical = canonical_nodes(*models.solid);
        for_each_vector(state, [&](const std::string &, NodalVector &vector) {
          const auto values = canonical.unpack(*array++);
          auto       value  = values.begin();
          for (const Index dof : models.solid->locally_owned())
            vector(dof) = *value++;
          vector.compress(dealii::VectorOperation::insert);
        });
      }
    if (!models.fluid)
      return;
    CanonicalParts<dim> parts;
    const auto          fill = [&](const std::string &, Field<dim> &field) {
      field.set_owned_values((array++)->values);
      if (field.divided() && !parts.of(field).empty())
        set_owned_parts(field, parts.of(field).unpack(*array++));
      field.exchange();
    };
    if (is_in_use(state.fluid.volume_rates))
      state.fluid.volume_rates.time =
        dealii::Utilities::MPI::broadcast(models.communicator(), (array++)->values).front();
    for_each_field<dim>(state.fluid, fill);
    for_each_field_of_samples<dim>(state.history, fill);
  }


  template std::vector<StateArray>
  pack_surface(const Models<2> &, const State<2> &);
  template std::vector<StateArray>
  pack_surface(const Models<3> &, const State<3> &);
  template void
  unpack_surface(State<2> &, const Models<2> &, const std::vector<StateArray> &);
  template void
  unpack_surface(State<3> &, const Models<3> &, const std::vector<StateArray> &);
  template std::vector<StateArray>
  pack(const Models<2> &, const State<2> &);
  template std::vector<StateArray>
  pack(const Models<3> &, const State<3> &);
  template void
  unpack(State<2> &, const Models<2> &, const std::vector<StateArray> &);
  template void
  unpack(State<3> &, const Models<3> &, const std::vector<StateArray> &);
} // namespace undine
