// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/multigrid/multigrid_level.h>

namespace undine
{
  namespace
  {
    /// Row by row, with lists of columns.
    class ListedLevel : public MultigridLevel
    {
    public:
      explicit ListedLevel(const CellEquations &equations);

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
      /// Beginnings of rows in `columns` and `values`: first those of owned unknowns before this
      /// one, then all others.
      struct Row
      {
        unsigned int begin;
        unsigned int after;
      };

      std::vector<Row>          rows; ///< one more than unknowns
      std::vector<unsigned int> columns;
      std::vector<float>        values;
      std::vector<float>        inverse_diagonal;
    };


    ListedLevel::ListedLevel(const CellEquations &equations)
    {
      const unsigned int n = equations.n_owned();
      rows.reserve(n + 1);
      inverse_diagonal.reserve(n);
      columns.reserve(equations.entries.size());
      values.reserve(equations.entries.size());
      for (unsigned int i = 0; i < n; ++i)
        {
          Row        row{static_cast<unsigned int>(columns.size()), 0};
          const auto add_those = [&](const bool before) {
            for (std::size_t k = equations.row_begins[i]; k < equations.row_begins[i + 1]; ++k)
              if (const auto &entry = equations.entries[k]; (entry.column < i) == before)
                {
                  columns.push_back(entry.column);
                  values.push_back(static_cast<float>(entry.rest - entry.coupling));
                }
          };
          add_those(true);
          row.after = columns.size();
          add_those(false);
          rows.push_back(row);
          // An unknown without an equation has no right-hand side either.
          const double diagonal = equations.diagonal(i);
          inverse_diagonal.push_back(diagonal > 0 ? static_cast<float>(1 / diagonal) : 0.f);
        }
      rows.push_back({static_cast<unsigned int>(columns.size()), 0});
    }


    /// sum_k values[k] x[columns[k]]
    inline float
    sum(const float        *values,
        const unsigned int *columns,
        const unsigned int  begin,
        const unsigned int  end,
        const float        *x)
    {
      float result = 0;
      for (unsigned int k = begin; k < end; ++k)
        result += values[k] * x[columns[k]];
      return result;
    }


    void
    ListedLevel::relax_from_zero(Vector &x_, const Vector &b_) const
    {
      float *const       x = x_.begin();
      const float *const b = b_.begin();
      for (unsigned int i = 0; i < inverse_diagonal.size(); ++i)
        x[i] = inverse_diagonal[i] *
               (b[i] - sum(values.data(), columns.data(), rows[i].begin, rows[i].after, x));
    }


    void
    ListedLevel::restrict_residual(Vector                 &coarse_b,
                                   Vector                 &x,
                                   const std::vector<int> &aggregates) const
    {
      x.update_ghost_values();
      coarse_b              = 0.f;
      float *const residual = coarse_b.begin();
      // What relaxation has left of row i is the part of later columns.
      for (unsigned int i = 0; i < inverse_diagonal.size(); ++i)
        if (aggregates[i] >= 0)
          residual[aggregates[i]] -=
            sum(values.data(), columns.data(), rows[i].after, rows[i + 1].begin, x.begin());
    }


    void
    ListedLevel::relax_backward(Vector &x_, const Vector &b_) const
    {
      x_.update_ghost_values();
      float *const       x = x_.begin();
      const float *const b = b_.begin();
      for (unsigned int i = inverse_diagonal.size(); i-- > 0;)
        x[i] = inverse_diagonal[i] *
               (b[i] - sum(values.data(), columns.data(), rows[i].begin, rows[i + 1].begin, x));
    }


    std::size_t
    ListedLevel::memory_consumption() const
    {
      return rows.capacity() * sizeof(Row) + columns.capacity() * sizeof(unsigned int) +
             (values.capacity() + inverse_diagonal.capacity()) * sizeof(float);
    }
  } // namespace


  void
  MultigridLevel::prolongate(Vector &x_, const Vector &coarse_x, const std::vector<int> &aggregates)
  {
    float *const       x          = x_.begin();
    const float *const correction = coarse_x.begin();
    for (unsigned int i = 0; i < aggregates.size(); ++i)
      if (aggregates[i] >= 0)
        x[i] += correction[aggregates[i]];
  }


  std::unique_ptr<const MultigridLevel>
  make_multigrid_level(const CellEquations &equations)
  {
    if (auto box = make_box_level(equations))
      return box;
    return std::make_unique<const ListedLevel>(equations);
  }
} // namespace undine
