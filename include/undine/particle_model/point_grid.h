// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_point_grid_h
#define undine_particle_model_point_grid_h

#include <deal.II/base/point.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace undine
{
  /// Points in space, to be asked which of them are near a place; sorted into cells.
  template <int dim>
  class PointGrid
  {
  public:
    /// Distances that are asked for are at most `reach` [m].
    explicit PointGrid(const double reach)
      : reach(reach)
    {
    }

    /// Its number is that of the points added before.
    void
    add(const dealii::Point<dim> &point)
    {
      cells[key(index(point))].push_back(points.size());
      points.push_back(point);
    }

    std::size_t
    size() const
    {
      return points.size();
    }

    const dealii::Point<dim> &
    operator[](const std::size_t number) const
    {
      return points[number];
    }

    /// action(number) for all points closer to `place` than `distance` [m].
    template <class Action>
    void
    for_each_near(const dealii::Point<dim> &place,
                  const double              distance,
                  const Action             &action) const
    {
      const auto   centre  = index(place);
      unsigned int n_cells = 1;
      for (unsigned int axis = 0; axis < dim; ++axis)
        n_cells *= 3;
      for (unsigned int k = 0; k < n_cells; ++k)
        {
          auto cell = centre;
          for (unsigned int axis = 0, rest = k; axis < dim; ++axis, rest /= 3)
            cell[axis] += static_cast<int>(rest % 3) - 1;
          const auto found = cells.find(key(cell));
          if (found == cells.end())
            continue;
          for (const std::size_t number : found->second)
            if (points[number].distance_square(place) < distance * distance)
              action(number);
        }
    }

    /// Is any point closer to `place` than `distance` [m]?
    bool
    any_near(const dealii::Point<dim> &place, const double distance) const
    {
      bool found = false;
      for_each_near(place, distance, [&](const std::size_t) { found = true; });
      return found;
    }

  private:
    using Index = std::array<std::int64_t, dim>;

    Index
    index(const dealii::Point<dim> &place) const
    {
      Index result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] = static_cast<std::int64_t>(std::floor(place[axis] / reach));
      return result;
    }

    /// The same for two cells only if they are a million cells apart, which does no harm but time.
    static std::uint64_t
    key(const Index &cell)
    {
      std::uint64_t result = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result = (result << 20) + (cell[axis] & 0xFFFFF);
      return result;
    }

    double                                                      reach;
    std::vector<dealii::Point<dim>>                             points;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells;
  };
} // namespace undine

#endif
