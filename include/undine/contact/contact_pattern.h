// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_contact_pattern_h
#define undine_contact_contact_pattern_h

#include <undine/surface/body_surface.h>

#include <set>
#include <utility>
#include <vector>

namespace undine
{
  /// Entries in the bodies' tangent for pairs of nodes in contact, besides those of
  /// SolidModel::matrix(). A pattern once made serves as long as it has places for all pairs that
  /// are asked for, and grows with new ones: while bodies touch, neither it nor the analysis that a
  /// factorisation makes of it has to be made again for every node that comes or goes.
  template <int dim>
  class ContactPattern
  {
  public:
    using Matrix = typename SolidModel<dim>::Matrix;
    using Pairs  = std::set<std::pair<unsigned int, unsigned int>>;

    /// Both must outlive it.
    ContactPattern(const SolidModel<dim> &solid, const BodySurface<dim> &surface);

    /// A, with the entries of SolidModel::matrix(), keeps its values and gets places for these
    /// pairs of nodes of the surface, the same on all ranks. Collective.
    void
    make_room(Matrix &A, const Pairs &needed);

    /// Forget the pattern: there are no entries for pairs.
    void
    clear();

  private:
    void
    rebuild(const Matrix &A);

    const SolidModel<dim>  &solid;
    const BodySurface<dim> &surface;
    Pairs                   pairs;  ///< that the pattern has places for
    Matrix                  larger; ///< with all places
    std::vector<int>        places; ///< in it, of the entries of SolidModel::matrix()
  };
} // namespace undine

#endif
