// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/find_overlap.h>
#include <undine/surface/held_pairs.h>
#include <undine/surface/surface_distance.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace undine
{
  namespace
  {
    template <int dim>
    std::string
    written(const dealii::Point<dim> &place)
    {
      return fmt::format("({:.6g})", fmt::join(place.begin_raw(), place.begin_raw() + dim, ", "));
    }


    template <int dim>
    std::string
    wall_complaint(const ContactSurfaces<dim>                     &surfaces,
                   const typename ContactSurfaces<dim>::Positions &places)
    {
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        for (unsigned int wall = 0; wall < surfaces.walls().size(); ++wall)
          {
            const auto        &plane = surfaces.walls()[wall];
            const unsigned int body  = surfaces.surface_of_node(node);
            if (!surfaces.is_fixed_at(body, wall) &&
                !((places[node] - plane.point) * plane.normal > 0))
              return fmt::format("body '{}' is not on the free side of wall '{}' at {}",
                                 surfaces.surface().body_names()[body],
                                 plane.name,
                                 written(places[node]));
          }
      return "";
    }


    /// Whether a node of another surface is in this one.
    template <int dim>
    std::string
    surface_complaint(const ContactSurfaces<dim>                     &surfaces,
                      const typename ContactSurfaces<dim>::Positions &places,
                      const unsigned int                              surface)
    {
      const SurfaceDistance<dim> distance(one_surface(surfaces.surface(), surface), places);
      const auto                 box = distance.box();
      for (unsigned int node = 0; node < places.size(); ++node)
        {
          const unsigned int other = surfaces.surface_of_node(node);
          if (surfaces.meet(surface, other) && box.point_inside(places[node]) &&
              !(distance.nearest(places[node]).distance > 0))
            return fmt::format("'{}' overlaps '{}' at {}",
                               surfaces.surface().body_names()[other],
                               surfaces.surface().body_names()[surface],
                               written(places[node]));
        }
      return "";
    }
  } // namespace


  template <int dim>
  std::string
  find_overlap(const ContactSurfaces<dim>                     &surfaces,
               const typename ContactSurfaces<dim>::Positions &places)
  {
    std::string complaint = wall_complaint(surfaces, places);
    for (unsigned int s = 0; s < surfaces.surface().body_names().size() && complaint.empty(); ++s)
      complaint = surface_complaint(surfaces, places, s);
    return complaint;
  }


  template std::string
  find_overlap(const ContactSurfaces<2> &, const ContactSurfaces<2>::Positions &);
  template std::string
  find_overlap(const ContactSurfaces<3> &, const ContactSurfaces<3>::Positions &);
} // namespace undine
