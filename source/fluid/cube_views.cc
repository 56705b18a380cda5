// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/cube_views.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace undine
{
  namespace
  {
    constexpr double rounding = 1e-12; ///< of places, over the size of cells


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
  } // namespace


  template <int dim>
  CubeViews<dim>::CubeViews(const Field<dim>        &like,
                            const GridIndex<dim>    &width,
                            const Obstruction<dim>  &obstruction_,
                            const BodyVicinity<dim> &vicinity)
    : sampled(like, width, obstruction_, vicinity)
    , obstruction(obstruction_)
    , facets(vicinity.facets_of_cells())
    , box(like.stored())
    , cube_above(box.size(), unknown)
    , cubes(1)
  {
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      corner_offsets[corner] = box.position(corner_of(box.lower, corner)) - box.position(box.lower);
  }


  template <int dim>
  unsigned int
  CubeViews<dim>::number_of(const GridIndex<dim> &lower)
  {
    auto &number = cube_above[box.position(lower)];
    if (number == unknown)
      number = make(lower);
    return number;
  }


  template <int dim>
  unsigned int
  CubeViews<dim>::make(const GridIndex<dim> &lower)
  {
    const auto cells = sampled.cells_around(lower);
    if (!facets.know(cells))
      return 0;
    Cube cube{{}, {}, samples.size(), {}, screens.size(), screens.size(), false, false};
    std::tie(cube.lower, cube.upper) = facets.corners(cells);
    const auto rim                   = rounding * (cube.upper - cube.lower);
    cube.lower -= rim, cube.upper += rim;
    cube.is_clear = is_clear(lower, cells);
    if (!cube.is_clear && !add_to(cube, lower, cells))
      return 0;
    cubes.push_back(cube);
    return cubes.size() - 1;
  }


  template <int dim>
  bool
  CubeViews<dim>::add_to(Cube &cube, const GridIndex<dim> &lower, const IndexBox<dim> &cells)
  {
    if (!add_samples(cube, lower))
      {
        samples.resize(cube.samples);
        return false;
      }
    if (const auto slab = facets.wall(cells))
      add_wall(cube, *slab);
    if (!cube.is_wall)
      for (const auto *facet : facets.in(cells))
        screens.push_back(screen(cube, facet->slab, facet->image));
    cube.screens_end = screens.size();
    return true;
  }


  template <int dim>
  bool
  CubeViews<dim>::is_clear(const GridIndex<dim> &lower, const IndexBox<dim> &cells) const
  {
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      if (!sampled.is_whole(corner_of(lower, corner)))
        return false;
    return facets.in(cells).empty();
  }


  template <int dim>
  bool
  CubeViews<dim>::add_samples(Cube &cube, const GridIndex<dim> &lower)
  {
    bool inside = true;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      sampled.for_each_sample(
        corner_of(lower, corner), [&](const typename SampledPoints<dim>::Sample &sample) {
          cube.of_corner[corner] |= Mask(1) << (samples.size() - cube.samples) % n_bits;
          samples.push_back({sample.place.point, sample.number, sample.measure});
          inside = inside && is_between(sample.place.point, cube.lower, cube.upper);
        });
    return inside && samples.size() - cube.samples <= n_bits;
  }


  template <int dim>
  typename CubeViews<dim>::Screen
  CubeViews<dim>::screen(const Cube                                  &cube,
                         const typename Obstruction<dim>::Slab       &slab,
                         const typename Obstruction<dim>::FacetImage &facet) const
  {
    Screen result{slab, facet, 0, 0};
    for (auto k = cube.samples; k < samples.size(); ++k)
      {
        const int  side = slab.side(samples[k].place);
        const Mask bit  = Mask(1) << (k - cube.samples);
        result.above |= side > 0 ? bit : 0;
        result.below |= side < 0 ? bit : 0;
      }
    return result;
  }


  template <int dim>
  void
  CubeViews<dim>::add_wall(Cube &cube, const typename Obstruction<dim>::Slab &slab)
  {
    const auto wall = screen(cube, slab, {});
    Mask       all  = 0;
    for (const Mask of_corner : cube.of_corner)
      all |= of_corner;
    cube.is_wall = (wall.above | wall.below) == all;
    if (cube.is_wall)
      screens.push_back(wall);
  }


  template <int dim>
  std::optional<typename CubeViews<dim>::Mask>
  CubeViews<dim>::visible(const Cube &cube, const dealii::Point<dim> &eye, Mask wanted) const
  {
    for (auto s = cube.screens; s < cube.screens_end && wanted != 0; ++s)
      {
        const auto &screen = screens[s];
        const int   side   = screen.slab.side(eye);
        Mask        beyond = wanted & ~(side > 0 ? screen.above : side < 0 ? screen.below : 0);
        if (cube.is_wall)
          return side == 0 ? std::nullopt : std::optional<Mask>(wanted & ~beyond);
        for (auto k = cube.samples; beyond != 0; ++k, beyond >>= 1)
          if ((beyond & 1) && obstruction.first_hit(screen.facet, eye, samples[k].place) <= 1)
            wanted &= ~(Mask(1) << (k - cube.samples));
      }
    return wanted;
  }


  template <int dim>
  std::optional<typename CubeViews<dim>::View>
  CubeViews<dim>::view(const Values             &values,
                       const GridIndex<dim>     &lower,
                       const dealii::Point<dim> &eye,
                       const unsigned int        corners,
                       const GridIndex<dim>     *own)
  {
    const auto number = number_of(lower);
    if (number == 0 || !is_between(eye, cubes[number].lower, cubes[number].upper))
      return {};
    const auto &cube = cubes[number];
    if (cube.is_clear)
      return clear_view(values, lower, corners);
    Mask wanted = 0;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      wanted |= (corners >> corner & 1) ? cube.of_corner[corner] : 0;
    const auto seen = visible(cube, eye, wanted);
    if (!seen)
      return {};
    View result{{}, 0};
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      if (const Mask mask = *seen & cube.of_corner[corner])
        {
          const bool is_own = own != nullptr && sampled.inside(corner_of(lower, corner)) == *own;
          result.corners |= 1u << corner;
          result.values[corner] =
            is_own ? nearest(values, cube, mask, eye) : mean(values, cube, mask);
        }
    return result;
  }


  template <int dim>
  typename CubeViews<dim>::View
  CubeViews<dim>::clear_view(const Values         &values,
                             const GridIndex<dim> &lower,
                             const unsigned int    corners) const
  {
    View       result{{}, corners};
    const auto position = box.position(lower);
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      result.values[corner] = values[position + corner_offsets[corner]];
    return result;
  }


  template <int dim>
  double
  CubeViews<dim>::mean(const Values &values, const Cube &cube, const Mask mask) const
  {
    double sum = 0, total = 0;
    for_each_sample(cube, mask, [&](const Sample &sample) {
      sum += sample.measure * values[sample.number];
      total += sample.measure;
    });
    return sum / total;
  }


  template <int dim>
  double
  CubeViews<dim>::nearest(const Values             &values,
                          const Cube               &cube,
                          const Mask                mask,
                          const dealii::Point<dim> &eye) const
  {
    double least = std::numeric_limits<double>::infinity(), value = 0;
    for_each_sample(cube, mask, [&](const Sample &sample) {
      if (const double distance = sample.place.distance(eye); distance < least)
        least = distance, value = values[sample.number];
    });
    return value;
  }


  template class CubeViews<2>;
  template class CubeViews<3>;
} // namespace undine
