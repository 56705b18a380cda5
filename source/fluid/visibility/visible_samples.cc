// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/interpolation.h>
#include <undine/fluid/visibility/visible_samples.h>

#include <limits>

namespace undine
{
  namespace
  {
    /// The least weight of a visible point, which it has even where its multilinear weight is zero
    /// if those with more weight are hidden.
    constexpr double least_weight = 1e-3;

    /// Share of the segment from a point to the centroid of its sub-cell or sub-face: far less than
    /// is smoothed otherwise, far more than rounding.
    constexpr double side_share = 1e-10;

    /// Of a place that rounding alone takes out of a plane of points, in multilinear weights.
    constexpr double in_plane = 1e-12;
  } // namespace


  template <int dim>
  VisibleSamples<dim>::VisibleSamples(const Field<dim>                               &field_,
                                      const std::shared_ptr<VisibilityStencils<dim>> &stencils_,
                                      const BodyVicinity<dim>                        &vicinity_)
    : field(field_)
    , vicinity(vicinity_)
    , stencils(stencils_)
    , points(stencils->points())
    , values(points.values(field))
  {
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::value_of(const GridIndex<dim> &index, const QueryPoint &query) const
  {
    const bool only_nearest = query.own != nullptr && points.inside(index) == *query.own;
    double     sum = 0, total = 0, nearest = std::numeric_limits<double>::infinity();
    points.for_each_sample(index, [&](const auto &sample) {
      if (vicinity.is_hidden(query.place, sample.place))
        return;
      const double distance = only_nearest ? sample.place.point.distance(query.place.point) : 0;
      if (only_nearest && distance >= nearest)
        return;
      if (only_nearest)
        sum = total = 0;
      nearest = distance;
      sum += sample.measure * values[sample.number];
      total += sample.measure;
    });
    return total > 0 ? std::optional<double>(sum / total) : std::nullopt;
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::at(const Place &place) const
  {
    return multilinear(place.point, {place, nullptr});
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::along(const GridIndex<dim>     &index,
                             const dealii::Point<dim> &place,
                             const Place              &foot) const
  {
    const auto      &lattice = field.lattice();
    const auto       point   = lattice.point(index);
    const QueryPoint query{foot, place == point ? nullptr : &index};
    if (foot.point == place)
      if (const auto own = value_of(index, query))
        return own;
    // A tiny share of the segment to the centroid says on which side of the point the fluid is.
    const dealii::Point<dim> start = point + (foot.point - place) + side_share * (place - point);
    if (!is_clear_for_cubics(start, foot))
      return multilinear(start, query);
    const bool is_scalar = lattice.normal_axis() >= dim;
    return interpolate_cubic(field, start, is_scalar ? Overshoot::clipped : Overshoot::kept);
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::mean_around(const GridIndex<dim> &index,
                                   const Place          &place,
                                   const double          whole) const
  {
    double sum = 0, total = 0;
    for (unsigned int d = 0; d < dim; ++d)
      for (const int side : {-1, 1})
        {
          auto neighbour = index;
          neighbour[d] += side;
          if (!points.stored_points().contains(neighbour) ||
              !(points.inside(neighbour) == neighbour))
            continue;
          points.for_each_sample(neighbour, [&](const auto &sample) {
            if (vicinity.is_hidden(place, sample.place))
              return;
            const double weight = points.is_whole(neighbour) ? whole : sample.measure;
            sum += weight * values[sample.number];
            total += weight;
          });
        }
    return total > 0 ? std::optional<double>(sum / total) : std::nullopt;
  }


  template <int dim>
  bool
  VisibleSamples<dim>::is_clear_for_cubics(const dealii::Point<dim> &start,
                                           const Place              &query) const
  {
    if (vicinity.is_next_to_body(query))
      return false;
    GridIndex<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto around = field.lattice().row(d).points_around(start[d]);
        lower[d]          = around.first;
        upper[d]          = around.first + static_cast<int>(around.n_points) - 1;
      }
    const auto below = points.located(lower), above = points.located(upper);
    bool       result = vicinity.is_clear(below.cell, above.cell);
    for (unsigned int d = 0; d < dim; ++d)
      result = result && query.point[d] >= below.point[d] && query.point[d] <= above.point[d];
    return result;
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::multilinear(const dealii::Point<dim> &place, const QueryPoint &query) const
  {
    GridIndex<dim>          lower;
    std::array<double, dim> weights;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto bracket = field.lattice().row(d).locate(place[d]);
        lower[d]           = bracket.lower;
        weights[d]         = bracket.weight;
      }
    if (stencils->is_clear(lower, query.place.point))
      return interpolate(field, place);
    std::array<double, 1 << dim> weight{{1}}; // of corners
    unsigned int                 weighted = 1;
    for (unsigned int d = 0, n = 1; d < dim; ++d, n *= 2)
      {
        for (unsigned int corner = 0; corner < n; ++corner)
          {
            weight[corner + n] = weight[corner] * weights[d];
            weight[corner] *= 1 - weights[d];
          }
        weighted = (weights[d] < 1 ? weighted : 0) | (weights[d] > 0 ? weighted << n : 0);
      }
    double     sum = 0, total = 0, plain_sum = 0, plain_total = 0;
    const auto add = [&](const unsigned int corners) {
      const auto seen = seen_values(lower, query, corners);
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          // No branches, since they could not be predicted. Values of corners that are not visible
          // are zero.
          const double is_seen = seen.corners >> corner & 1;
          sum += weight[corner] * seen.values[corner];
          total += weight[corner] * is_seen;
          plain_sum += seen.values[corner];
          plain_total += is_seen;
        }
    };
    add(weighted);
    if (total > least_weight)
      return sum / total;
    add(~weighted);
    for_each_neighbouring_cube(lower, weights, [&](const auto &other, const unsigned int corners) {
      const auto seen = seen_values(other, query, corners);
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          plain_sum += seen.values[corner];
          plain_total += seen.corners >> corner & 1;
        }
    });
    if (plain_total == 0)
      return {};
    return (sum + least_weight * plain_sum) / (total + least_weight * plain_total);
  }


  /// Is there a point of the lattice along direction d, or one on the boundary beside it?
  template <int dim>
  bool
  VisibleSamples<dim>::is_point(const GridIndex<dim> &index, const unsigned int d) const
  {
    const auto &row = field.lattice().row(d);
    const int   rim = d == field.lattice().normal_axis() ? 0 : 1;
    return row.periodic() || (index[d] >= -rim && index[d] < int(row.size()) + rim);
  }


  /// action(lower, corners) for the cubes that share with the one above `lower` the planes of
  /// points in which a place with these weights lies, and their corners beyond these planes:
  /// neither side may count more than the other, or what is symmetric does not stay so.
  template <int dim>
  template <class Action>
  void
  VisibleSamples<dim>::for_each_neighbouring_cube(const GridIndex<dim>          &lower,
                                                  const std::array<double, dim> &weights,
                                                  const Action                  &action) const
  {
    constexpr unsigned int all           = (1u << (1 << dim)) - 1;
    const auto             upper_corners = [](const unsigned int d) {
      unsigned int result = 0;
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        result |= (corner >> d & 1) << corner;
      return result;
    };
    for (unsigned int across = 1; across < (1u << dim); ++across)
      {
        auto         other = lower, farthest = lower;
        unsigned int corners = all;
        for (unsigned int d = 0; d < dim; ++d)
          if (across >> d & 1)
            {
              const bool in_lower = weights[d]<in_plane, in_upper = weights[d]> 1 - in_plane;
              if (in_lower == in_upper)
                corners = 0;
              other[d] += in_lower ? -1 : 1;
              farthest[d] += in_lower ? -1 : 2;
              corners &= in_lower ? ~upper_corners(d) : upper_corners(d);
              if (!is_point(farthest, d))
                corners = 0;
            }
        if (corners != 0 && points.stored_points().contains(other) &&
            points.stored_points().contains(farthest))
          action(other, corners);
      }
  }


  template <int dim>
  typename VisibilityStencils<dim>::VisibilityStencil
  VisibleSamples<dim>::seen_values(const GridIndex<dim> &lower,
                                   const QueryPoint     &query,
                                   const unsigned int    corners) const
  {
    if (!stencils->is_clear(lower, query.place.point))
      if (const auto stencil =
            stencils->stencil(values, lower, query.place.point, corners, query.own))
        return *stencil;
    typename VisibilityStencils<dim>::VisibilityStencil result{{}, 0};
    for (unsigned int corner = 0; corner < (1u << dim); ++corner)
      {
        if (!(corners >> corner & 1))
          continue;
        auto index = lower;
        for (unsigned int d = 0; d < dim; ++d)
          index[d] += (corner >> d) & 1;
        if (const auto value = value_of(index, query))
          {
            result.values[corner] = *value;
            result.corners |= 1u << corner;
          }
      }
    return result;
  }


  template class VisibleSamples<2>;
  template class VisibleSamples<3>;
} // namespace undine
