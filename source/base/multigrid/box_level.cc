// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/multigrid/multigrid_level.h>
#include <undine/base/multigrid/stencil_rows.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace undine
{
  namespace
  {
    using Position = std::ptrdiff_t;
    using Indices  = std::array<int, 3>;


    /// The unknowns of this rank as points of a box in `n` directions.
    template <int n>
    class BoxOfUnknowns
    {
    public:
      /// Of the box in an array with one layer around it; nothing if the unknowns are no such
      /// points, the first direction running fastest.
      static std::optional<BoxOfUnknowns>
      find(const CellEquations &equations);

      /// The neighbour that an unknown is coupled to.
      struct Neighbour
      {
        unsigned int direction;
        int          step;     ///< 1: above; -1: below
        bool         is_owned; ///< and in the box on this side
      };

      /// Nothing if it is none.
      std::optional<Neighbour>
      neighbour(const CellEquations &equations, unsigned int i, unsigned int j) const;

      Indices
      indices(unsigned int i) const;

      Position
      position(const Indices &indices) const;

      BoxInArray<n> box;
      Position      size; ///< of the array

    private:
      Indices lengths;
    };


    template <int n>
    std::optional<BoxOfUnknowns<n>>
    BoxOfUnknowns<n>::find(const CellEquations &equations)
    {
      BoxOfUnknowns                   result;
      std::array<std::vector<int>, 3> beginnings;
      std::size_t                     product = 1;
      for (unsigned int axis = 0; axis < 3; ++axis)
        {
          std::set<int> all;
          for (unsigned int i = 0; i < equations.n_owned(); ++i)
            all.insert(equations.boxes[i].lower[axis]);
          beginnings[axis].assign(all.begin(), all.end());
          result.lengths[axis] = all.size();
          product *= all.size();
          if (axis >= n && all.size() > 1)
            return {};
        }
      if (product != equations.n_owned())
        return {};
      result.box.parity = 0;
      result.box.first  = 0;
      result.size       = 1;
      for (int axis = 0; axis < n; ++axis)
        {
          result.box.lengths[axis] = result.lengths[axis];
          result.box.strides[axis] = result.size;
          result.box.first += result.size;
          result.size *= result.lengths[axis] + 2;
        }
      for (unsigned int i = 0; i < equations.n_owned(); ++i)
        for (unsigned int axis = 0; axis < 3; ++axis)
          if (equations.boxes[i].lower[axis] != beginnings[axis][result.indices(i)[axis]])
            return {};
      return result;
    }


    template <int n>
    Indices
    BoxOfUnknowns<n>::indices(const unsigned int i) const
    {
      const int number = i;
      return {
        {number % lengths[0], number / lengths[0] % lengths[1], number / lengths[0] / lengths[1]}};
    }


    template <int n>
    Position
    BoxOfUnknowns<n>::position(const Indices &indices) const
    {
      Position result = box.first;
      for (int axis = 0; axis < n; ++axis)
        result += indices[axis] * box.strides[axis];
      return result;
    }


    template <int n>
    std::optional<typename BoxOfUnknowns<n>::Neighbour>
    BoxOfUnknowns<n>::neighbour(const CellEquations &equations,
                                const unsigned int   i,
                                const unsigned int   j) const
    {
      const auto                 &here = equations.boxes[i], &there = equations.boxes[j];
      std::optional<unsigned int> across;
      for (unsigned int axis = 0; axis < 3; ++axis)
        if (here.lower[axis] != there.lower[axis] || here.upper[axis] != there.upper[axis])
          {
            if (across || axis >= n)
              return {};
            across = axis;
          }
      if (!across)
        return {};
      const unsigned int axis  = *across;
      const bool         owned = j < equations.n_owned();
      if (here.upper[axis] == there.lower[axis])
        return Neighbour{axis, 1, owned};
      if (here.lower[axis] == there.upper[axis])
        return Neighbour{axis, -1, owned};
      // From one end of a periodic domain to the other. A rank may be one block wide there.
      const int index = indices(i)[axis];
      if (index == lengths[axis] - 1 && there.lower[axis] < here.lower[axis])
        return Neighbour{axis, 1, false};
      if (index == 0 && there.lower[axis] > here.lower[axis])
        return Neighbour{axis, -1, false};
      return {};
    }


    /// Without lists of columns: first the unknowns whose indices have an even sum, then the
    /// others.
    template <int n>
    class BoxLevel : public MultigridLevel
    {
    public:
      static std::unique_ptr<const MultigridLevel>
      make(const CellEquations &equations);

      void
      relax_from_zero(Vector &x, const Vector &b) const override;

      void
      restrict_residual(Vector                 &coarse_b,
                        Vector                 &x,
                        const std::vector<int> &aggregates) const override;

      void
      relax_backward(Vector &x, const Vector &b) const override;

      std::size_t
      memory_consumption() const override;

    private:
      explicit BoxLevel(const BoxOfUnknowns<n> &unknowns);

      bool
      fill(const CellEquations &equations, const BoxOfUnknowns<n> &unknowns);

      void
      copy_to_box(std::vector<float> &values, const Vector &vector) const;

      void
      copy_from_box(Vector &vector, const std::vector<float> &values) const;

      void
      copy_ghosts(const Vector &x) const;

      static constexpr float omega = n == 3 ? 1.2f : 1.05f;

      BoxInArray<n>                                  box;
      std::array<std::vector<float>, n>              above; ///< entries to the next unknown
      StencilEntries<n, float>                       entries;
      std::vector<float>                             diagonal, inverse_diagonal;
      std::vector<std::pair<unsigned int, Position>> around; ///< unknowns in the layer around it
      mutable std::vector<float>                     values, right_side;
    };


    template <int n>
    BoxLevel<n>::BoxLevel(const BoxOfUnknowns<n> &unknowns)
      : box(unknowns.box)
    {
      for (auto *array : {&diagonal, &inverse_diagonal, &values, &right_side})
        array->assign(unknowns.size, 0.f);
      for (int d = 0; d < n; ++d)
        {
          above[d].assign(unknowns.size, 0.f);
          entries.above[d] = above[d].data();
          entries.below[d] = above[d].data() - box.strides[d];
        }
    }


    template <int n>
    std::unique_ptr<const MultigridLevel>
    BoxLevel<n>::make(const CellEquations &equations)
    {
      const auto unknowns = BoxOfUnknowns<n>::find(equations);
      if (!unknowns)
        return nullptr;
      std::unique_ptr<BoxLevel> result(new BoxLevel(*unknowns));
      if (!result->fill(equations, *unknowns))
        return nullptr;
      return result;
    }


    /// False if an unknown is coupled to others than its neighbours.
    template <int n>
    bool
    BoxLevel<n>::fill(const CellEquations &equations, const BoxOfUnknowns<n> &unknowns)
    {
      std::set<std::pair<unsigned int, Position>> layer;
      for (unsigned int i = 0; i < equations.n_owned(); ++i)
        {
          const auto here = unknowns.position(unknowns.indices(i));
          // An unknown without an equation has no right-hand side either.
          diagonal[here]         = static_cast<float>(equations.diagonal(i));
          inverse_diagonal[here] = diagonal[here] > 0 ? 1 / diagonal[here] : 0.f;
          for (std::size_t k = equations.row_begins[i]; k < equations.row_begins[i + 1]; ++k)
            {
              const auto &entry = equations.entries[k];
              const auto  next  = unknowns.neighbour(equations, i, entry.column);
              if (!next)
                return false;
              const auto stride = box.strides[next->direction];
              if (!next->is_owned)
                layer.emplace(entry.column, here + next->step * stride);
              above[next->direction][next->step > 0 ? here : here - stride] =
                static_cast<float>(entry.rest - entry.coupling);
            }
        }
      around.assign(layer.begin(), layer.end());
      return true;
    }


    template <int n>
    void
    BoxLevel<n>::copy_to_box(std::vector<float> &values, const Vector &vector) const
    {
      const float *from = vector.begin();
      box.for_each_row([&](const Position row, const int) {
        std::copy_n(from, box.lengths[0], values.data() + row);
        from += box.lengths[0];
      });
    }


    template <int n>
    void
    BoxLevel<n>::copy_from_box(Vector &vector, const std::vector<float> &values) const
    {
      float *to = vector.begin();
      box.for_each_row([&](const Position row, const int) {
        to = std::copy_n(values.data() + row, box.lengths[0], to);
      });
    }


    template <int n>
    void
    BoxLevel<n>::copy_ghosts(const Vector &x) const
    {
      for (const auto &[unknown, position] : around)
        values[position] = x.local_element(unknown);
    }


    template <int n>
    void
    BoxLevel<n>::relax_from_zero(Vector &x, const Vector &b) const
    {
      copy_to_box(right_side, b);
      for (const auto &[unknown, position] : around)
        values[position] = 0;
      box.for_each_row([&](const Position row, const int parity) {
        for (int i = 0; i < box.lengths[0]; ++i)
          values[row + i] =
            (parity + i) % 2 == 0 ? omega * inverse_diagonal[row + i] * right_side[row + i] : 0.f;
      });
      relax(values.data(), right_side.data(), inverse_diagonal.data(), entries, box, 1, omega);
      copy_from_box(x, values);
    }


    template <int n>
    void
    BoxLevel<n>::restrict_residual(Vector                 &coarse_b,
                                   Vector                 &x,
                                   const std::vector<int> &aggregates) const
    {
      x.update_ghost_values();
      copy_ghosts(x);
      coarse_b                     = 0.f;
      float *const       sums      = coarse_b.begin();
      const int         *aggregate = aggregates.data();
      std::vector<float> residual(box.lengths[0]);
      box.for_each_row([&](const Position row, const int) {
        subtract_neighbours(residual.data(), right_side.data(), values.data(), entries, box, row);
        for (int i = 0; i < box.lengths[0]; ++i, ++aggregate)
          if (*aggregate >= 0)
            sums[*aggregate] += residual[i] - diagonal[row + i] * values[row + i];
      });
    }


    template <int n>
    void
    BoxLevel<n>::relax_backward(Vector &x, const Vector &) const
    {
      x.update_ghost_values();
      copy_to_box(values, x);
      copy_ghosts(x);
      for (const int parity : {1, 0})
        relax(
          values.data(), right_side.data(), inverse_diagonal.data(), entries, box, parity, omega);
      copy_from_box(x, values);
    }


    template <int n>
    std::size_t
    BoxLevel<n>::memory_consumption() const
    {
      return (n + 4) * values.capacity() * sizeof(float) +
             around.capacity() * sizeof(around.front());
    }
  } // namespace


  std::unique_ptr<const MultigridLevel>
  make_box_level(const CellEquations &equations)
  {
    const bool is_plane = (*equations.planes)[2].size() == 2;
    return is_plane ? BoxLevel<2>::make(equations) : BoxLevel<3>::make(equations);
  }
} // namespace undine
