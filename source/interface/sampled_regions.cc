// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/sampled_regions.h>
#include <undine/interface/simplex.h>

#include <limits>

namespace undine
{
  template <int dim>
  SampledRegions<dim>::SampledRegions(const dealii::Point<dim>     &lower,
                                      const dealii::Tensor<1, dim> &widths,
                                      const int                     corner_winding,
                                      const dealii::Tensor<1, dim> &shifts,
                                      const std::vector<Simplex>   &simplices)
    : lower(lower)
    , widths(widths)
    , corner_winding(corner_winding)
    , shifts(shifts)
    , simplices(simplices)
    , samples{{}, all_directions<dim>(n_along)}
  {
    region_of.reserve(samples.size());
    for_each(samples, [&](const GridIndex<dim> &index) {
      region_of.push_back(winding(sample(index)) == 0 ? -2 : -1);
    });
    for_each(samples, [&](const GridIndex<dim> &index) {
      if (region_of[samples.position(index)] != -2)
        return;
      all_regions.emplace_back();
      flood(index, all_regions.size() - 1);
    });
    for (auto &region : all_regions)
      {
        for (unsigned int d = 0; d < dim; ++d)
          region.centroid[d] /= region.volume; // sums over samples so far
        for (unsigned int d = 0; d < dim; ++d)
          region.volume *= widths[d] / n_along;
      }
  }


  template <int dim>
  dealii::Point<dim>
  SampledRegions<dim>::sample(const GridIndex<dim> &index) const
  {
    // Off the places where bodies like to have their nodes.
    constexpr std::array<double, 3> offset{{0.5257, 0.4851, 0.5123}};
    dealii::Point<dim>              result = lower;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] += (index[d] + offset[d]) / n_along * widths[d];
    return result;
  }


  template <int dim>
  int
  SampledRegions<dim>::winding(const dealii::Point<dim> &place) const
  {
    // The corner as the slabs see it: infinitesimally off its place, along higher axes more so.
    dealii::Point<dim> start    = lower;
    double             distance = 1e-11;
    for (unsigned int d = 0; d < dim; ++d, distance *= 10)
      start[d] += shifts[d] * distance * widths[d];
    int result = corner_winding;
    for (const auto &simplex : simplices)
      {
        const auto   normal = area_vector(simplex);
        const double before = (start - simplex[0]) * normal, after = (place - simplex[0]) * normal;
        if ((before > 0) == (after > 0))
          continue;
        if (contains(simplex, start + before / (before - after) * (place - start)))
          result += before > 0 ? 1 : -1;
      }
    return result;
  }


  template <int dim>
  bool
  SampledRegions<dim>::is_wet(const dealii::Point<dim>     &place,
                              const dealii::Tensor<1, dim> &normal) const
  {
    constexpr double little  = 1e-6; // in widths of the box
    auto             outside = place, inside = place;
    bool             in_box = true;
    for (unsigned int d = 0; d < dim; ++d)
      {
        outside[d] += little * widths[d] * normal[d];
        inside[d] -= little * widths[d] * normal[d];
        in_box = in_box && outside[d] >= lower[d] && outside[d] <= lower[d] + widths[d];
      }
    // A facet in a side of the box: beyond it nothing is known, but here it is the only body.
    return in_box ? winding(outside) == 0 : winding(inside) == 1;
  }


  template <int dim>
  void
  SampledRegions<dim>::flood(const GridIndex<dim> &start, const int region)
  {
    std::vector<GridIndex<dim>> front{start};
    region_of[samples.position(start)] = region;
    while (!front.empty())
      {
        const auto index = front.back();
        front.pop_back();
        all_regions[region].volume += 1;
        all_regions[region].centroid += sample(index) - dealii::Point<dim>();
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (const int step : {-1, 1})
            {
              const auto next = moved(index, axis, step);
              if (!samples.contains(next) || region_of[samples.position(next)] != -2)
                continue;
              region_of[samples.position(next)] = region;
              front.push_back(next);
            }
      }
  }


  template <int dim>
  int
  SampledRegions<dim>::nearest(const dealii::Point<dim> &place) const
  {
    int    result = -1;
    double best   = std::numeric_limits<double>::max();
    for_each(samples, [&](const GridIndex<dim> &index) {
      const int region = region_of[samples.position(index)];
      if (region < 0)
        return;
      const double distance = sample(index).distance_square(place);
      if (distance < best)
        {
          best   = distance;
          result = region;
        }
    });
    return result;
  }


  template class SampledRegions<2>;
  template class SampledRegions<3>;
} // namespace undine
