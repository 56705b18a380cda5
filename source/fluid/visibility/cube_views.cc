// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/cube_views.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace undine
{
  namespace
  {
    constexpr double rounding = 1e-12; ///< of places, over the size of cells
    constexpr double flatness = 0.02;  ///< height of a screen over the size of cells


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
  CubeViews<dim>::CubeViews(const Field<dim>        &like,
                            const GridIndex<dim>    &width,
                            const Obstruction<dim>  &obstruction_,
                            const BodyVicinity<dim> &vicinity)
    : sampled(like, width, obstruction_, vicinity)
    , obstruction(obstruction_)
    , facets(vicinity.facets_of_cells())
    , box(sampled.stored_points())
    , cube_above(box.size(), unknown)
    , cubes(1)
  {
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
    Cube cube;
    cube.samples = samples.size();
    cube.screens = cube.screens_end  = screens.size();
    std::tie(cube.lower, cube.upper) = facets.corners(cells);
    const auto rim                   = rounding * (cube.upper - cube.lower);
    cube.lower -= rim, cube.upper += rim;
    cube.is_clear = has_nothing(lower, cells);
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
      add_screens(cube, cells);
    cube.screens_end = screens.size();
    return true;
  }


  template <int dim>
  bool
  CubeViews<dim>::has_nothing(const GridIndex<dim> &lower, const IndexBox<dim> &cells) const
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
  CubeViews<dim>::part(const Cube &cube, Screen &screen) const
  {
    screen.above = screen.below = 0;
    for (auto k = cube.samples; k < samples.size(); ++k)
      {
        const int  side = screen.slab.side(samples[k].place);
        const Mask bit  = Mask(1) << (k - cube.samples);
        screen.above |= side > 0 ? bit : 0;
        screen.below |= side < 0 ? bit : 0;
      }
  }


  template <int dim>
  void
  CubeViews<dim>::add_wall(Cube &cube, const Slab &slab)
  {
    Screen wall{};
    wall.slab = slab;
    part(cube, wall);
    Mask all = 0;
    for (const Mask of_corner : cube.of_corner)
      all |= of_corner;
    cube.is_wall = (wall.above | wall.below) == all;
    if (cube.is_wall)
      screens.push_back(wall);
  }


  template <int dim>
  void
  CubeViews<dim>::add_screens(Cube &cube, const IndexBox<dim> &cells)
  {
    double height = cube.upper[0] - cube.lower[0];
    for (unsigned int d = 1; d < dim; ++d)
      height = std::min(height, cube.upper[d] - cube.lower[d]);
    height *= flatness;
    auto in_cells = facets.in(cells);
    while (!in_cells.empty())
      {
        const auto *leader = in_cells.front();
        Screen      screen{};
        screen.slab      = leader->patch.slab;
        screen.lower     = leader->patch.lower;
        screen.upper     = leader->patch.upper;
        screen.facets    = facets_of_screens.size();
        const auto taken = [&](const Facet *facet) {
          const auto slab = facet->patch.widened(screen.slab);
          if (facet != leader && slab.upper - slab.lower > height)
            return false;
          screen.slab = slab;
          for (unsigned int d = 0; d < dim; ++d)
            {
              screen.lower[d] = std::min(screen.lower[d], facet->patch.lower[d]);
              screen.upper[d] = std::max(screen.upper[d], facet->patch.upper[d]);
            }
          facets_of_screens.push_back(facet);
          return true;
        };
        in_cells.erase(std::remove_if(in_cells.begin(), in_cells.end(), taken), in_cells.end());
        screen.facets_end = facets_of_screens.size();
        part(cube, screen);
        screens.push_back(screen);
      }
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
          if ((beyond & 1) && hides(screen, eye, samples[k].place))
            wanted &= ~(Mask(1) << (k - cube.samples));
      }
    return wanted;
  }


  template <int dim>
  bool
  CubeViews<dim>::hides(const Screen             &screen,
                        const dealii::Point<dim> &eye,
                        const dealii::Point<dim> &place) const
  {
    // Only facets that the way comes past within the slab can be met: around its place in the
    // middle of the slab, or anywhere if it leads along.
    const auto        &slab   = screen.slab;
    const double       at_eye = slab.normal * eye, descent = at_eye - slab.normal * place;
    const double       half  = (slab.upper - slab.lower) / 2;
    const bool         along = std::abs(descent) < 4 * half;
    const double       share = along ? .5 : (at_eye - slab.lower - half) / descent;
    const double       reach = along ? 1 : half / std::abs(descent);
    dealii::Point<dim> lower, upper; // corners of a box around that part of the way
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double way    = place[d] - eye[d];
        const double middle = eye[d] + share * way, extent = reach * std::abs(way);
        lower[d] = middle - extent;
        upper[d] = middle + extent;
      }
    if (!meet(lower, upper, screen.lower, screen.upper))
      return false;
    for (auto k = screen.facets; k < screen.facets_end; ++k)
      {
        const auto &facet = *facets_of_screens[k];
        if (meet(lower, upper, facet.patch.lower, facet.patch.upper) &&
            obstruction.first_hit(facet.image, eye, place) <= 1)
          return true;
      }
    return false;
  }


  template <int dim>
  bool
  CubeViews<dim>::is_clear(const GridIndex<dim> &lower, const dealii::Point<dim> &eye)
  {
    const auto &cube = cubes[number_of(lower)];
    return cube.is_clear && is_between(eye, cube.lower, cube.upper);
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
    Assert(!cube.is_clear, dealii::ExcInternalError());
    Mask wanted = 0;
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      wanted |= (corners >> corner & 1) ? cube.of_corner[corner] : 0;
    const auto seen = visible(cube, eye, wanted);
    if (!seen)
      return {};
    View result{{}, 0};
    for (unsigned int corner = 0; corner < n_corners; ++corner)
      if (*seen & cube.of_corner[corner])
        {
          const bool is_own = own != nullptr && sampled.inside(corner_of(lower, corner)) == *own;
          result.corners |= 1u << corner;
          result.values[corner] =
            is_own ? nearest(values, cube, corner, *seen, eye) : mean(values, cube, corner, *seen);
        }
    return result;
  }


  template <int dim>
  double
  CubeViews<dim>::mean(const Values      &values,
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
  CubeViews<dim>::nearest(const Values             &values,
                          const Cube               &cube,
                          const unsigned int        corner,
                          const Mask                seen,
                          const dealii::Point<dim> &eye) const
  {
    double least = std::numeric_limits<double>::infinity(), value = 0;
    for_each_sample(cube, corner, seen, [&](const Sample &sample) {
      if (const double distance = sample.place.distance(eye); distance < least)
        least = distance, value = values[sample.number];
    });
    return value;
  }


  template class CubeViews<2>;
  template class CubeViews<3>;
} // namespace undine
