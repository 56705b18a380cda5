// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/visibility_stencils.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace undine
{
  namespace
  {
    constexpr double rounding_of_places = 1e-12; ///< of places, over the size of cells
    constexpr double flatness           = 0.02;  ///< height of an occluder over the size of cells


    template <int dim>
    GridIndex<dim>
    corner_of(GridIndex<dim> lower, const unsigned int corner)
    {
      for (unsigned int d = 0; d < dim; ++d)
        lower[d] += (corner >> d) & 1;
      return lower;
    }


    template <int dim>
    bool
    is_between(const dealii::Point<dim> &place,
               const dealii::Point<dim> &lower,
               const dealii::Point<dim> &upper)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (place[d] < lower[d] || place[d] > upper[d])
          return false;
      return true;
    }


    /// Do two boxes have a place in common?
    template <int dim>
    bool
    meet(const dealii::Point<dim> &lower,
         const dealii::Point<dim> &upper,
         const dealii::Point<dim> &other_lower,
         const dealii::Point<dim> &other_upper)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (lower[d] > other_upper[d] || upper[d] < other_lower[d])
          return false;
      return true;
    }
  } // namespace


  template <int dim>
  VisibilityStencils<dim>::VisibilityStencils(const Field<dim>        &like,
                                              const GridIndex<dim>    &width,
                                              const Obstruction<dim>  &obstruction_,
                                              const BodyVicinity<dim> &vicinity,
                                              const typename SampledPoints<dim>::Enters &enters)
    : sampled(like, width, obstruction_, vicinity, enters)
    , obstruction(obstruction_)
    , facets(vicinity.facets_of_cells())
    , box(sampled.stored_points())
    , cube_above(box.size(), unknown)
    , cubes(1)
  {
  }


  template <int dim>
  unsigned int
  VisibilityStencils<dim>::number_of(const GridIndex<dim> &lower)
  {
    auto &number = cube_above[box.position(lower)];
    if (number == unknown)
      number = make(lower);
    return number;
  }


  template <int dim>
  unsigned int
  VisibilityStencils<dim>::make(const GridIndex<dim> &lower)
  {
    const auto cells = sampled.cells_around(lower);
    if (!facets.know(cells))
      return 0;
    Cube cube;
    cube.samples   = samples.size();
    cube.occluders = cube.occluders_end = occluders.size();
    std::tie(cube.lower, cube.upper)    = facets.corners(cells);
    const auto rim                      = rounding_of_places * (cube.upper - cube.lower);
    cube.lower -= rim, cube.upper += rim;
    cube.is_clear = has_nothing(lower, cells);
    if (!cube.is_clear && !add_to(cube, lower, cells))
      return 0;
    cubes.push_back(cube);
    return cubes.size() - 1;
  }


  template <int dim>
  bool
  VisibilityStencils<dim>::add_to(Cube                 &cube,
                                  const GridIndex<dim> &lower,
                                  const IndexBox<dim>  &cells)
  {
    if (!add_samples(cube, lower))
      {
        samples.resize(cube.samples);
        return false;
      }
    if (const auto slab = facets.wall(cells))
      add_wall(cube, *slab);
    if (!cube.is_wall)
      add_occluders(cube, cells);
    cube.occluders_end = occluders.size();
    return true;
  }


  template <int dim>
  bool
  VisibilityStencils<dim>::has_nothing(const GridIndex<dim> &lower,
                                       const IndexBox<dim>  &cells) const
  {
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      if (!sampled.is_whole(corner_of(lower, corner)))
        return false;
    return facets.in(cells).empty();
  }


  template <int dim>
  bool
  VisibilityStencils<dim>::add_samples(Cube &cube, const GridIndex<dim> &lower)
  {
    bool inside = true;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      {
        cube.first[corner] = (samples.size() - cube.samples) % n_bits;
        sampled.for_each_sample(corner_of(lower, corner), [&](const auto &sample) {
          cube.of_corner[corner] |= Mask(1) << (samples.size() - cube.samples) % n_bits;
          samples.push_back({sample.place.point, sample.number, sample.measure});
          inside = inside && is_between(sample.place.point, cube.lower, cube.upper);
        });
      }
    return inside && samples.size() - cube.samples <= n_bits;
  }


  template <int dim>
  void
  VisibilityStencils<dim>::part(const Cube &cube, Occluder &occluder) const
  {
    occluder.above = occluder.below = 0;
    for (auto k = cube.samples; k < samples.size(); ++k)
      {
        const int  side = occluder.slab.side(samples[k].place);
        const Mask bit  = Mask(1) << (k - cube.samples);
        occluder.above |= side > 0 ? bit : 0;
        occluder.below |= side < 0 ? bit : 0;
      }
  }


  template <int dim>
  void
  VisibilityStencils<dim>::add_wall(Cube &cube, const Slab &slab)
  {
    Occluder wall{};
    wall.slab = slab;
    part(cube, wall);
    Mask all = 0;
    for (const Mask of_corner : cube.of_corner)
      all |= of_corner;
    cube.is_wall = (wall.above | wall.below) == all;
    if (cube.is_wall)
      occluders.push_back(wall);
  }


  template <int dim>
  void
  VisibilityStencils<dim>::add_occluders(Cube &cube, const IndexBox<dim> &cells)
  {
    double height = cube.upper[0] - cube.lower[0];
    for (unsigned int d = 1; d < dim; ++d)
      height = std::min(height, cube.upper[d] - cube.lower[d]);
    height *= flatness;
    auto in_cells = facets.in(cells);
    while (!in_cells.empty())
      {
        const auto *leader = in_cells.front();
        Occluder    occluder{};
        occluder.slab    = leader->patch.slab;
        occluder.lower   = leader->patch.lower;
        occluder.upper   = leader->patch.upper;
        occluder.facets  = facets_of_occluders.size();
        const auto taken = [&](const Facet *facet) {
          const auto slab = facet->patch.widened(occluder.slab);
          if (facet != leader && slab.upper - slab.lower > height)
            return false;
          occluder.slab = slab;
          for (unsigned int d = 0; d < dim; ++d)
            {
              occluder.lower[d] = std::min(occluder.lower[d], facet->patch.lower[d]);
              occluder.upper[d] = std::max(occluder.upper[d], facet->patch.upper[d]);
            }
          facets_of_occluders.push_back(facet);
          return true;
        };
        in_cells.erase(std::remove_if(in_cells.begin(), in_cells.end(), taken), in_cells.end());
        occluder.facets_end = facets_of_occluders.size();
        part(cube, occluder);
        occluders.push_back(occluder);
      }
  }


  template <int dim>
  std::optional<typename VisibilityStencils<dim>::Mask>
  VisibilityStencils<dim>::visible(const Cube               &cube,
                                   const dealii::Point<dim> &query,
                                   Mask                      wanted) const
  {
    for (auto s = cube.occluders; s < cube.occluders_end && wanted != 0; ++s)
      {
        const auto &occluder = occluders[s];
        const int   side     = occluder.slab.side(query);
        Mask        beyond = wanted & ~(side > 0 ? occluder.above : side < 0 ? occluder.below : 0);
        if (cube.is_wall)
          return side == 0 ? std::nullopt : std::optional<Mask>(wanted & ~beyond);
        for (auto k = cube.samples; beyond != 0; ++k, beyond >>= 1)
          if ((beyond & 1) && hides(occluder, query, samples[k].place))
            wanted &= ~(Mask(1) << (k - cube.samples));
      }
    return wanted;
  }


  template <int dim>
  bool
  VisibilityStencils<dim>::hides(const Occluder           &occluder,
                                 const dealii::Point<dim> &query,
                                 const dealii::Point<dim> &place) const
  {
    // Only facets near the part of the segment within the slab can be met: around the point where
    // it crosses the middle of the slab, or anywhere if it runs along the slab.
    const auto        &slab     = occluder.slab;
    const double       at_query = slab.normal * query, descent = at_query - slab.normal * place;
    const double       half  = (slab.upper - slab.lower) / 2;
    const bool         along = std::abs(descent) < 4 * half;
    const double       share = along ? .5 : (at_query - slab.lower - half) / descent;
    const double       reach = along ? 1 : half / std::abs(descent);
    dealii::Point<dim> lower, upper; // corners of a box around that part of the segment
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double path   = place[d] - query[d];
        const double middle = query[d] + share * path, extent = reach * std::abs(path);
        lower[d] = middle - extent;
        upper[d] = middle + extent;
      }
    if (!meet(lower, upper, occluder.lower, occluder.upper))
      return false;
    for (auto k = occluder.facets; k < occluder.facets_end; ++k)
      {
        const auto &facet = *facets_of_occluders[k];
        if (meet(lower, upper, facet.patch.lower, facet.patch.upper) &&
            obstruction.first_hit(facet.image, query, place) <= 1)
          return true;
      }
    return false;
  }


  template <int dim>
  bool
  VisibilityStencils<dim>::is_clear(const GridIndex<dim> &lower, const dealii::Point<dim> &query)
  {
    const auto &cube = cubes[number_of(lower)];
    return cube.is_clear && is_between(query, cube.lower, cube.upper);
  }


  template <int dim>
  std::optional<typename VisibilityStencils<dim>::VisibilityStencil>
  VisibilityStencils<dim>::stencil(const Values             &values,
                                   const GridIndex<dim>     &lower,
                                   const dealii::Point<dim> &query,
                                   const unsigned int        corners,
                                   const GridIndex<dim>     *own)
  {
    const auto number = number_of(lower);
    if (number == 0 || !is_between(query, cubes[number].lower, cubes[number].upper))
      return {};
    const auto &cube = cubes[number];
    Assert(!cube.is_clear, dealii::ExcInternalError());
    Mask wanted = 0;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      wanted |= (corners >> corner & 1) ? cube.of_corner[corner] : 0;
    const auto seen = visible(cube, query, wanted);
    if (!seen)
      return {};
    VisibilityStencil result{{}, 0};
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      if (*seen & cube.of_corner[corner])
        {
          const bool is_own = own != nullptr && sampled.inside(corner_of(lower, corner)) == *own;
          result.corners |= 1u << corner;
          result.values[corner] = is_own ? nearest(values, cube, corner, *seen, query)
                                         : mean(values, cube, corner, *seen);
        }
    return result;
  }


  template <int dim>
  double
  VisibilityStencils<dim>::mean(const Values      &values,
                                const Cube        &cube,
                                const unsigned int corner,
                                const Mask         seen) const
  {
    const Mask of_corner = seen & cube.of_corner[corner];
    if (of_corner == Mask(1) << cube.first[corner])
      return values[samples[cube.samples + cube.first[corner]].number];
    double sum = 0, total = 0;
    for_each_sample(cube, corner, seen, [&](const Sample &sample) {
      sum += sample.measure * values[sample.number];
      total += sample.measure;
    });
    return sum / total;
  }


  template <int dim>
  double
  VisibilityStencils<dim>::nearest(const Values             &values,
                                   const Cube               &cube,
                                   const unsigned int        corner,
                                   const Mask                seen,
                                   const dealii::Point<dim> &query) const
  {
    double least = std::numeric_limits<double>::infinity(), value = 0;
    for_each_sample(cube, corner, seen, [&](const Sample &sample) {
      if (const double distance = sample.place.distance(query); distance < least)
        least = distance, value = values[sample.number];
    });
    return value;
  }


  template class VisibilityStencils<2>;
  template class VisibilityStencils<3>;
} // namespace undine
