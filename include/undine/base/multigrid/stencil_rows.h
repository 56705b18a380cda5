// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_multigrid_stencil_rows_h
#define undine_base_multigrid_stencil_rows_h

#include <array>
#include <cstddef>
#include <vector>

namespace undine
{
  /// The points of a box of a grid in `n` directions, in an array with room around them, the first
  /// direction running fastest.
  template <int n>
  struct BoxInArray
  {
    std::array<int, n>            lengths; ///< points in each direction
    std::array<std::ptrdiff_t, n> strides; ///< from a point to the next one
    std::ptrdiff_t                first;   ///< position of the first point
    int                           parity;  ///< of the sum of its indices on the grid, 0 or 1

    /// Call `action(position, parity)` for the first point of every row along the first direction.
    template <class Action>
    void
    for_each_row(const Action &action) const;
  };


  /// The entries of a matrix whose rows couple points of a box to their neighbours only,
  ///
  ///     (A x)_i = d_i x_i + sum_k (a_ki x_(i + e_k) + b_ki x_(i - e_k)),
  ///
  /// in arrays with the positions of BoxInArray. Wherever there is no neighbour, an entry is zero
  /// and the value in its place finite.
  template <int n, typename Number>
  struct StencilEntries
  {
    std::array<const Number *, n> above; ///< a
    std::array<const Number *, n> below; ///< b
  };


  /// result_i := b_i - sum_k (a_ki x_(i + e_k) + b_ki x_(i - e_k)) in a row that begins at
  /// `position`; `result` begins with it.
  template <int n, typename Number>
  void
  subtract_neighbours(Number                          *result,
                      const Number                    *b,
                      const Number                    *x,
                      const StencilEntries<n, Number> &entries,
                      const BoxInArray<n>             &box,
                      std::ptrdiff_t                   position);


  /// Half a sweep of red-black relaxation: x_i := x_i + omega ((b_i - sum of neighbours)/d_i - x_i)
  /// at all points whose indices have a sum of one parity.
  template <int n>
  void
  relax(float                          *x,
        const float                    *b,
        const float                    *inverse_diagonal,
        const StencilEntries<n, float> &entries,
        const BoxInArray<n>            &box,
        int                             parity,
        float                           omega);


  template <int n>
  template <class Action>
  void
  BoxInArray<n>::for_each_row(const Action &action) const
  {
    std::array<int, n> index{};
    for (int d = 0; d < n; ++d)
      if (lengths[d] <= 0)
        return;
    for (int d = 1; d <= n;)
      {
        std::ptrdiff_t position = first;
        int            sum      = parity;
        for (int k = 1; k < n; ++k)
          {
            position += index[k] * strides[k];
            sum += index[k];
          }
        action(position, sum % 2);
        for (d = 1; d < n && ++index[d] == lengths[d]; ++d)
          index[d] = 0;
        if (d == n)
          return;
      }
  }
} // namespace undine

#endif
