// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/activation_distances.h>
#include <undine/contact/contact_boxes.h>
#include <undine/surface/nearest_in_simplex.h>
#include <undine/surface/nearest_of_edges.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Of the distance at rest, for what belongs together.
    constexpr double share_of_rest = 0.5;

    /// What is not in front of a facet at rest is met from so many D on: material between the two
    /// may be squeezed to a fifth.
    constexpr double squeezed = 5;

    /// Sine of the angle with a facet from which on a place is in front of it.
    constexpr double sine_of_front = 0.5;


    template <int dim>
    NearestInSimplex<dim>
    nearest_at_rest(const ContactSurfaces<dim> &surfaces,
                    const unsigned int          node,
                    const unsigned int          facet)
    {
      Simplex<dim>                        simplex;
      std::array<dealii::Point<dim>, dim> corners;
      simplex.n = dim;
      for (unsigned int k = 0; k < dim; ++k)
        {
          simplex.nodes[k] = k;
          corners[k]       = surfaces.rest()[surfaces.surface().facets()[facet][k]];
        }
      return nearest_in_simplex<dim>(simplex, corners, surfaces.rest()[node]);
    }


    /// Does a place that is `from` away from a surface at rest [m] meet it?
    template <int dim>
    bool
    meets(const dealii::Tensor<1, dim> &from,
          const dealii::Tensor<1, dim> &outwards,
          const double                  activation_distance)
    {
      return from.norm() >= squeezed * activation_distance ||
             from * outwards >= sine_of_front * from.norm();
    }
  } // namespace


  template <int dim>
  ActivationDistances<dim>::ActivationDistances(const ContactSurfaces<dim> &surfaces,
                                                const double                general)
    : surfaces(surfaces)
    , general(general)
    , own(surfaces.bodies().n_nodes(), general)
  {
    for_each_near_own_pair<dim>(
      surfaces,
      surfaces.rest(),
      surfaces.rest(),
      general / share_of_rest,
      [&](const unsigned int node, const unsigned int facet) {
        if (meets_own(node, facet))
          own[node] =
            std::min(own[node], share_of_rest * nearest_at_rest(surfaces, node, facet).distance);
      });
  }


  template <int dim>
  ActivationDistances<dim>::ActivationDistances(const ActivationDistances  &all,
                                                const ContactSurfaces<dim> &surfaces)
    : surfaces(surfaces)
    , general(all.general)
    , own(all.own)
  {
  }


  template <int dim>
  bool
  ActivationDistances<dim>::meets_own(const unsigned int node, const unsigned int facet) const
  {
    const auto &corners = surfaces.surface().facets()[facet];
    if (std::find(corners.begin(), corners.end(), node) != corners.end())
      return false;
    const auto normal = area_vector(surfaces.surface(), facet, surfaces.rest());
    return meets<dim>(nearest_at_rest(surfaces, node, facet).from, normal / normal.norm(), general);
  }


  template <int dim>
  double
  ActivationDistances<dim>::of_wall(const unsigned int node, const unsigned int wall) const
  {
    return surfaces.is_fixed_at(surfaces.surface_of_node(node), wall)
             ? std::min(general, share_of_rest * surfaces.rest_gap(node, wall))
             : general;
  }


  template <int dim>
  double
  ActivationDistances<dim>::of_own_edges(const unsigned int one, const unsigned int other) const
  {
    const auto                       &a = surfaces.sharp_edges()[one];
    const auto                       &b = surfaces.sharp_edges()[other];
    std::array<dealii::Point<dim>, 4> x;
    for (unsigned int i = 0; i < 2; ++i)
      {
        x[i]     = surfaces.rest()[a.nodes[i]];
        x[2 + i] = surfaces.rest()[b.nodes[i]];
      }
    const auto             nearest = nearest_of_edges<dim>(x);
    dealii::Tensor<1, dim> outwards; // of the second edge, seen from both
    for (unsigned int axis = 0; axis < dim; ++axis)
      outwards[axis] = 0.5 * (b.outwards[axis] - a.outwards[axis]);
    return meets<dim>(nearest.from, outwards, general)
             ? std::min(general, share_of_rest * nearest.distance)
             : 0.;
  }


  template class ActivationDistances<2>;
  template class ActivationDistances<3>;
} // namespace undine
