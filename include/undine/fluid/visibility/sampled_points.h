// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_sampled_points_h
#define undine_fluid_visibility_sampled_points_h

#include <undine/fluid/grid/field.h>
#include <undine/fluid/visibility/body_vicinity.h>
#include <undine/fluid/visibility/obstruction.h>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace undine
{
  /// Which samples a field has at the points of its lattice, irrespective of whether they are
  /// visible from a query point: the value of a point that is whole, those of the sub-cells or
  /// sub-faces of a divided one, and none where a point is closed or a sample is freshly cleared.
  template <int dim>
  class SampledPoints
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// Does the value of a boundary point beyond the lower (0) or upper (1) `end` of an axis come
    /// in with the flow?
    using Enters = std::function<bool(
      const unsigned int axis, const unsigned int end, const GridIndex<dim> &index)>;

    /// For fields like this one, with ghost layers of this width and boundary points, on the
    /// topology of the fluid before the last motion of bodies. Where fluid `enters`, a boundary
    /// point that continues a divided one has the value that comes in, at the places of its
    /// sub-cells or sub-faces; elsewhere it has theirs. Collective.
    SampledPoints(const Field<dim>        &like,
                  const GridIndex<dim>    &width,
                  const Obstruction<dim>  &obstruction,
                  const BodyVicinity<dim> &vicinity,
                  const Enters            &enters = {});

    /// One sample: its place, its number in Values and its measure: 1 for a whole point, else that
    /// of the sub-cell or sub-face.
    struct Sample
    {
      Place       place;
      std::size_t number; ///< in Values
      double      measure;
    };

    /// The values of a field at the samples, by their numbers.
    class Values
    {
    public:
      double
      operator[](const std::size_t number) const
      {
        return number < n_points ? points[number] : parts[number - n_points];
      }

    private:
      friend class SampledPoints;

      const double       *points; ///< all that are stored
      std::size_t         n_points;
      std::vector<double> parts;
    };

    /// The values of a field for which is_for() holds, which must outlive them. Collective.
    Values
    values(const Field<dim> &field) const;

    /// Has the field these points, this topology and these ghost layers?
    bool
    is_for(const Field<dim> &field) const
    {
      return field.shared_lattice() == lattice && field.topology() == open &&
             field.stored() == stored;
    }

    /// The points that such a field must store.
    const IndexBox<dim> &
    stored_points() const
    {
      return stored;
    }

    /// Call action(sample) for the samples of a point, boundary points and images included, where
    /// they appear there.
    template <class Action>
    void
    for_each_sample(const GridIndex<dim> &index, const Action &action) const
    {
      const auto position = stored.position(index);
      if (kinds[position] == Kind::value)
        action(Sample{located(index), position, 1});
      else if (kinds[position] == Kind::parts)
        {
          const auto point = inside(index), own = lattice->wrapped(point);
          for (const auto &sample : lists[list_of_point[position]])
            {
              auto here = point == own ? sample : image_of(sample, point, own);
              if (comes_in[position])
                here.number = position;
              action(here);
            }
        }
    }

    /// Has a point one sample, its own, numbered by its position in stored_points()?
    bool
    is_whole(const GridIndex<dim> &index) const
    {
      return kinds[stored.position(index)] == Kind::value;
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

    /// The sub-cells or sub-faces of this rank that each rank has within its ghost layers.
    void
    find_parts_for_ranks(const GridIndex<dim> &width);

    void
    gather_parts(const Obstruction<dim> &obstruction, const BodyVicinity<dim> &vicinity);

    void
    find_what_comes_in(const Enters &enters);

    /// Where a sample of the point `own` appears at its image `point`.
    Sample
    image_of(Sample sample, const GridIndex<dim> &point, const GridIndex<dim> &own) const;

    std::shared_ptr<const Lattice<dim>>       lattice;
    std::shared_ptr<const FluidTopology<dim>> open;
    IndexBox<dim>                             stored;
    std::vector<Kind>                         kinds;         ///< by position in `stored`
    std::vector<unsigned int>                 list_of_point; ///< likewise, in `lists`
    std::vector<std::vector<Sample>>          lists;         ///< the first is empty
    std::vector<std::uint8_t>                 comes_in;      ///< by position in `stored`: Enters

    std::map<unsigned int, std::vector<unsigned int>> parts_for_ranks; ///< their numbers here
  };
} // namespace undine

#endif
