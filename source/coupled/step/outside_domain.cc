// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/outside_domain.h>

#include <deal.II/base/bounding_box.h>

namespace undine
{
  template <int dim>
  std::string
  note_of_what_is_outside(const Models<dim> &models, const std::vector<dealii::Point<dim>> &places)
  {
    const auto                                  &surface = models.surface->surface();
    const auto                                  &grid    = models.fluid->grid();
    const dealii::BoundingBox<dim>               domain({grid.lower(), grid.upper()});
    std::vector<std::vector<dealii::Point<dim>>> nodes(surface.body_names().size());
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (const unsigned int node : surface.facets()[facet])
        nodes[surface.body(facet)].push_back(places[node]);
    std::string names;
    for (std::size_t b = 0; b < nodes.size(); ++b)
      if (!nodes[b].empty() && domain.get_neighbor_type(dealii::BoundingBox<dim>(nodes[b])) ==
                                 dealii::NeighborType::not_neighbors)
        names += (names.empty() ? "'" : ", '") + surface.body_names()[b] + "'";
    return names.empty() ? "" : "nowhere in the domain, where no fluid meets it: " + names + ".";
  }


  template std::string
  note_of_what_is_outside(const Models<2> &, const std::vector<dealii::Point<2>> &);
  template std::string
  note_of_what_is_outside(const Models<3> &, const std::vector<dealii::Point<3>> &);
} // namespace undine
