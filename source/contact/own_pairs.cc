// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_boxes.h>
#include <undine/contact/own_pairs.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// In sizes of facets: pairs are found that are so much further apart than where contact
    /// begins.
    constexpr double relative_margin = 0.25;
  } // namespace


  /// Has no node moved by more than half of `margin` [m] since the search, against the mean motion
  /// of its body?
  template <int dim>
  bool
  OwnPairs<dim>::is_known(const Positions &places, const double margin) const
  {
    if (searched_at.empty())
      return false;
    const auto                          n_nodes = surfaces.bodies().n_nodes();
    std::vector<dealii::Tensor<1, dim>> motions(surfaces.n_bodies());
    std::vector<unsigned int>           counts(surfaces.n_bodies());
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        motions[surfaces.surface_of_node(node)] += places[node] - searched_at[node];
        ++counts[surfaces.surface_of_node(node)];
      }
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        const unsigned int body   = surfaces.surface_of_node(node);
        const auto         motion = places[node] - searched_at[node] - motions[body] / counts[body];
        if (!(motion.norm() <= margin / 2))
          return false;
      }
    return true;
  }


  template <int dim>
  void
  OwnPairs<dim>::search(const Positions &from, const Positions &to, const double distance) const
  {
    found = {};
    OwnPairsNearby::Pairs left_out; // of one node
    unsigned int          last        = 0;
    const auto            finish_node = [&] {
      if (!found.facets.empty() && found.facets.back().first == last)
        found.left_out.insert(found.left_out.end(), left_out.begin(), left_out.end());
      left_out.clear();
    };
    for_each_near_own_pair<dim>(
      surfaces, from, to, distance, [&](const unsigned int node, const unsigned int facet) {
        if (node != last)
          finish_node();
        last = node;
        (distances.meets_own(node, facet) ? found.facets : left_out).emplace_back(node, facet);
      });
    finish_node();
    for_each_near_own_edges<dim>(
      surfaces, from, to, distance, [&](const unsigned int one, const unsigned int other) {
        if (distances.of_own_edges(one, other) > 0)
          found.edges.emplace_back(one, other);
      });
  }


  template <int dim>
  const OwnPairsNearby &
  OwnPairs<dim>::nearby(const Positions &from, const Positions &to) const
  {
    const double margin = relative_margin * surfaces.facet_size();
    if (is_known(from, margin) && is_known(to, margin))
      return found;
    searched_at = from;
    if (is_known(to, margin))
      search(from, from, distances.of_others() + margin);
    else
      {
        searched_at.clear();
        search(from, to, distances.of_others());
      }
    return found;
  }


  template class OwnPairs<2>;
  template class OwnPairs<3>;
} // namespace undine
