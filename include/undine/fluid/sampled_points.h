// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_sampled_points_h
#define undine_fluid_sampled_points_h

#include <undine/fluid/body_vicinity.h>
#include <undine/fluid/field.h>
#include <undine/fluid/obstruction.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace undine
{
  /// Which samples of a field there are at the points of its lattice for others to see: the value
  /// of a point that is whole, those of the parts of a divided one, and none where a point is
  /// closed or a surface has passed over a sample since it was taken.
  template <int dim>
  class SampledPoints
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// `field` with ghost layers of this width and boundary points, on what bodies left of the grid
    /// before their last motion. Keeps a reference to it. Collective.
    SampledPoints(const Field<dim>        &field,
                  const GridIndex<dim>    &width,
                  const Obstruction<dim>  &obstruction,
                  const BodyVicinity<dim> &vicinity);

    struct Sample
    {
      Place  place;
      double value;
      double measure;
    };

    /// Call action(sample) for the samples of a point, boundary points and images included, where
    /// they appear there.
    template <class Action>
    void
    for_each_sample(const GridIndex<dim> &index, const Action &action) const
    {
      const auto position = field.stored().position(index);
      if (kinds[position] == Kind::value)
        action(Sample{located(index), field(index), 1});
      else if (kinds[position] == Kind::parts)
        {
          const auto point = inside(index), own = field.lattice().wrapped(point);
          for (const auto &sample : lists[list_of_point[position]])
            action(point == own ? sample : image_of(sample, point, own));
        }
    }

    /// The point that a boundary point continues; others themselves.
    GridIndex<dim>
    inside(GridIndex<dim> index) const;

    /// The place of a point of the lattice; faces are in the cells above them.
    Place
    located(const GridIndex<dim> &index) const;

    /// The cells that hold the cube between the point `lower` and those above it; boundary points
    /// belong to the cells inside.
    IndexBox<dim>
    cells_around(const GridIndex<dim> &lower) const;

  private:
    enum class Kind : std::uint8_t
    {
      value, ///< one, of the whole point
      parts, ///< those of a divided point
      nothing
    };

    void
    find_kinds(const GridIndex<dim> &width, const Obstruction<dim> &obstruction);

    void
    gather_parts(const GridIndex<dim>    &width,
                 const Obstruction<dim>  &obstruction,
                 const BodyVicinity<dim> &vicinity);

    /// Where a sample of the point `own` appears at its image `point`.
    Sample
    image_of(Sample sample, const GridIndex<dim> &point, const GridIndex<dim> &own) const;

    const Field<dim>                &field;
    std::vector<Kind>                kinds;         ///< by position in field.stored()
    std::vector<unsigned int>        list_of_point; ///< likewise, in `lists`
    std::vector<std::vector<Sample>> lists;         ///< the first is empty
  };
} // namespace undine

#endif
