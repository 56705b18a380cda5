// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_passage_check_h
#define undine_contact_passage_check_h

#include <undine/contact/contact_surfaces.h>
#include <undine/contact/domain_walls.h>

#include <string>
#include <vector>

namespace undine
{
  /// Whether bodies keep to where they can be, where contact does not see to that: they do not pass
  /// walls of the fluid's domain nor enter obstacles. What a support holds there, or what reaches
  /// there at rest, may; the latter through walls only where it does.
  template <int dim>
  class PassageCheck
  {
  public:
    using Positions = typename ContactSurfaces<dim>::Positions;
    using Vector    = typename ContactSurfaces<dim>::Vector;

    /// What is checked.
    struct Scope
    {
      bool sides     = true; ///< walls of the domain
      bool obstacles = true;
      bool contact   = false; ///< is there contact? For hints.
    };

    /// `obstacles`: nullptr if there are none. The references must outlive it. Collective.
    PassageCheck(const SolidModel<dim> &solid,
                 const FluidModel<dim> &fluid,
                 const Obstacles<dim>  *obstacles,
                 const Scope           &scope);

    /// What is wrong at the end of straight paths of all nodes from the displacement `from` to `to`
    /// [m], at `time` [s]: which body is where, and what to try. Empty if nothing is. Collective.
    std::string
    complaint(const Vector &from, const Vector &to, double time) const;

  private:
    std::string
    side_complaint(const Positions &from, const Positions &to) const;
    std::string
    obstacle_complaint(const Positions &places) const;
    void
    find_facets_in_walls();
    bool
    is_beside(const unsigned int wall, const unsigned int node, const Positions &places) const;
    bool
    passes(const DomainWall<dim>    &wall,
           const dealii::Point<dim> &from,
           const dealii::Point<dim> &to) const;

    const FluidModel<dim>             &fluid;
    const Scope                        scope;
    const std::vector<DomainWall<dim>> walls;
    const ContactSurfaces<dim>         surfaces;
    std::vector<std::vector<bool>>     in_each_other; ///< at rest: [surface][surface]

    /// Where a body reaches through a wall at rest.
    struct Opening
    {
      std::vector<unsigned int> nodes;      ///< of the facets that cross the wall
      double                    length = 0; ///< of their longest edge [m]
    };
    std::vector<std::vector<Opening>> openings; ///< [wall][body]
  };
} // namespace undine

#endif
