// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_pattern.h>
#include <undine/solid/assembly/sparse.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Pairs in the pattern for each that is needed: more make it new, with what is needed alone.
    constexpr unsigned int most_unused = 4;
  } // namespace


  template <int dim>
  ContactPattern<dim>::ContactPattern(const SolidModel<dim> &solid, const BodySurface<dim> &surface)
    : solid(solid)
    , surface(surface)
  {
  }


  template <int dim>
  void
  ContactPattern<dim>::make_room(Matrix &A, const Pairs &needed)
  {
    if (needed.empty())
      return;
    if (!std::includes(pairs.begin(), pairs.end(), needed.begin(), needed.end()))
      {
        if (pairs.size() > most_unused * needed.size())
          pairs.clear();
        pairs.insert(needed.begin(), needed.end());
        rebuild(A);
      }
    enlarge(A, larger, places);
  }


  template <int dim>
  void
  ContactPattern<dim>::clear()
  {
    pairs.clear();
  }


  template <int dim>
  void
  ContactPattern<dim>::rebuild(const Matrix &A)
  {
    const auto                    &owned = solid.locally_owned();
    dealii::DynamicSparsityPattern entries(A.m(), A.n(), owned);
    add_entries(entries, A);
    for (const auto &pair : pairs)
      for (const auto &first : surface.shares(pair.first))
        for (const auto &second : surface.shares(pair.second))
          for (const auto a : first.dofs)
            for (const auto b : second.dofs)
              {
                if (owned.is_element(a))
                  entries.add(a, b);
                if (owned.is_element(b))
                  entries.add(b, a);
              }
    dealii::TrilinosWrappers::SparsityPattern pattern;
    pattern.reinit(owned, entries, solid.communicator());
    larger.reinit(pattern);
    places = places_of_entries(A, larger);
  }


  template class ContactPattern<2>;
  template class ContactPattern<3>;
} // namespace undine
