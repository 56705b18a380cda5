// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/quiet_places.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();


    /// Values of a box of points, the first direction running fastest. A window of points of length
    /// n along a direction is the union of two of length n/2: log2(n) passes find all extremes.
    template <int dim>
    class Extremes
    {
    public:
      explicit Extremes(const IndexBox<dim> &box)
        : box(box)
        , values(box.size(), -infinity)
      {
      }

      double &
      operator[](const GridIndex<dim> &index)
      {
        return values[box.position(index)];
      }

      /// Every value becomes the largest of those up to `width` points away, in the box.
      void
      spread(const GridIndex<dim> &width)
      {
        std::size_t stride = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::size_t points = box.upper[d] - box.lower[d];
            for (std::size_t length = 1; length <= std::size_t(width[d]);)
              {
                const auto shift = std::min(length, width[d] + 1 - length);
                for (std::size_t slab = 0; slab < values.size(); slab += points * stride)
                  spread(values.data() + slab, points * stride, shift * stride);
                length += shift;
              }
            stride *= points;
          }
      }

    private:
      /// Ahead and back by the same.
      static void
      spread(double *slab, const std::size_t size, const std::size_t shift)
      {
        for (std::size_t k = 0; k + shift < size; ++k)
          slab[k] = std::max(slab[k], slab[k + shift]);
        for (std::size_t k = size; k-- > shift;)
          slab[k] = std::max(slab[k], slab[k - shift]);
      }

      const IndexBox<dim> box;
      std::vector<double> values;
    };
  } // namespace


  template <int dim>
  QuietPlaces<dim>::QuietPlaces(const Field<dim>     &source,
                                const GridIndex<dim> &reach,
                                const double          share)
    : owned(source.owned())
    , is_quiet(owned.size(), 0)
  {
    const auto   *divided = source.divided();
    Extremes<dim> largest(source.stored()), largest_negative(source.stored());
    double        range[2] = {-infinity, -infinity}; // largest, minus the smallest
    for_each(source.stored(), [&](const GridIndex<dim> &index) {
      const double value      = source(index);
      const bool   whole      = !divided || divided->kind(index) == LatticeParts<dim>::Kind::whole;
      const bool   known      = whole && std::isfinite(value);
      largest[index]          = known ? value : infinity;
      largest_negative[index] = known ? -value : infinity;
      if (known && owned.contains(index))
        {
          range[0] = std::max(range[0], value);
          range[1] = std::max(range[1], -value);
        }
    });
    dealii::Utilities::MPI::max(range, source.lattice().blocks().communicator(), range);
    largest.spread(reach);
    largest_negative.spread(reach);
    const double most = share * (range[0] + range[1]);
    for_each(owned, [&](const GridIndex<dim> &index) {
      is_quiet[owned.position(index)] = largest[index] + largest_negative[index] <= most;
    });
  }


  template class QuietPlaces<2>;
  template class QuietPlaces<3>;
} // namespace undine
