// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_configurations_h
#define undine_tests_cutting_configurations_h

#include <surface/balls.h>

#include <algorithm>
#include <string>

namespace undine_tests
{
  /// Bodies in the box [0,12] x [0,10] (x [0,11]), and the fluid regions that they leave.
  template <int dim>
  struct Configuration
  {
    Bodies<dim>         bodies;
    std::vector<double> regions;       ///< volumes of all fluid regions but the outer one
    int                 n_regions = 1; ///< 0: not known
  };


  /// Cells along each axis.
  template <int dim>
  std::array<int, dim>
  box_cells()
  {
    constexpr std::array<int, 3> cells{{12, 10, 11}};
    std::array<int, dim>         result;
    std::copy_n(cells.begin(), dim, result.begin());
    return result;
  }


  /// Offsets that like places where something coincides.
  inline double
  offset(Random &random)
  {
    const double whole       = random.below(3);
    const double fractions[] = {0,
                                0,
                                0,
                                1e-16,
                                -1e-16,
                                4e-15,
                                -4e-15,
                                1e-12,
                                -1e-12,
                                1e-9,
                                -1e-9,
                                .5,
                                .25,
                                random.between(0, 1),
                                random.between(0, 1)};
    return whole + fractions[random.below(15)];
  }


  inline double
  thickness(Random &random)
  {
    const double choices[] = {
      1e-12, 1e-12, 1e-11, 1e-9, 1e-6, 1e-3, random.power(-12, .3), random.power(-12, .3), 1, 2};
    return choices[random.below(10)];
  }


  /// Move what lies around the origin to the middle of the box, more or less.
  template <int dim>
  void
  place(Bodies<dim> &bodies, Random &random)
  {
    dealii::Tensor<1, dim> distance;
    for (unsigned int d = 0; d < dim; ++d)
      distance[d] = box_cells<dim>()[d] * .5 - 1.5 + offset(random);
    bodies.shift(distance);
  }


  template <int dim>
  std::array<int, dim>
  random_cells(Random &random, const int n)
  {
    std::array<int, dim> result;
    for (int &cells : result)
      cells = 1 + random.below(n);
    return result;
  }


  /// A sheet of thickness w along a curve: x[0] runs along it, the last coordinate across; in 3D
  /// it is extruded by x[1]. Curve(s) gives place and normal in the plane.
  template <int dim, class Curve>
  Bodies<dim>
  sheet_along(const Curve &curve, const int n_along, const double w, Random &random)
  {
    auto cells         = random_cells<dim>(random, 9);
    cells[0]           = n_along;
    cells[dim - 1]     = 1;
    const double width = random.between(.5, 4);
    return lattice<dim>(cells, [&](const dealii::Point<dim> &x) {
      const auto         at = curve(x[0]); // place, normal
      const double       h  = (x[dim - 1] - .5) * w;
      dealii::Point<dim> result;
      for (unsigned int d = 1; d + 1 < dim; ++d)
        result[d] = width * (x[d] - .5);
      result[0]       = at[0][0] + h * at[1][0];
      result[dim - 1] = at[0][1] + h * at[1][1];
      return result;
    });
  }


  using PlaceAndNormal = std::array<dealii::Point<2>, 2>;


  /// A sine wave, a U or, in `spiral`, seven turns.
  template <int dim>
  Bodies<dim>
  wave(Random &random)
  {
    const double w = std::min(thickness(random), 1e-2), length = random.between(2, 5);
    const double amplitude = random.between(.1, .8), frequency = random.between(.5, 2);
    return sheet_along<dim>(
      [&](const double s) {
        const double t     = length * (s - .5);
        const double slope = amplitude * frequency * std::cos(frequency * t);
        const double size  = std::hypot(1, slope);
        return PlaceAndNormal{
          {{t, amplitude * std::sin(frequency * t)}, {-slope / size, 1 / size}}};
      },
      20 + random.below(30),
      w,
      random);
  }


  template <int dim>
  Bodies<dim>
  hairpin(Random &random)
  {
    const double w = std::min(thickness(random), 1e-2), length = random.between(2, 5);
    const double radius   = random.between(.02, .5) + w;
    const double straight = std::max((length - M_PI * radius) / 2, .2);
    const double total    = 2 * straight + M_PI * radius;
    return sheet_along<dim>(
      [&](const double s) {
        const double a = s * total;
        if (a < straight)
          return PlaceAndNormal{{{a - straight, -radius}, {0, 1}}};
        if (a > straight + M_PI * radius)
          return PlaceAndNormal{{{total - a - straight, radius}, {0, -1}}};
        const double angle = (a - straight) / radius - M_PI / 2;
        return PlaceAndNormal{{{radius * std::cos(angle), radius * std::sin(angle)},
                               {-std::cos(angle), -std::sin(angle)}}};
      },
      20 + random.below(30),
      w,
      random);
  }


  template <int dim>
  Bodies<dim>
  spiral(Random &random)
  {
    const double w      = std::min(thickness(random), 1e-3);
    const double pitch  = random.between(.03, .12) + w;
    auto         result = sheet_along<dim>(
      [&](const double s) {
        const double turns = 7 * s, angle = 2 * M_PI * turns;
        const double r = .15 + 2 * pitch * turns;
        return PlaceAndNormal{
          {{r * std::cos(angle), r * std::sin(angle)}, {std::cos(angle), std::sin(angle)}}};
      },
      7 * 24,
      w,
      random);
    return result.without_parts();
  }


  /// A height field with nodes on nodes of the grid and heights that are multiples of 1/2, 1/4 or
  /// 1e-13: saddles, folds and flats exactly on planes.
  template <int dim>
  Bodies<dim>
  egg_box(Random &random, const int n_layers)
  {
    auto cells           = random_cells<dim>(random, 4);
    cells[0]             = 2 + random.below(5);
    cells[dim - 1]       = 1;
    const double units[] = {1, .5, .25, 1e-13};
    const double unit = units[random.below(4)], step = random.below(3) > 0 ? 1. : .5;
    const double w = std::min(thickness(random), .1), gap = random.power(-10, -2);
    const int    axis = random.below(dim);
    std::map<std::array<int, dim - 1>, double> heights;
    double                                     base = 2;
    Bodies<dim>                                result;
    for (int layer = 0; layer < n_layers; ++layer, base += w + gap)
      result.append(lattice<dim>(cells, [&](const dealii::Point<dim> &x) {
        std::array<int, dim - 1> column;
        dealii::Point<dim>       at;
        for (unsigned int d = 0; d + 1 < dim; ++d)
          {
            column[d]                = std::lround(x[d] * cells[d]);
            at[(axis + 1 + d) % dim] = 2 + column[d] * step;
          }
        const auto height = heights.emplace(column, 0.);
        if (height.second)
          height.first->second = random.below(4) * unit;
        at[axis] = base + height.first->second + x[dim - 1] * w;
        return at;
      }));
    return result;
  }


  /// A ball with nodes moved to multiples of 1/2 ... 1/8, still star-shaped around the origin.
  template <int dim>
  Bodies<dim>
  snapped_star(Random &random)
  {
    for (;;)
      {
        auto         result = ball<dim>(1 + random.below(2), random.between(1.2, 2.6));
        const double grid = 2 << random.below(3), rough = random.below(2) * random.between(0, .5);
        result.rotate(random);
        for (auto &x : result.nodes)
          {
            const double factor = 1 + rough * random.between(-1, 1);
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = std::round(x[d] * factor * grid) / grid;
          }
        const auto surface = result.surface();
        bool       star    = true;
        for (unsigned int f = 0; f < result.facets.size(); ++f)
          star = star && undine::area_vector(surface, f, result.nodes) *
                             dealii::Tensor<1, dim>(result.nodes[result.facets[f][0]]) >
                           5e-4;
        if (star)
          return result;
      }
  }


  /// Volume of a surface of one body.
  template <int dim>
  double
  size_of(const Bodies<dim> &bodies)
  {
    return std::abs(bodies.volume());
  }
} // namespace undine_tests

#endif
