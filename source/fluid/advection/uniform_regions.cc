// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/uniform_regions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace undine
{
  namespace
  {
    /// Compared to the bit, which is fast: most rows of a field hold one value.
    bool
    are_the_same(const double *values, const double *others, const int n)
    {
      return std::memcmp(values, others, n * sizeof(double)) == 0;
    }


    /// Largest minus smallest of the values that are finite; of all ranks.
    template <int dim>
    double
    range(const Field<dim> &field)
    {
      constexpr double infinity    = std::numeric_limits<double>::infinity();
      double           extremes[2] = {-infinity, -infinity};
      for_each_row(field.owned(), [&](const GridIndex<dim> &row, const int points) {
        const double *values = field.data(row);
        const int     others = are_the_same(values, values + 1, points - 1) ? 1 : points;
        for (int i = 0; i < others; ++i)
          if (std::isfinite(values[i]))
            {
              extremes[0] = std::max(extremes[0], values[i]);
              extremes[1] = std::max(extremes[1], -values[i]);
            }
      });
      dealii::Utilities::MPI::max(extremes, field.lattice().blocks().communicator(), extremes);
      return extremes[0] + extremes[1];
    }


    /// Marks on the points of a box, the first direction running fastest.
    template <int dim>
    class Marks
    {
    public:
      explicit Marks(const IndexBox<dim> &box)
        : box(box)
        , marks(box.size(), 0)
      {
        std::size_t product = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            strides[d] = product;
            product *= box.upper[d] - box.lower[d];
          }
      }

      char *
      at(const GridIndex<dim> &index)
      {
        return marks.data() + box.position(index);
      }

      /// Points whose next one in a direction has another value, by more than `most`, and those.
      void
      mark_differences(const Field<dim> &field, const double most)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            auto pairs = box;
            pairs.upper[d] -= 1;
            const auto next = field.stride(d);
            for_each_row(pairs, [&](const GridIndex<dim> &row, const int points) {
              const double *values = field.data(row);
              char         *mark   = at(row);
              if (are_the_same(values, values + next, points))
                return;
              for (int i = 0; i < points; ++i)
                {
                  const char differs = !(std::abs(values[i + next] - values[i]) <= most);
                  mark[i] |= differs;
                  mark[i + strides[d]] |= differs;
                }
            });
          }
      }

      /// Mark all points up to `width` points away from marked ones. The points within 2n of a
      /// point are those within n of one within n: log2(width) passes.
      void
      spread(const GridIndex<dim> &width)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::size_t slab = strides[d] * (box.upper[d] - box.lower[d]);
            for (std::size_t length = 1; length <= std::size_t(width[d]);)
              {
                const auto shift = std::min(length, width[d] + 1 - length);
                for (std::size_t begin = 0; begin < marks.size(); begin += slab)
                  spread(marks.data() + begin, slab, shift * strides[d]);
                length += shift;
              }
          }
      }

    private:
      /// Ahead and back by the same.
      static void
      spread(char *slab, const std::size_t size, const std::size_t shift)
      {
        for (std::size_t k = 0; k + shift < size; ++k)
          slab[k] |= slab[k + shift];
        for (std::size_t k = size; k-- > shift;)
          slab[k] |= slab[k - shift];
      }

      const IndexBox<dim>          box;
      std::array<std::size_t, dim> strides;
      std::vector<char>            marks;
    };
  } // namespace


  template <int dim>
  UniformRegions<dim>::UniformRegions(const std::vector<Field<dim>> &sources,
                                      const GridIndex<dim>          &reach,
                                      const double                   share,
                                      const SubLattice<dim>         *now)
    : owned(sources.front().owned())
    , is_uniform(owned.size(), 0)
  {
    int longest_path = 0; // from neighbour to neighbour, across all that is within reach
    for (unsigned int d = 0; d < dim; ++d)
      longest_path += 2 * reach[d];
    const auto &like = sources.front();
    Marks<dim>  varying(like.stored());
    for (const auto &source : sources)
      varying.mark_differences(source, share * range(source) / longest_path);
    for (const auto *divided : {like.divided(), now})
      if (divided)
        for_each(like.stored(), [&](const GridIndex<dim> &index) {
          if (divided->kind(index) != SubLattice<dim>::Kind::whole)
            *varying.at(index) = 1;
        });
    varying.spread(reach);
    for_each_row(owned, [&](const GridIndex<dim> &row, const int points) {
      const char *marks   = varying.at(row);
      char       *uniform = is_uniform.data() + owned.position(row);
      for (int i = 0; i < points; ++i)
        uniform[i] = !marks[i];
    });
  }


  template class UniformRegions<2>;
  template class UniformRegions<3>;
} // namespace undine
