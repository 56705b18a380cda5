// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/sampled_regions.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <limits>
#include <map>

namespace undine
{
  namespace
  {
    /// Where no bin is.
    template <int dim>
    GridIndex<dim>
    nowhere()
    {
      return all_directions<dim>(-1);
    }
  } // namespace


  template <int dim>
  SampledRegions<dim>::SampledRegions(const dealii::Point<dim>     &lower,
                                      const dealii::Tensor<1, dim> &widths,
                                      const CornerWindings         &corner_windings,
                                      const dealii::Tensor<1, dim> &lower_shifts,
                                      const std::vector<Simplex>   &simplices)
    : lower(lower)
    , widths(widths)
    , samples{{}, all_directions<dim>(n_along)}
  {
    add_facets(simplices);
    find_relative_windings();
    const int first = first_winding(corner_windings, lower_shifts);
    for (int &winding : windings)
      {
        winding += first;
        region_of.push_back(winding == 0 ? -2 : -1);
      }
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
  GridIndex<dim>
  SampledRegions<dim>::bin(const dealii::Point<dim> &place) const
  {
    GridIndex<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = static_cast<int>(
        std::clamp((place[d] - lower[d]) / widths[d] * n_along, 0., double(n_along - 1)));
    return result;
  }


  template <int dim>
  void
  SampledRegions<dim>::add_facets(const std::vector<Simplex> &simplices)
  {
    constexpr double margin = 1e-9; // in widths of the box
    facets.reserve(simplices.size());
    facets_in.resize(samples.size());
    for (const auto &nodes : simplices)
      {
        auto least = nodes[0], most = nodes[0];
        for (const auto &node : nodes)
          for (unsigned int d = 0; d < dim; ++d)
            {
              least[d] = std::min(least[d], node[d] - margin * widths[d]);
              most[d]  = std::max(most[d], node[d] + margin * widths[d]);
            }
        IndexBox<dim> bins{bin(least), bin(most)};
        for (int &upper : bins.upper.values)
          ++upper;
        for_each(bins, [&](const GridIndex<dim> &index) {
          facets_in[samples.position(index)].push_back(facets.size());
        });
        facets.push_back({nodes, area_vector(nodes), bins});
      }
  }


  /// 1: the segment enters the solid through the facet, -1: it leaves it, 0: it passes it by.
  template <int dim>
  int
  SampledRegions<dim>::crossing(const Facet              &facet,
                                const dealii::Point<dim> &from,
                                const dealii::Point<dim> &to)
  {
    const double before = (from - facet.nodes[0]) * facet.normal;
    const double after  = (to - facet.nodes[0]) * facet.normal;
    if ((before > 0) == (after > 0) ||
        !contains(facet.nodes, from + before / (before - after) * (to - from)))
      return 0;
    return before > 0 ? 1 : -1;
  }


  template <int dim>
  int
  SampledRegions<dim>::crossings(const dealii::Point<dim> &from,
                                 const dealii::Point<dim> &to,
                                 const GridIndex<dim>     &here,
                                 const GridIndex<dim>     &counted) const
  {
    int result = 0;
    for (const int f : facets_in[samples.position(here)])
      if (!facets[f].bins.contains(counted))
        result += crossing(facets[f], from, to);
    return result;
  }


  template <int dim>
  bool
  SampledRegions<dim>::are_joined(const GridIndex<dim> &one, const GridIndex<dim> &other) const
  {
    const auto from = sample(one), to = sample(other);
    for (const auto &index : {one, other})
      for (const int f : facets_in[samples.position(index)])
        if (crossing(facets[f], from, to) != 0)
          return false;
    return true;
  }


  template <int dim>
  bool
  SampledRegions<dim>::sees(const dealii::Point<dim> &place, const GridIndex<dim> &index) const
  {
    const auto there = sample(index);
    return std::none_of(facets.begin(), facets.end(), [&](const Facet &facet) {
      return crossing(facet, place, there) != 0;
    });
  }


  template <int dim>
  void
  SampledRegions<dim>::find_relative_windings()
  {
    windings.reserve(samples.size());
    for_each(samples, [&](const GridIndex<dim> &index) {
      unsigned int axis = 0;
      while (axis < dim && index[axis] == 0)
        ++axis;
      if (axis == dim)
        {
          windings.push_back(0);
          return;
        }
      const auto before = moved(index, axis, -1);
      const auto from = sample(before), here = sample(index);
      windings.push_back(windings[samples.position(before)] +
                         crossings(from, here, before, nowhere<dim>()) +
                         crossings(from, here, index, before));
    });
  }


  template <int dim>
  bool
  SampledRegions<dim>::has_facet_near(const dealii::Point<dim> &place) const
  {
    constexpr double near        = 1e-6; // in widths of the box
    const auto      &facets_here = facets_in[samples.position(bin(place))];
    return std::any_of(facets_here.begin(), facets_here.end(), [&](const int f) {
      for (unsigned int d = 0; d < dim; ++d)
        {
          bool all_below = true, all_above = true;
          for (const auto &node : facets[f].nodes)
            {
              all_below = all_below && node[d] < place[d] - near * widths[d];
              all_above = all_above && node[d] > place[d] + near * widths[d];
            }
          if (all_below || all_above)
            return false;
        }
      return true;
    });
  }


  template <int dim>
  int
  SampledRegions<dim>::first_winding(const CornerWindings         &corner_windings,
                                     const dealii::Tensor<1, dim> &lower_shifts) const
  {
    std::map<int, int> votes;
    for (unsigned int corner = 0; corner < corner_windings.size(); ++corner)
      {
        auto   place    = lower;
        auto   here     = samples.lower;
        double distance = 1e-11; // less along lower axes
        for (unsigned int d = 0; d < dim; ++d, distance *= 10)
          {
            const int    end   = (corner >> d) & 1;
            const double shift = end == 0 ? lower_shifts[d] : -1;
            place[d] += (end + shift * distance) * widths[d];
            here[d] = end * (n_along - 1);
          }
        const int relative =
          windings[samples.position(here)] + crossings(sample(here), place, here, nowhere<dim>());
        // Facets that lie in the sides of the box may be missed by the segment to a corner on them.
        if (!has_facet_near(place))
          return corner_windings[corner] - relative;
        ++votes[corner_windings[corner] - relative];
      }
    const auto fewer = [](const auto &a, const auto &b) { return a.second < b.second; };
    return std::max_element(votes.begin(), votes.end(), fewer)->first;
  }


  template <int dim>
  int
  SampledRegions<dim>::winding(const dealii::Point<dim> &place) const
  {
    const auto here = bin(place);
    return windings[samples.position(here)] + crossings(sample(here), place, here, nowhere<dim>());
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
              if (!samples.contains(next) || region_of[samples.position(next)] != -2 ||
                  !are_joined(index, next))
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
    if (all_regions.size() < 2)
      return static_cast<int>(all_regions.size()) - 1;
    struct Nearest
    {
      int    region   = -1;
      double distance = std::numeric_limits<double>::max();
    };
    Nearest seen, any;
    for_each(samples, [&](const GridIndex<dim> &index) {
      const int region = region_of[samples.position(index)];
      if (region < 0)
        return;
      const double distance = sample(index).distance_square(place);
      if (distance < any.distance)
        any = {region, distance};
      if (distance < seen.distance && sees(place, index))
        seen = {region, distance};
    });
    return seen.region >= 0 ? seen.region : any.region;
  }


  template class SampledRegions<2>;
  template class SampledRegions<3>;
} // namespace undine
