// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_convective_entries_h
#define undine_fluid_viscosity_convective_entries_h

#include <undine/fluid/convection/dual_fluxes.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <functional>
#include <vector>

namespace undine
{
  /// Where in a matrix the fluxes between places go that DualFluxes::for_each_between() visits, so
  /// that no row has to be searched in every stage.
  template <int dim>
  class ConvectiveEntries
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;

    static constexpr int none = -1;

    /// A flux from one unknown to another. Rows and places in them are this rank's.
    struct Pair
    {
      int                           from = none; ///< none: not both are unknowns of this rank
      int                           to   = none;
      std::array<unsigned short, 4> places{}; ///< of (from, from), (from, to), (to, from), (to, to)
    };

    /// local(place): this rank's row of an unknown, or none.
    using Local = std::function<int(const FacePlace<dim> &)>;

    /// The pairs of an axis, for a matrix that has an entry for each of them.
    void
    find(const DualFluxes<dim> &fluxes,
         unsigned int           axis,
         const Matrix          &matrix,
         const Local           &local);

    /// Nothing is known any more.
    void
    clear()
    {
      pairs.clear();
    }

    bool
    empty() const
    {
      return pairs.empty();
    }

    /// In the order of DualFluxes::for_each_between().
    const Pair &
    operator[](const std::size_t k) const
    {
      return pairs[k];
    }

    std::size_t
    memory_consumption() const
    {
      return pairs.capacity() * sizeof(Pair);
    }

  private:
    std::vector<Pair> pairs;
  };


  /// Pointers to the values of all rows of this rank.
  std::vector<double *>
  rows_of(dealii::TrilinosWrappers::SparseMatrix &matrix);
} // namespace undine

#endif
