// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_visibility_stencils_h
#define undine_fluid_visibility_visibility_stencils_h

#include <undine/fluid/visibility/facets_of_cells.h>
#include <undine/fluid/visibility/sampled_points.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace undine
{
  /// Visibility stencils: which samples at the corners of a cube between points of a lattice are
  /// visible from a query point in it, where surfaces are near. On which side of each occluder the
  /// samples lie is found once for all query points; a query then tests only the facets between the
  /// query point and samples on their other side, and none where a surface parts the cube like a
  /// wall.
  template <int dim>
  class VisibilityStencils
  {
  public:
    static constexpr unsigned int n_corners = 1 << dim;

    using Values = typename SampledPoints<dim>::Values;

    /// For the cubes between stored points of fields like this one, see SampledPoints. Keeps
    /// references to the surfaces and the vicinity. Collective.
    VisibilityStencils(const Field<dim>                          &like,
                       const GridIndex<dim>                      &width,
                       const Obstruction<dim>                    &obstruction,
                       const BodyVicinity<dim>                   &vicinity,
                       const typename SampledPoints<dim>::Enters &enters = {});

    /// The samples.
    const SampledPoints<dim> &
    points() const
    {
      return sampled;
    }

    /// The visible corners of a cube: of each the mean, by measure, of its visible samples.
    struct VisibilityStencil
    {
      std::array<double, n_corners> values;  ///< zero of the others
      unsigned int                  corners; ///< bit by bit
    };

    /// Is `query` in the cells of the cube above point `lower`, and has that cube no facets and
    /// only whole corners? Remembers the cube.
    bool
    is_clear(const GridIndex<dim> &lower, const dealii::Point<dim> &query);

    /// The `values` at those of the `corners`, a bit for each, that are visible from `query`, in a
    /// cube that is not clear; of its own point `own`, if it is not nullptr, only the nearest
    /// visible sample. Nothing if the query point is not in the cells of the cube, or so close to a
    /// wall that single facets must be tested.
    std::optional<VisibilityStencil>
    stencil(const Values             &values,
            const GridIndex<dim>     &lower,
            const dealii::Point<dim> &query,
            const unsigned int        corners,
            const GridIndex<dim>     *own);

  private:
    using Mask = std::uint64_t; ///< a bit for each sample of a cube

    static constexpr unsigned int n_bits = 64;

    struct Sample
    {
      dealii::Point<dim> place;
      std::size_t        number; ///< in Values
      double             measure;
    };

    using Slab  = typename Obstruction<dim>::Slab;
    using Facet = typename FacetsOfCells<dim>::Facet;

    /// Facets nearly in one plane, or a wall, and what of the cube's samples is on either side of
    /// the slab around them.
    struct Occluder
    {
      Slab        slab;
      std::size_t facets, facets_end;
      Mask        above, below;

      dealii::Point<dim> lower, upper; ///< corners of a box around the facets
    };

    struct Cube
    {
      dealii::Point<dim>                  lower, upper; ///< of its cells
      std::size_t                         samples;      ///< where they begin
      std::array<Mask, n_corners>         of_corner{};  ///< which of them
      std::array<std::uint8_t, n_corners> first{};      ///< of a corner's, which follow each other
      std::size_t                         occluders, occluders_end;
      bool                                is_wall  = false;
      bool                                is_clear = false; ///< no facets, all corners whole
    };

    /// The number of the cube above a point, found or made; 0: not to be used.
    unsigned int
    number_of(const GridIndex<dim> &lower);

    unsigned int
    make(const GridIndex<dim> &lower);

    /// Has it no facets in these cells, and are all its corners whole?
    bool
    has_nothing(const GridIndex<dim> &lower, const IndexBox<dim> &cells) const;

    /// Samples and occluders; false if it is not to be used.
    bool
    add_to(Cube &cube, const GridIndex<dim> &lower, const IndexBox<dim> &cells);

    /// Returns whether all of them are in the cells of the cube, and not too many.
    bool
    add_samples(Cube &cube, const GridIndex<dim> &lower);

    /// As a wall, if it is one that leaves no sample inside.
    void
    add_wall(Cube &cube, const Slab &slab);

    /// Group the facets in these cells into occluders.
    void
    add_occluders(Cube &cube, const IndexBox<dim> &cells);

    /// Set on which side of the occluder the samples of the cube are.
    void
    part(const Cube &cube, Occluder &occluder) const;

    /// Those of the samples `wanted` that are visible from a query point; nothing if single facets
    /// must be tested.
    std::optional<Mask>
    visible(const Cube &cube, const dealii::Point<dim> &query, Mask wanted) const;

    /// Is one of an occluder's facets between the query point and `place`, which are not both on
    /// the same side of it?
    bool
    hides(const Occluder           &occluder,
          const dealii::Point<dim> &query,
          const dealii::Point<dim> &place) const;

    /// Call action(sample) for those of a corner that are among `seen`.
    template <class Action>
    void
    for_each_sample(const Cube        &cube,
                    const unsigned int corner,
                    const Mask         seen,
                    const Action      &action) const
    {
      Mask rest = (seen & cube.of_corner[corner]) >> cube.first[corner];
      for (auto k = cube.samples + cube.first[corner]; rest != 0; ++k, rest >>= 1)
        if (rest & 1)
          action(samples[k]);
    }

    /// Over the visible samples of a corner. @{
    double
    mean(const Values &values, const Cube &cube, const unsigned int corner, const Mask seen) const;

    double
    nearest(const Values             &values,
            const Cube               &cube,
            const unsigned int        corner,
            const Mask                seen,
            const dealii::Point<dim> &query) const;
    /// @}

    static constexpr unsigned int unknown = -1;

    SampledPoints<dim>         sampled;
    const Obstruction<dim>    &obstruction;
    const FacetsOfCells<dim>  &facets;
    IndexBox<dim>              box;
    std::vector<unsigned int>  cube_above; ///< each point, in `cubes`, or unknown
    std::vector<Cube>          cubes;      ///< the first is none
    std::vector<Sample>        samples;
    std::vector<Occluder>      occluders;
    std::vector<const Facet *> facets_of_occluders;
  };
} // namespace undine

#endif
