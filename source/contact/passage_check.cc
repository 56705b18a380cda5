// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/point_text.h>
#include <undine/contact/find_overlap.h>
#include <undine/contact/passage_check.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace undine
{
  namespace
  {
    template <int dim>
    std::vector<ContactWall<dim>>
    planes(const std::vector<DomainWall<dim>> &walls)
    {
      std::vector<ContactWall<dim>> result;
      for (const auto &wall : walls)
        result.push_back(wall.plane);
      return result;
    }


  } // namespace


  template <int dim>
  PassageCheck<dim>::PassageCheck(const SolidModel<dim> &solid,
                                  const FluidModel<dim> &fluid,
                                  const Obstacles<dim>  *obstacles,
                                  const Scope           &scope)
    : fluid(fluid)
    , scope(scope)
    , walls(scope.sides ? domain_walls(fluid) : std::vector<DomainWall<dim>>())
    , surfaces(planes(walls), solid, obstacles)
    , in_each_other(surfaces.surface().body_names().size())
  {
    find_facets_in_walls();
    for (auto &others : in_each_other)
      others.resize(in_each_other.size());
    for (bool any = scope.obstacles; any;)
      {
        const auto overlap = find_surfaces_that_overlap<dim>(
          surfaces,
          surfaces.rest(),
          surfaces.rounding(),
          [&](const unsigned int a, const unsigned int b) {
            return surfaces.is_body(a) != surfaces.is_body(b) && !in_each_other[a][b];
          });
        any = overlap.has_value();
        if (!any)
          break;
        const unsigned int a = overlap->surface, b = surfaces.surface_of_node(overlap->node);
        in_each_other[a][b] = in_each_other[b][a] = true;
      }
  }


  template <int dim>
  void
  PassageCheck<dim>::find_facets_in_walls()
  {
    const auto &bodies = surfaces.bodies().surface();
    openings.resize(walls.size(), std::vector<Opening>(bodies.body_names().size()));
    for (unsigned int w = 0; w < walls.size(); ++w)
      for (unsigned int facet = 0; facet < bodies.facets().size(); ++facet)
        {
          const auto &nodes = bodies.facets()[facet];
          const auto [least, largest] =
            std::minmax_element(nodes.begin(), nodes.end(), [&](const auto a, const auto b) {
              return surfaces.rest_gap(a, w) < surfaces.rest_gap(b, w);
            });
          if (surfaces.rest_gap(*least, w) >= 0 || surfaces.rest_gap(*largest, w) < 0)
            continue;
          auto &opening = openings[w][bodies.body(facet)];
          opening.nodes.insert(opening.nodes.end(), nodes.begin(), nodes.end());
          for (const unsigned int node : nodes)
            opening.length =
              std::max(opening.length, surfaces.rest()[node].distance(surfaces.rest()[nodes[0]]));
        }
  }


  /// Is the node, along the wall, further from where its body reaches through that than a facet is
  /// long? Bodies may slide through a wall in which they stand.
  template <int dim>
  bool
  PassageCheck<dim>::is_beside(const unsigned int wall,
                               const unsigned int node,
                               const Positions   &places) const
  {
    const auto &opening = openings[wall][surfaces.surface_of_node(node)];
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        if (axis == walls[wall].side.axis)
          continue;
        double lower = std::numeric_limits<double>::infinity(), upper = -lower;
        for (const unsigned int other : opening.nodes)
          for (const double at : {surfaces.rest()[other][axis], places[other][axis]})
            {
              lower = std::min(lower, at);
              upper = std::max(upper, at);
            }
        if (places[node][axis] < lower - opening.length ||
            places[node][axis] > upper + opening.length)
          return true;
      }
    return false;
  }


  /// Does a path lead out of the domain where the side is a wall?
  template <int dim>
  bool
  PassageCheck<dim>::passes(const DomainWall<dim>    &wall,
                            const dealii::Point<dim> &from,
                            const dealii::Point<dim> &to) const
  {
    const double before = (from - wall.plane.point) * wall.plane.normal;
    const double after  = (to - wall.plane.point) * wall.plane.normal;
    if (after >= -surfaces.rounding() || before < -surfaces.rounding())
      return false;
    const double             part  = std::max(before, 0.) / (std::max(before, 0.) - after);
    const dealii::Point<dim> place = from + part * (to - from);
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (axis != wall.side.axis &&
          (place[axis] < fluid.grid().lower()[axis] || place[axis] > fluid.grid().upper()[axis]))
        return false;
    return wall.is_closed || !fluid.boundaries().at(wall.side, place).lets_fluid_pass();
  }


  template <int dim>
  std::string
  PassageCheck<dim>::side_complaint(const Positions &from, const Positions &to) const
  {
    for (unsigned int w = 0; w < walls.size(); ++w)
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        {
          const unsigned int body = surfaces.surface_of_node(node);
          if (!passes(walls[w], from[node], to[node]))
            continue;
          if (surfaces.reaches_through(body, w) ? !is_beside(w, node, to)
                                                : !surfaces.meets_wall(node, w))
            continue;
          const std::string hint =
            !scope.contact
              ? "a subsection 'Effects/contact', which keeps bodies off walls and obstacles, or a "
                "support that holds the body there"
              : fmt::format(
                  "a wall in the plane of that side in 'Effects/contact/Walls': of itself "
                  "contact knows a side only if it is a wall all over");
          return fmt::format(
            "body '{}' passes the wall at side '{}' of the domain, at {}. Try: {}.",
            surfaces.surface().body_names()[body],
            walls[w].plane.name,
            text_of(to[node]),
            hint);
        }
    return "";
  }


  template <int dim>
  std::string
  PassageCheck<dim>::obstacle_complaint(const Positions &places) const
  {
    const auto overlap = find_surfaces_that_overlap<dim>(
      surfaces, places, surfaces.rounding(), [&](const unsigned int a, const unsigned int b) {
        return surfaces.is_body(a) != surfaces.is_body(b) && surfaces.meet(a, b) &&
               !in_each_other[a][b];
      });
    if (!overlap)
      return "";
    const auto  &names = surfaces.surface().body_names();
    unsigned int body = overlap->surface, obstacle = surfaces.surface_of_node(overlap->node);
    if (!surfaces.is_body(body))
      std::swap(body, obstacle);
    return fmt::format("body '{}' runs into obstacle '{}' at {}. Try: a subsection "
                       "'Effects/contact', which keeps bodies off walls and obstacles, or a "
                       "support of the body that begins in the obstacle.",
                       names[body],
                       names[obstacle],
                       text_of(places[overlap->node]));
  }


  template <int dim>
  std::string
  PassageCheck<dim>::complaint(const Vector &from, const Vector &to, const double time) const
  {
    const auto        places = surfaces.positions(to, time);
    const std::string result = side_complaint(surfaces.bodies().positions(from), places);
    return result.empty() && scope.obstacles ? obstacle_complaint(places) : result;
  }


  template class PassageCheck<2>;
  template class PassageCheck<3>;
} // namespace undine
