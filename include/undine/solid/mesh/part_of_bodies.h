// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_part_of_bodies_h
#define undine_solid_mesh_part_of_bodies_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_state.h>

#include <vector>

namespace undine
{
  /// Carries nodal vectors between a model of all bodies and one of some of them, each over the
  /// degrees of freedom that a rank owns there. All functions are collective.
  template <int dim>
  class PartOfBodies
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Index  = typename SolidModel<dim>::Index;

    /// `part` has been made from `all`. Both must outlive it.
    PartOfBodies(const SolidModel<dim> &all, const SolidModel<dim> &part);

    const SolidModel<dim> &
    model() const
    {
      return part;
    }

    /// For each degree of freedom of all bodies its number in the part; invalid_dof_index if it is
    /// not in there.
    const std::vector<Index> &
    numbers() const
    {
      return in_part;
    }

    /// The entries of a vector of all bodies that belong to the part. @{
    Vector
    taken_from(const Vector &of_all) const;
    SolidState
    taken_from(const SolidState &of_all) const;
    /// @}

    /// Overwrite the entries of `of_all` that belong to the part by `of_part`; the others stay. @{
    void
    put_into(Vector &of_all, const Vector &of_part) const;
    void
    put_into(SolidState &of_all, const SolidState &of_part) const;
    /// @}

  private:
    const SolidModel<dim> &all;
    const SolidModel<dim> &part;
    std::vector<Index>     in_part; ///< [degree of freedom of all]
    std::vector<Index>     in_all;  ///< [degree of freedom of the part]
    dealii::IndexSet       read_of_all, read_of_part;
  };
} // namespace undine

#endif
