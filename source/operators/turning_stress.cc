// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/turning_stress.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// The nodes of every body, each once.
    template <int dim>
    std::vector<std::vector<unsigned int>>
    nodes_of_bodies(const Surface<dim> &surface, const unsigned int n_body_nodes)
    {
      std::vector<std::vector<unsigned int>> result(surface.body_names().size());
      for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
        for (const unsigned int node : surface.facets()[facet])
          if (node < n_body_nodes)
            result[surface.body(facet)].push_back(node);
      for (auto &nodes : result)
        {
          std::sort(nodes.begin(), nodes.end());
          nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        }
      return result;
    }
  } // namespace


  template <int dim>
  TurningStress<dim>::TurningStress(const Surface<dim>                    &surface,
                                    const unsigned int                     n_body_nodes,
                                    const std::vector<dealii::Point<dim>> &positions,
                                    const Vectors                         &areas,
                                    const double                           viscosity)
    : viscosity(viscosity)
  {
    // A wet surface is closed if its area vectors cancel, and then bounds as much as the body has.
    constexpr double rounding = 1e-9, same_volume = 1e-3;
    const auto       volumes  = body_volumes(surface, positions);
    auto             nodes_of = nodes_of_bodies(surface, n_body_nodes);
    for (unsigned int b = 0; b < volumes.size(); ++b)
      {
        auto                  &nodes = nodes_of[b];
        dealii::Tensor<1, dim> sum;
        double                 area = 0;
        for (const unsigned int node : nodes)
          {
            sum += areas[node];
            area += areas[node].norm();
          }
        if (area == 0 || sum.norm() > rounding * area)
          continue;
        auto body = measure(std::move(nodes), positions, areas);
        if (body.volume > 0 && std::abs(body.volume - volumes[b]) <= same_volume * volumes[b])
          bodies.push_back(std::move(body));
      }
  }


  template <int dim>
  typename TurningStress<dim>::Body
  TurningStress<dim>::measure(std::vector<unsigned int>              nodes,
                              const std::vector<dealii::Point<dim>> &positions,
                              const Vectors                         &areas)
  {
    Body                   result;
    dealii::Tensor<1, dim> centre;
    double                 sum = 0;
    for (const unsigned int node : nodes)
      {
        result.areas.push_back(areas[node].norm());
        sum += result.areas.back();
        centre += result.areas.back() * dealii::Tensor<1, dim>(positions[node]);
      }
    centre /= sum;
    dealii::SymmetricTensor<2, dim> moments;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      {
        result.arms.push_back(positions[nodes[k]] - centre);
        moments += result.areas[k] * symmetrize(outer_product(result.arms[k], result.arms[k]));
        result.volume -= result.arms[k] * areas[nodes[k]] / dim;
      }
    const auto principal = eigenvectors(moments);
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.axes[d]    = principal[d].second;
        result.moments[d] = principal[d].first;
      }
    for (auto &arm : result.arms)
      arm = result.axes * arm;
    result.nodes = std::move(nodes);
    return result;
  }


  /// The condition for W along the principal axes is (m_i + m_j) W_ij = A_ij.
  template <int dim>
  void
  TurningStress<dim>::add_forces(Vectors       &forces,
                                 const Vectors &velocities,
                                 const double   factor) const
  {
    for (const auto &body : bodies)
      {
        dealii::Tensor<2, dim> angular;
        for (std::size_t k = 0; k < body.nodes.size(); ++k)
          angular +=
            body.areas[k] * outer_product(body.axes * velocities[body.nodes[k]], body.arms[k]);
        angular = angular - transpose(angular);
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            if (i != j)
              angular[i][j] /= std::pow(body.moments[i] + body.moments[j], 2);
        const double size = 2 * factor * viscosity * body.volume;
        for (std::size_t k = 0; k < body.nodes.size(); ++k)
          forces[body.nodes[k]] -=
            size * body.areas[k] * (transpose(body.axes) * (angular * body.arms[k]));
      }
  }


  template class TurningStress<2>;
  template class TurningStress<3>;
} // namespace undine
