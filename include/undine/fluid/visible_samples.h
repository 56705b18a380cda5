// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visible_samples_h
#define undine_fluid_visible_samples_h

#include <undine/fluid/body_vicinity.h>
#include <undine/fluid/field.h>
#include <undine/fluid/obstruction.h>

#include <map>
#include <optional>
#include <vector>

namespace undine
{
  /// Interpolation of a field near bodies, from samples that can be seen from the place: no surface
  /// lies between, and none has passed over the sample since it was taken. Of the parts of a
  /// divided point the visible ones count, each at its centroid.
  template <int dim>
  class VisibleSamples
  {
  public:
    /// `field` with ghost layers of this width and boundary points, on what bodies left of the grid
    /// before their last motion. The references must outlive it. Collective.
    VisibleSamples(const Field<dim>        &field,
                   const GridIndex<dim>    &width,
                   const Obstruction<dim>  &obstruction,
                   const BodyVicinity<dim> &vicinity);

    /// Multilinear weights of the 2^dim points around, those that cannot be seen left out; nothing
    /// if none can.
    std::optional<double>
    at(const dealii::Point<dim> &place) const;

  private:
    struct Sample
    {
      dealii::Point<dim> place;
      double             value;
    };

    void
    gather_parts(const GridIndex<dim> &width);

    bool
    is_visible(const dealii::Point<dim> &sample, const dealii::Point<dim> &place) const;

    /// Mean of what can be seen of one point of the lattice; `all_visible`: nothing can hide it.
    std::optional<double>
    value_of(const GridIndex<dim>     &index,
             const dealii::Point<dim> &place,
             const bool                all_visible) const;

    const Field<dim>                          &field;
    const Obstruction<dim>                    &obstruction;
    const BodyVicinity<dim>                   &vicinity;
    Field<dim>                                 kinds; ///< LatticeParts::Kind of each point
    std::map<std::size_t, std::vector<Sample>> parts; ///< by position in the whole lattice
  };
} // namespace undine

#endif
