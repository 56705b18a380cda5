// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/parted_cubes.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  PartedCubes<dim>::PartedCubes(const Field<dim>         &field,
                                const SampledPoints<dim> &points,
                                const BodyVicinity<dim>  &vicinity)
    : box(field.stored())
    , cube_above(box.size(), 0)
    , cubes(1)
  {
    auto lower_corners = box;
    for (int &upper : lower_corners.upper.values)
      --upper;
    for_each(lower_corners, [&](const GridIndex<dim> &lower) {
      auto highest = lower;
      for (int &index : highest.values)
        ++index;
      const auto begin = points.located(lower).cell, end = points.located(highest).cell;
      if (vicinity.is_clear(begin, end))
        return;
      const auto wall = vicinity.wall_in(begin, end);
      if (!wall)
        return;
      Cube cube{*wall, {}};
      for (unsigned int corner = 0; corner < n_corners; ++corner)
        {
          auto index = lower;
          for (unsigned int d = 0; d < dim; ++d)
            index[d] += (corner >> d) & 1;
          if (!look(cube, corner, points, index))
            return;
        }
      cube_above[box.position(lower)] = cubes.size();
      cubes.push_back(cube);
    });
  }


  template <int dim>
  bool
  PartedCubes<dim>::look(Cube                     &cube,
                         const unsigned int        corner,
                         const SampledPoints<dim> &points,
                         const GridIndex<dim>     &index)
  {
    bool                  clear = true;
    std::array<double, 2> sums{}, totals{};
    points.for_each_sample(index, [&](const typename SampledPoints<dim>::Sample &sample) {
      const int side = cube.wall.slab.side(sample.place.point);
      clear          = clear && side != 0;
      for (unsigned int d = 0; d < dim; ++d)
        clear = clear && sample.place.point[d] >= cube.wall.lower[d] &&
                sample.place.point[d] <= cube.wall.upper[d];
      if (!clear)
        return;
      const unsigned int k = side > 0 ? 1 : 0;
      sums[k] += sample.measure * sample.value;
      totals[k] += sample.measure;
      ++cube.views[k].n_samples[corner];
    });
    for (const unsigned int k : {0, 1})
      if (totals[k] > 0)
        cube.views[k].values[corner] = sums[k] / totals[k];
    return clear;
  }


  template <int dim>
  const typename PartedCubes<dim>::View *
  PartedCubes<dim>::view(const GridIndex<dim> &lower, const dealii::Point<dim> &eye) const
  {
    const auto &cube = cubes[cube_above[box.position(lower)]];
    if (&cube == &cubes[0])
      return nullptr;
    for (unsigned int d = 0; d < dim; ++d)
      if (eye[d] < cube.wall.lower[d] || eye[d] > cube.wall.upper[d])
        return nullptr;
    const int side = cube.wall.slab.side(eye);
    return side == 0 ? nullptr : &cube.views[side > 0 ? 1 : 0];
  }


  template class PartedCubes<2>;
  template class PartedCubes<3>;
} // namespace undine
