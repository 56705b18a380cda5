// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/index_box.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/face_facets.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_tools.h>

#include <unordered_map>

namespace undine
{
  namespace
  {
    // By how much of its distance from the mean of the corners a node between them is moved on.
    constexpr double moved_on = 1. / 3;


    /// The corners of the cell that lie around a node of its lattice, those of the edge or face in
    /// which it lies; none for a corner.
    template <int dim>
    std::vector<unsigned int>
    corners_around(const unsigned int node, const unsigned int degree)
    {
      const IndexBox<dim>       lattice{{}, all_directions<dim>(degree + 1)};
      std::vector<unsigned int> result;
      GridIndex<dim>            place;
      IndexBox<dim>             ends{{}, all_directions<dim>(1)}; // 0 and 1 where it is between
      for (unsigned int d = 0, rest = node; d < dim; ++d, rest /= degree + 1)
        {
          place[d] = rest % (degree + 1);
          if (place[d] % int(degree) != 0)
            ends.upper[d] = 2;
        }
      if (ends.size() == 1)
        return {};
      for_each(ends, [&](const GridIndex<dim> &end) {
        auto corner = place;
        for (unsigned int d = 0; d < dim; ++d)
          if (ends.upper[d] == 2)
            corner[d] = end[d] * degree;
        result.push_back(lattice.position(corner));
      });
      return result;
    }


    /// For each node of a cell's lattice (first direction fastest) its degree of freedom in the
    /// cell, by axis.
    template <int dim>
    std::vector<std::array<unsigned int, dim>>
    dofs_of_lattice(const dealii::FiniteElement<dim> &element)
    {
      const auto lexicographic =
        dealii::FETools::hierarchic_to_lexicographic_numbering<dim>(element.degree);
      std::vector<std::array<unsigned int, dim>> result(lexicographic.size());
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        {
          const auto component = element.system_to_component_index(i);
          result[lexicographic[component.second]][component.first] = i;
        }
      return result;
    }
  } // namespace


  template <int dim>
  BodySurface<dim>::BodySurface(const SolidModel<dim> &model)
    : BodySurface(collect(model))
  {
  }


  template <int dim>
  BodySurface<dim>
  BodySurface<dim>::collect(const SolidModel<dim> &model)
  {
    const auto &element        = model.dof_handler().get_fe();
    const auto  lattice        = dofs_of_lattice<dim>(element);
    const auto  facets_of_face = face_facets<dim>(element.degree);

    std::vector<std::array<Index, dim>>          dofs;
    std::vector<Corners>                         corners;
    std::unordered_map<Index, unsigned int>      nodes; // by the degree of freedom of axis 0
    std::vector<typename Surface<dim>::Facet>    facets;
    std::vector<unsigned int>                    body_of_facet;
    std::vector<std::string>                     names;
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    const auto node_of = [&](const std::array<unsigned int, dim> &dofs_in_cell) {
      const auto found = nodes.emplace(indices[dofs_in_cell[0]], dofs.size());
      if (found.second)
        {
          dofs.emplace_back();
          for (unsigned int axis = 0; axis < dim; ++axis)
            dofs.back()[axis] = indices[dofs_in_cell[axis]];
        }
      return found.first->second;
    };

    for (unsigned int body = 0; body < model.bodies().size(); ++body)
      {
        names.push_back(model.bodies()[body].name);
        for (const auto &cell : model.dof_handler().active_cell_iterators())
          {
            if (cell->material_id() != body || !cell->at_boundary())
              continue;
            cell->get_dof_indices(indices);
            for (const unsigned int face : cell->face_indices())
              if (cell->at_boundary(face))
                {
                  for (const auto &facet : facets_of_face[face])
                    {
                      body_of_facet.push_back(body);
                      facets.emplace_back();
                      for (unsigned int k = 0; k < dim; ++k)
                        facets.back()[k] = node_of(lattice[facet[k]]);
                    }
                  corners.resize(dofs.size());
                  for (const auto &facet : facets_of_face[face])
                    for (const unsigned int node : facet)
                      {
                        auto &around = corners[node_of(lattice[node])];
                        around.clear();
                        for (const unsigned int corner : corners_around<dim>(node, element.degree))
                          around.push_back(node_of(lattice[corner]));
                      }
                }
          }
      }
    const Surface<dim> surface(dofs.size(), facets, body_of_facet, names);
    return BodySurface(model, std::move(dofs), std::move(corners), surface);
  }


  template <int dim>
  BodySurface<dim>::BodySurface(const SolidModel<dim>              &model,
                                std::vector<std::array<Index, dim>> dofs_of_nodes,
                                std::vector<Corners>                corners_of_nodes,
                                const Surface<dim>                 &facets)
    : dofs(std::move(dofs_of_nodes))
    , corners(std::move(corners_of_nodes))
    , all_facets(facets)
    , communicator(model.communicator())
  {
    for (unsigned int node = 0; node < n_nodes(); ++node)
      rest_positions.push_back(model.rest_position(dofs[node][0]));
    share_out(model.locally_owned());
  }


  /// At rest all edges are straight (SolidModel::mapping()): there nodes are where they would be
  /// without being moved on.
  template <int dim>
  template <class Values>
  void
  BodySurface<dim>::move_on(Values &values) const
  {
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (!corners[node].empty())
        {
          auto mean = values[corners[node].front()];
          for (std::size_t k = 1; k < corners[node].size(); ++k)
            mean += values[corners[node][k]];
          values[node] += moved_on * (values[node] - mean / double(corners[node].size()));
        }
  }


  template <int dim>
  void
  BodySurface<dim>::find_shares()
  {
    all_shares.assign(n_nodes(), {});
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        const auto &around = corners[node];
        all_shares[node].push_back({dofs[node], around.empty() ? 1 : 1 + moved_on});
        for (const unsigned int corner : around)
          all_shares[node].push_back({dofs[corner], -moved_on / around.size()});
      }
  }


  template <int dim>
  BodySurface<dim>::BodySurface(const BodySurface       &all,
                                const PartOfBodies<dim> &part,
                                const Vector            &displacement)
    : BodySurface(all)
  {
    const auto places = all.positions(displacement);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        for (auto &dof : dofs[node])
          dof = part.numbers()[dof];
        if (!moves(node))
          rest_positions[node] = places[node];
      }
    share_out(part.model().locally_owned());
  }


  template <int dim>
  BodySurface<dim>::BodySurface(const BodySurface &all, const Vector &displacement)
    : BodySurface(all)
  {
    rest_positions = all.positions(displacement);
    for (auto &of_node : dofs)
      of_node.fill(dealii::numbers::invalid_dof_index);
    share_out(dealii::IndexSet());
  }


  /// Values of owned degrees of freedom are what ranks tell each other.
  template <int dim>
  void
  BodySurface<dim>::share_out(const dealii::IndexSet &owned)
  {
    find_shares();
    slots.clear();
    counts.clear();
    first.clear();
    std::vector<unsigned int> mine;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (moves(node))
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (owned.is_element(dofs[node][axis]))
            mine.push_back(node * dim + axis);
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, mine))
      {
        first.push_back(slots.size());
        counts.push_back(of_rank.size());
        for (const unsigned int number : of_rank)
          slots.push_back({number / dim, number % dim});
      }
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  BodySurface<dim>::gather(const Vector &vector) const
  {
    const unsigned int  rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::vector<double> mine, all(slots.size());
    for (int k = first[rank]; k < first[rank] + counts[rank]; ++k)
      mine.push_back(vector(dofs[slots[k].node][slots[k].axis]));
    const int ierr = MPI_Allgatherv(mine.data(),
                                    mine.size(),
                                    MPI_DOUBLE,
                                    all.data(),
                                    counts.data(),
                                    first.data(),
                                    MPI_DOUBLE,
                                    communicator);
    AssertThrowMPI(ierr);
    std::vector<dealii::Tensor<1, dim>> result(n_nodes());
    for (unsigned int k = 0; k < slots.size(); ++k)
      result[slots[k].node][slots[k].axis] = all[k];
    move_on(result);
    return result;
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  BodySurface<dim>::positions(const Vector &displacement) const
  {
    auto       result = rest_positions;
    const auto d      = gather(displacement);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      result[node] += d[node];
    return result;
  }


  template <int dim>
  void
  BodySurface<dim>::add(Vector &vector, const std::vector<dealii::Tensor<1, dim>> &values) const
  {
    AssertDimension(values.size(), n_nodes());
    auto shared = values;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (!corners[node].empty())
        {
          const auto more = moved_on * values[node];
          shared[node] += more;
          for (const unsigned int corner : corners[node])
            shared[corner] -= more / double(corners[node].size());
        }
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    for (int k = first[rank]; k < first[rank] + counts[rank]; ++k)
      vector(dofs[slots[k].node][slots[k].axis]) += shared[slots[k].node][slots[k].axis];
    vector.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  void
  BodySurface<dim>::add_derivative(Matrix                       &matrix,
                                   const unsigned int            node,
                                   const unsigned int            moved,
                                   const unsigned int            axis,
                                   const dealii::Tensor<1, dim> &change) const
  {
    for (const auto &row : shares(node))
      for (unsigned int i = 0; i < dim; ++i)
        if (matrix.in_local_range(row.dofs[i]) && change[i] != 0)
          for (const auto &column : shares(moved))
            matrix.add(row.dofs[i], column.dofs[axis], row.weight * column.weight * change[i]);
  }


  template class BodySurface<2>;
  template class BodySurface<3>;
} // namespace undine
