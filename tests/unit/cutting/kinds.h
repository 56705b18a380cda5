// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_kinds_h
#define undine_tests_cutting_kinds_h

#include <cutting/configurations.h>

namespace undine_tests
{
  /// A kind of configuration, by name.
  template <int dim>
  struct Kind
  {
    std::string                                 name;
    std::function<Configuration<dim>(Random &)> make;
  };


  template <int dim>
  Configuration<dim>
  placed(Bodies<dim> bodies, Random &random)
  {
    bodies.rotate(random);
    place(bodies, random);
    return {bodies, {}, 1};
  }


  template <int dim>
  Configuration<dim>
  flat_sheet(Random &random)
  {
    auto               cells = random_cells<dim>(random, 12);
    dealii::Point<dim> half;
    for (unsigned int d = 0; d < dim; ++d)
      half[d] = random.between(.05, 2.2);
    cells[dim - 1] = 1;
    half[dim - 1]  = thickness(random) / 2;
    return placed(box<dim>(-half, half, cells), random);
  }


  /// A box exactly on planes or halfway between them.
  template <int dim>
  Configuration<dim>
  aligned_box(Random &random)
  {
    dealii::Point<dim>   lower, upper;
    std::array<int, dim> cells;
    const double         lengths[] = {1e-12, 1e-9, 1e-3, .5, 1, 2, 3, 4, 5};
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = 1 + random.below(4) + (random.below(4) == 0 ? .5 : 0);
        upper[d] = lower[d] + lengths[random.below(9)];
        cells[d] = 1 + random.below(5);
        if (random.below(2) == 1)
          cells[d] = std::max(1, static_cast<int>(upper[d] - lower[d]));
      }
    return {box<dim>(lower, upper, cells, &random).without_parts(), {}, 1};
  }


  /// Turned by 45 degrees, nodes on nodes of the grid.
  template <int dim>
  Configuration<dim>
  diagonal_box(Random &random)
  {
    dealii::Point<dim>   half = all_equal<dim>(1.);
    std::array<int, dim> cells;
    cells.fill(2);
    half[0]          = 2;
    cells[0]         = 4;
    auto      bodies = box<dim>(-half, half, cells, &random).without_parts();
    const int a = random.below(dim), b = (a + 1) % dim;
    for (auto &x : bodies.nodes)
      {
        const double u = x[a], v = x[b];
        x[a] = u - v;
        x[b] = u + v;
      }
    return {bodies.orient().shift(all_equal<dim>(5.) - dealii::Point<dim>()), {}, 1};
  }


  /// Several small bodies, many of them in one cell.
  template <int dim>
  Configuration<dim>
  tiny_bodies(Random &random)
  {
    Bodies<dim> bodies;
    int         n = 1;
    for (int d = 0; d < dim; ++d)
      n *= 3;
    for (int i = 0; i < n; ++i)
      {
        const double r = random.between(.02, .17);
        auto         body =
          random.below(2) == 0
                    ? ball<dim>(random.below(2), r)
                    : box<dim>(all_equal<dim>(-r / 2), all_equal<dim>(r / 2), random_cells<dim>(random, 2));
        if (random.below(2) == 1)
          body.rotate(random);
        dealii::Tensor<1, dim> distance;
        for (int d = 0, rest = i; d < dim; ++d, rest /= 3)
          distance[d] = .4 * (rest % 3);
        bodies.append(body.without_parts().shift(distance));
      }
    place(bodies, random);
    return {bodies, {}, 1};
  }


  /// Thin closed shells, one in the other.
  template <int dim>
  Configuration<dim>
  shells(Random &random)
  {
    const double w = std::min(thickness(random), .1), gap = random.power(-10, -1);
    const int    n = 1 + random.below(3), type = random.below(3);
    double       radius = type == 2 ? 1 + random.below(2) : random.between(.2, 1.5);
    auto         base   = type == 0
                            ? ball<dim>(random.below(4), 1.)
                            : box<dim>(all_equal<dim>(-1.), all_equal<dim>(1.), random_cells<dim>(random, 5));
    base.without_parts();
    if (type != 2)
      base.rotate(random);
    Configuration<dim> result;
    double             cavity = 0, outer = 0;
    for (int i = 0; i < n; ++i)
      {
        auto inner = base, shell = base;
        inner.scale(radius);
        shell.scale(radius + w);
        cavity = size_of(inner);
        result.regions.push_back(cavity - outer);
        outer = size_of(shell);
        result.bodies.append(shell);
        result.bodies.append_cavity(inner);
        radius += w + gap;
      }
    place(result.bodies, random);
    result.n_regions = n + 1;
    return result;
  }


  template <int dim>
  Configuration<dim>
  parallel_sheets(Random &random)
  {
    const double         gap = random.power(-10, -2), w = std::min(thickness(random), .1);
    dealii::Point<dim>   lower, upper;
    std::array<int, dim> cells;
    for (unsigned int d = 0; d + 1 < dim; ++d)
      {
        upper[d] = random.between(.15, 2.2);
        lower[d] = -upper[d];
      }
    Bodies<dim> bodies;
    double      at = 0;
    for (int i = 0, n = 2 + random.below(2); i < n; ++i, at += w + gap)
      {
        cells          = random_cells<dim>(random, 7);
        cells[dim - 1] = 1;
        lower[dim - 1] = at;
        upper[dim - 1] = at + w;
        bodies.append(box<dim>(lower, upper, cells, &random));
      }
    if (random.below(3) > 0)
      bodies.rotate(random);
    place(bodies, random);
    return {bodies, {}, 1};
  }


  template <int dim>
  Configuration<dim>
  snapped_shell(Random &random)
  {
    auto inner = snapped_star<dim>(random), outer = inner;
    outer.scale(1 + std::min(thickness(random), .1));
    Configuration<dim> result{outer, {size_of(inner)}, 2};
    result.bodies.append_cavity(inner);
    result.bodies.shift(all_equal<dim>(5. + random.below(2)) - dealii::Point<dim>());
    return result;
  }


  /// A hollow body the size of a cell with bodies, some hollow, in its cavity and around.
  template <int dim>
  Configuration<dim>
  nested_bodies(Random &random)
  {
    const double outer_radius = random.between(.3, .9);
    const double radius       = outer_radius - random.power(-12, -1.5);
    const int    level = 1 + random.below(2), m = 1 + random.below(3);
    auto         outer = ball<dim>(level, outer_radius);
    outer.rotate(random);
    auto cavity = outer;
    cavity.scale(radius / outer_radius);

    Configuration<dim> result{outer, {}, 2};
    result.bodies.append_cavity(cavity);
    double       inside = size_of(cavity);
    const double pitch  = (dim == 3 ? .9 : 1.1) * radius / m;
    for (int i = 0; i < std::lround(std::pow(m, dim)); ++i)
      {
        const double r = pitch * random.between(.05, .45);
        auto         body =
          random.below(2) == 0
                    ? ball<dim>(random.below(2), r)
                    : box<dim>(all_equal<dim>(-r / 2), all_equal<dim>(r / 2), random_cells<dim>(random, 1));
        dealii::Tensor<1, dim> distance;
        for (int d = 0, rest = i; d < dim; ++d, rest /= m)
          distance[d] = (rest % m - .5 * (m - 1)) * pitch;
        body.without_parts().rotate(random).shift(distance);
        auto hole = body;
        hole.shift(-distance).scale(.7).shift(distance);
        inside -= size_of(body);
        result.bodies.append(body);
        if (random.below(3) == 0)
          {
            result.bodies.append_cavity(hole);
            result.regions.push_back(size_of(hole));
            ++result.n_regions;
          }
      }
    result.regions.push_back(inside);
    for (int side = 0; side < 2 * dim; ++side)
      {
        auto                   body = ball<dim>(random.below(2), .12 * outer_radius);
        dealii::Tensor<1, dim> distance;
        distance[side / 2] = (side % 2 == 0 ? -1.15 : 1.15) * outer_radius;
        result.bodies.append(body.rotate(random).shift(distance));
      }
    place(result.bodies, random);
    return result;
  }


  /// Two boxes in exact contact, divided differently.
  template <int dim>
  Configuration<dim>
  touching_boxes(Random &random)
  {
    auto lower = all_equal<dim>(-1.), upper = all_equal<dim>(1.);
    upper[0]    = 0;
    auto bodies = box<dim>(lower, upper, random_cells<dim>(random, 4), &random);
    lower[0]    = 0;
    upper[0]    = 1;
    bodies.append(box<dim>(lower, upper, random_cells<dim>(random, 4), &random));
    bodies.without_parts();
    if (random.below(2) == 1)
      bodies.rotate(random);
    place(bodies, random);
    return {bodies, {}, 1};
  }


  /// Kinds that only one dimension has. @{
  inline void
  add_kinds(std::vector<Kind<2>> &)
  {
  }

  inline void
  add_kinds(std::vector<Kind<3>> &kinds)
  {
    kinds.push_back({"torus", [](Random &random) {
                       const double radius = random.between(.3, 1.9);
                       return placed(torus(5 + random.below(20),
                                           4 + random.below(12),
                                           radius,
                                           radius * random.between(.05, .8)),
                                     random);
                     }});
  }
  /// @}


  template <int dim>
  std::vector<Kind<dim>>
  kinds()
  {
    std::vector<Kind<dim>> result{
      {"sheet", flat_sheet<dim>},
      {"wave", [](Random &r) { return placed(wave<dim>(r), r); }},
      {"hairpin", [](Random &r) { return placed(hairpin<dim>(r), r); }},
      {"spiral", [](Random &r) { return placed(spiral<dim>(r), r); }},
      {"aligned box", aligned_box<dim>},
      {"diagonal box", diagonal_box<dim>},
      {"ball", [](Random &r) { return placed(ball<dim>(r.below(4), r.power(-2, .55)), r); }},
      {"ball on nodes",
       [](Random &r) {
         Configuration<dim> result{ball<dim>(r.below(3), 1 + r.below(3)), {}, 1};
         place(result.bodies, r);
         return result;
       }},
      {"tiny bodies", tiny_bodies<dim>},
      {"shells", shells<dim>},
      {"parallel sheets", parallel_sheets<dim>},
      {"egg box",
       [](Random &r) {
         return Configuration<dim>{egg_box<dim>(r, 1), {}, 1};
       }},
      {"egg boxes",
       [](Random &r) {
         return Configuration<dim>{egg_box<dim>(r, 2 + r.below(3)), {}, 1};
       }},
      {"snapped star",
       [](Random &r) {
         Configuration<dim> result{snapped_star<dim>(r), {}, 1};
         result.bodies.shift(all_equal<dim>(5. + r.below(2)) - dealii::Point<dim>());
         return result;
       }},
      {"snapped shell", snapped_shell<dim>},
      {"nested bodies", nested_bodies<dim>},
      {"touching boxes", touching_boxes<dim>}};
    add_kinds(result);
    return result;
  }
} // namespace undine_tests

#endif
