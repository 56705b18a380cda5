// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/index_box.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/face_facets.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>

#include <unordered_map>

namespace undine
{
  namespace
  {
    // A quadratic element's node between corners: moved on from their mean by how much of its
    // distance from it.
    constexpr double moved_on = 1. / 3;

    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;


    /// The lattice of a quadratic element.
    template <int dim>
    IndexBox<dim>
    lattice()
    {
      return {{}, all_directions<dim>(3)};
    }


    /// The corners of the element that lie around a point of the lattice, those of the edge or face
    /// in which it lies; none for a corner.
    template <int dim>
    std::vector<unsigned int>
    corners_around(const unsigned int point)
    {
      std::vector<unsigned int> result;
      GridIndex<dim>            place;
      IndexBox<dim>             ends{{}, all_directions<dim>(1)}; // 0 and 1 where it is between
      for (unsigned int d = 0, rest = point; d < dim; ++d, rest /= 3)
        {
          place[d] = rest % 3;
          if (place[d] == 1)
            ends.upper[d] = 2;
        }
      if (ends.size() == 1)
        return {};
      for_each(ends, [&](const GridIndex<dim> &end) {
        auto corner = place;
        for (unsigned int d = 0; d < dim; ++d)
          if (ends.upper[d] == 2)
            corner[d] = 2 * end[d];
        result.push_back(lattice<dim>().position(corner));
      });
      return result;
    }


    /// For each point of the lattice its degree of freedom in the cell, by axis; `none` if it is
    /// not a node of the element.
    template <int dim>
    std::vector<std::array<unsigned int, dim>>
    dofs_of_lattice(const dealii::FiniteElement<dim> &element)
    {
      const auto lexicographic =
        dealii::FETools::hierarchic_to_lexicographic_numbering<dim>(element.degree);
      std::array<unsigned int, dim> no_dofs;
      no_dofs.fill(none);
      std::vector<std::array<unsigned int, dim>> result(lattice<dim>().size(), no_dofs);
      for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
        {
          const auto     component = element.system_to_component_index(i);
          GridIndex<dim> point;
          for (unsigned int d = 0, rest = lexicographic[component.second]; d < dim;
               ++d, rest /= element.degree + 1)
            point[d] = rest % (element.degree + 1) * (2 / element.degree);
          result[lattice<dim>().position(point)][component.first] = i;
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
    const auto  dofs_of_points = dofs_of_lattice<dim>(element);
    const auto  facets_of_face = facets_of_element<dim>(element.degree);

    std::vector<std::array<Index, dim>>          dofs;
    std::vector<Corners>                         corners;
    std::unordered_map<Index, unsigned int>      nodes; // by the degree of freedom of axis 0
    std::vector<typename Surface<dim>::Facet>    facets;
    std::vector<unsigned int>                    body_of_facet;
    std::vector<std::string>                     names;
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    std::vector<unsigned int>                    numbers; // of nodes, by point
    const auto                                   node_at = [&](const unsigned int point) {
      const auto &dofs_in_cell = dofs_of_points[point];
      const bool  is_own       = dofs_in_cell[0] != none;
      if (numbers[point] == none && is_own)
        numbers[point] = nodes.emplace(indices[dofs_in_cell[0]], dofs.size()).first->second;
      else if (numbers[point] == none)
        numbers[point] = dofs.size();
      if (numbers[point] == dofs.size())
        {
          dofs.emplace_back();
          dofs.back().fill(dealii::numbers::invalid_dof_index);
          for (unsigned int axis = 0; is_own && axis < dim; ++axis)
            dofs.back()[axis] = indices[dofs_in_cell[axis]];
        }
      return numbers[point];
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
                  numbers.assign(dofs_of_points.size(), none);
                  for (const auto &facet : facets_of_face[face])
                    {
                      body_of_facet.push_back(body);
                      facets.emplace_back();
                      for (unsigned int k = 0; k < dim; ++k)
                        facets.back()[k] = node_at(facet[k]);
                    }
                  corners.resize(dofs.size());
                  for (unsigned int point = 0; point < numbers.size(); ++point)
                    if (numbers[point] != none)
                      {
                        corners[numbers[point]].clear();
                        for (const unsigned int corner : corners_around<dim>(point))
                          corners[numbers[point]].push_back(node_at(corner));
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
      {
        own_weights.push_back(!has_dofs(node) ? 0 : corners[node].empty() ? 1 : 1 + moved_on);
        rest_positions.push_back(has_dofs(node) ? model.rest_position(dofs[node][0])
                                                : dealii::Point<dim>());
      }
    // At rest all edges are straight (SolidModel::mapping()), so that only means are missing.
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (!has_dofs(node))
        rest_positions[node] = dealii::Point<dim>(mean_of_corners(node, rest_positions));
    share_out(model.locally_owned());
  }


  template <int dim>
  template <class Value>
  dealii::Tensor<1, dim>
  BodySurface<dim>::mean_of_corners(const unsigned int node, const std::vector<Value> &values) const
  {
    dealii::Tensor<1, dim> sum;
    for (const unsigned int corner : corners[node])
      sum += values[corner];
    return sum / double(corners[node].size());
  }
  template <int dim>
  void
  BodySurface<dim>::find_shares()
  {
    all_shares.assign(n_nodes(), {});
    for (unsigned int node = 0; node < n_nodes(); ++node)
      {
        if (has_dofs(node))
          all_shares[node].push_back({dofs[node], own_weights[node]});
        for (const unsigned int corner : corners[node])
          if (has_dofs(corner))
            all_shares[node].push_back(
              {dofs[corner], (1 - own_weights[node]) / corners[node].size()});
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
          if (dof != dealii::numbers::invalid_dof_index)
            dof = part.numbers()[dof];
      }
    share_out(part.model().locally_owned());
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (!moves(node))
        rest_positions[node] = places[node];
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
      if (has_dofs(node))
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
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (own_weights[node] != 1)
        result[node] += (own_weights[node] - 1) * (result[node] - mean_of_corners(node, result));
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
      if (own_weights[node] != 1)
        {
          const auto more = (own_weights[node] - 1) * values[node];
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
  BodySurface<dim>::add_derivatives(Matrix                              &matrix,
                                    const std::array<unsigned int, dim> &nodes,
                                    const FacetMatrices                 &changes) const
  {
    // Each degree of freedom once, although nodes share corners: entries cost most.
    std::vector<Index> own;
    const auto         place = [&](const Share &share) -> unsigned int {
      const auto found  = std::find(own.begin(), own.end(), share.dofs[0]);
      const auto result = found - own.begin();
      if (found == own.end())
        own.insert(own.end(), share.dofs.begin(), share.dofs.end());
      return result;
    };
    std::array<std::vector<unsigned int>, dim> places;
    for (unsigned int k = 0; k < dim; ++k)
      for (const auto &share : shares(nodes[k]))
        places[k].push_back(place(share));

    dealii::FullMatrix<double> values(own.size());
    for (unsigned int k = 0; k < dim; ++k)
      for (std::size_t r = 0; r < places[k].size(); ++r)
        for (unsigned int m = 0; m < dim; ++m)
          for (std::size_t c = 0; c < places[m].size(); ++c)
            {
              const double weight = shares(nodes[k])[r].weight * shares(nodes[m])[c].weight;
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int axis = 0; axis < dim; ++axis)
                  values(places[k][r] + i, places[m][c] + axis) += weight * changes[k][m][i][axis];
            }
    for (unsigned int row = 0; row < own.size(); ++row)
      if (matrix.in_local_range(own[row]))
        matrix.add(own[row], own.size(), own.data(), &values(row, 0));
  }


  template class BodySurface<2>;
  template class BodySurface<3>;
} // namespace undine
