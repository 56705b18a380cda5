// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/turning_stress.h>

#include <algorithm>

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
    : normals(areas)
    , viscosity(viscosity)
  {
    constexpr double rounding = 1e-9;
    for (auto &normal : normals)
      normal *= -1;
    for (auto &nodes : nodes_of_bodies(surface, n_body_nodes))
      {
        dealii::Tensor<1, dim> sum;
        double                 area = 0, volume = 0;
        for (const unsigned int node : nodes)
          {
            sum += normals[node];
            area += normals[node].norm();
            volume += (positions[node] - positions[nodes.front()]) * normals[node] / dim;
          }
        if (area > 0 && sum.norm() <= rounding * area && volume > 0)
          bodies.push_back({std::move(nodes), volume});
      }
  }


  template <int dim>
  void
  TurningStress<dim>::add_forces(Vectors       &forces,
                                 const Vectors &velocities,
                                 const double   factor) const
  {
    for (const auto &body : bodies)
      {
        dealii::Tensor<2, dim> gradient;
        for (const unsigned int node : body.nodes)
          gradient += outer_product(velocities[node], normals[node]);
        gradient /= body.volume;
        auto stress = transpose(gradient);
        for (unsigned int d = 0; d < dim; ++d)
          stress[d][d] -= trace(gradient);
        for (const unsigned int node : body.nodes)
          forces[node] += factor * viscosity * (stress * normals[node]);
      }
  }


  template class TurningStress<2>;
  template class TurningStress<3>;
} // namespace undine
