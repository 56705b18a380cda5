// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_contact_boxes_h
#define undine_contact_contact_boxes_h

#include <undine/contact/contact_surfaces.h>

#include <functional>

namespace undine
{
  /// Calls action(node, facet) for nodes and facets of surfaces that meet each other, whose boxes
  /// around their straight paths from `from` to `to` come as near as `distance` [m]: in ascending
  /// order of nodes, then facets. Surfaces whose boxes are far from all others cost only the
  /// comparison of boxes; for the others facets are found by an R-tree. Not collective.
  template <int dim>
  void
  for_each_near_pair(const ContactSurfaces<dim>                            &surfaces,
                     const typename ContactSurfaces<dim>::Positions        &from,
                     const typename ContactSurfaces<dim>::Positions        &to,
                     double                                                 distance,
                     const std::function<void(unsigned int, unsigned int)> &action);

  /// The same for two sharp edges, by their numbers in ContactSurfaces::sharp_edges(); each pair
  /// once, the lower number first.
  template <int dim>
  void
  for_each_near_edges(const ContactSurfaces<dim>                            &surfaces,
                      const typename ContactSurfaces<dim>::Positions        &from,
                      const typename ContactSurfaces<dim>::Positions        &to,
                      double                                                 distance,
                      const std::function<void(unsigned int, unsigned int)> &action);

  /// The same for pairs of one body's surface, near on their paths against the body's mean motion;
  /// for the facets that the node is a corner of, too.
  template <int dim>
  void
  for_each_near_own_pair(const ContactSurfaces<dim>                            &surfaces,
                         const typename ContactSurfaces<dim>::Positions        &from,
                         const typename ContactSurfaces<dim>::Positions        &to,
                         double                                                 distance,
                         const std::function<void(unsigned int, unsigned int)> &action);

  /// The same for sharp edges of one body without a common node.
  template <int dim>
  void
  for_each_near_own_edges(const ContactSurfaces<dim>                            &surfaces,
                          const typename ContactSurfaces<dim>::Positions        &from,
                          const typename ContactSurfaces<dim>::Positions        &to,
                          double                                                 distance,
                          const std::function<void(unsigned int, unsigned int)> &action);

  /// The same for facets of one body without a common node, at `places`.
  template <int dim>
  void
  for_each_near_own_facets(const ContactSurfaces<dim>                            &surfaces,
                           const typename ContactSurfaces<dim>::Positions        &places,
                           double                                                 distance,
                           const std::function<void(unsigned int, unsigned int)> &action);
} // namespace undine

#endif
