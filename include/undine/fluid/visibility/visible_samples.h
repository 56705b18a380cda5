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
  /// Interpolation of a field near bodies, from samples that can be seen from the place: no surface
  /// lies between, and none has passed over the sample since it was taken. Of the parts of a
  /// divided point the visible ones count, each at the point.
  template <int dim>
  class VisibleSamples
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// Of a field for which views->points().is_for() holds. The references must outlive it.
    /// Collective.
    VisibleSamples(const Field<dim>                               &field,
                   const std::shared_ptr<VisibilityStencils<dim>> &stencils,
                   const BodyVicinity<dim>                        &vicinity);

    VisibleSamples(const VisibleSamples &) = delete;

    /// Multilinear weights of the 2^dim points around, those that cannot be seen left out; nothing
    /// if none can.
    std::optional<double>
    at(const Place &place) const;

    /// What a path from `foot` brings to `place`, the point `index` of the lattice or the centroid
    /// of one of its parts, as far as it can be seen from the foot. The path is followed from the
    /// point itself, where the samples count: what does not move is kept as it is, step after step,
    /// and never smoothed. By cubics where nothing is in their way and the foot is not next to a
    /// body.
    std::optional<double>
    along(const GridIndex<dim> &index, const dealii::Point<dim> &place, const Place &foot) const;

  private:
    /// Can nothing hide the points that a cubic at `start` takes from an eye among them, and is the
    /// eye not next to a body?
    bool
    is_clear_for_cubics(const dealii::Point<dim> &start, const Place &query) const;

    /// Who looks.
    struct QueryPoint
    {
      Place                 place;
      const GridIndex<dim> *own; ///< sees only the nearest part of this point; nullptr: no such
    };

    /// Multilinear weights at `place` of what `eye` sees.
    std::optional<double>
    multilinear(const dealii::Point<dim> &place, const QueryPoint &query) const;

    /// What `eye` sees of these corners of the cube above point `lower`.
    typename VisibilityStencils<dim>::VisibilityStencil
    seen_values(const GridIndex<dim> &lower,
                const QueryPoint     &query,
                const unsigned int    corners) const;

    /// Mean, by measure, of what can be seen of one point of the lattice.
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
