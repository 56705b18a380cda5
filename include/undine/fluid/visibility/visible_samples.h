// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_visible_samples_h
#define undine_fluid_visibility_visible_samples_h

#include <undine/fluid/grid/field.h>
#include <undine/fluid/visibility/body_vicinity.h>
#include <undine/fluid/visibility/obstruction.h>
#include <undine/fluid/visibility/sampled_points.h>
#include <undine/fluid/visibility/visibility_stencils.h>

#include <memory>
#include <optional>

namespace undine
{
  /// Interpolation of a field near bodies from the samples that are visible from a query point: no
  /// surface lies between, and the sample is not freshly cleared. Of the sub-cells or sub-faces of
  /// a divided point the visible ones count, as if they were at the point.
  template <int dim>
  class VisibleSamples
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// For a field for which stencils->points().is_for() holds. The references must outlive it.
    /// Collective.
    VisibleSamples(const Field<dim>                               &field,
                   const std::shared_ptr<VisibilityStencils<dim>> &stencils,
                   const BodyVicinity<dim>                        &vicinity);

    VisibleSamples(const VisibleSamples &) = delete;

    /// The mean of the visible samples at the 2^dim points around `place`, by their multilinear
    /// weights; nothing if none is visible.
    std::optional<double>
    at(const Place &place) const;

    /// The value that the path from `foot` brings to `place`, which is the point `index` of the
    /// lattice or the centroid of one of its sub-cells or sub-faces, from the samples that are
    /// visible from the foot; nothing if none is. Weights are those of a path to the point itself,
    /// where samples count as being: what does not move is kept as it is, step after step, and
    /// never smoothed. Cubic interpolation where no surface can lie between its points and the foot
    /// is not next to a body.
    std::optional<double>
    along(const GridIndex<dim> &index, const dealii::Point<dim> &place, const Place &foot) const;

    /// The mean of the samples at the points next to `index` along the axes that are visible from
    /// `place`, by their measures, that of a whole point being `whole`; nothing if none is.
    std::optional<double>
    mean_around(const GridIndex<dim> &index, const Place &place, double whole) const;

  private:
    /// Are all points that a cubic at `start` takes certainly visible from `query`, which is among
    /// them and not next to a body?
    bool
    is_clear_for_cubics(const dealii::Point<dim> &start, const Place &query) const;

    /// From where samples must be visible.
    struct QueryPoint
    {
      Place                 place;
      const GridIndex<dim> *own; ///< of this point only the nearest sample counts; nullptr: no such
    };

    /// The mean, by multilinear weights at `place`, of what is visible from `query`.
    std::optional<double>
    multilinear(const dealii::Point<dim> &place, const QueryPoint &query) const;

    bool
    is_point(const GridIndex<dim> &index, const unsigned int d) const;

    template <class Action>
    void
    for_each_neighbouring_cube(const GridIndex<dim>          &lower,
                               const std::array<double, dim> &weights,
                               const Action                  &action) const;

    /// Those of these corners of the cube above point `lower` that are visible from `query`.
    typename VisibilityStencils<dim>::VisibilityStencil
    seen_values(const GridIndex<dim> &lower,
                const QueryPoint     &query,
                const unsigned int    corners) const;

    /// Mean, by measure, of the visible samples of one point of the lattice.
    std::optional<double>
    value_of(const GridIndex<dim> &index, const QueryPoint &query) const;

    const Field<dim>                        &field;
    const BodyVicinity<dim>                 &vicinity;
    std::shared_ptr<VisibilityStencils<dim>> stencils; ///< remembered, for this field and others
    const SampledPoints<dim>                &points;

    const typename SampledPoints<dim>::Values values;
  };
} // namespace undine

#endif
