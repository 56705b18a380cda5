// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_surface_balls_h
#define undine_tests_surface_balls_h

#include <surface/bodies.h>

namespace undine_tests
{
  inline Bodies<2>
  ball(const int level, const double radius, std::integral_constant<int, 2>)
  {
    Bodies<2>      result;
    const unsigned n = 6 << level;
    for (unsigned i = 0; i < n; ++i)
      {
        const double angle = 2 * M_PI * i / n;
        result.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        result.add_facet({{i, (i + 1) % n}});
      }
    return result;
  }


  /// An icosahedron, each triangle divided into four `level` times.
  inline Bodies<3>
  ball(const int level, const double radius, std::integral_constant<int, 3>)
  {
    const double g = (1 + std::sqrt(5.)) / 2;
    Bodies<3>    result;
    result.nodes  = {{-1, g, 0},
                     {1, g, 0},
                     {-1, -g, 0},
                     {1, -g, 0},
                     {0, -1, g},
                     {0, 1, g},
                     {0, -1, -g},
                     {0, 1, -g},
                     {g, 0, -1},
                     {g, 0, 1},
                     {-g, 0, -1},
                     {-g, 0, 1}};
    result.facets = {{{0, 11, 5}}, {{0, 5, 1}},  {{0, 1, 7}},   {{0, 7, 10}}, {{0, 10, 11}},
                     {{1, 5, 9}},  {{5, 11, 4}}, {{11, 10, 2}}, {{10, 7, 6}}, {{7, 1, 8}},
                     {{3, 9, 4}},  {{3, 4, 2}},  {{3, 2, 6}},   {{3, 6, 8}},  {{3, 8, 9}},
                     {{4, 9, 5}},  {{2, 4, 11}}, {{6, 2, 10}},  {{8, 6, 7}},  {{9, 8, 1}}};
    for (int l = 0; l < level; ++l)
      {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](const unsigned a, const unsigned b) {
          const auto inserted = middles.emplace(std::minmax(a, b), result.nodes.size());
          if (inserted.second)
            {
              const dealii::Point<3> x = (result.nodes[a] + result.nodes[b]) / 2.;
              result.nodes.emplace_back(std::sqrt(1 + g * g) / x.norm() * x);
            }
          return inserted.first->second;
        };
        std::vector<std::array<unsigned, 3>> finer;
        for (const auto &t : result.facets)
          {
            const auto a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
            finer.insert(finer.end(),
                         {{{t[0], a, c}}, {{t[1], b, a}}, {{t[2], c, b}}, {{a, b, c}}});
          }
        result.facets.swap(finer);
      }
    for (auto &x : result.nodes)
      x = dealii::Point<3>(radius / x.norm() * x);
    result.bodies.assign(result.facets.size(), 0);
    result.parts.assign(result.facets.size(), Part::other);
    result.n_bodies = 1;
    return result;
  }


  template <int dim>
  Bodies<dim>
  ball(const int level, const double radius)
  {
    return ball(level, radius, std::integral_constant<int, dim>());
  }


  inline Bodies<3>
  torus(const unsigned n_around, const unsigned n_across, const double outer, const double inner)
  {
    Bodies<3> result;
    for (unsigned i = 0; i < n_around; ++i)
      for (unsigned j = 0; j < n_across; ++j)
        {
          const double a = 2 * M_PI * i / n_around, b = 2 * M_PI * j / n_across;
          const double r = outer + inner * std::cos(b);
          result.nodes.emplace_back(r * std::cos(a), r * std::sin(a), inner * std::sin(b));
        }
    for (unsigned i = 0; i < n_around; ++i)
      for (unsigned j = 0; j < n_across; ++j)
        {
          const unsigned k = (i + 1) % n_around, l = (j + 1) % n_across;
          const unsigned a = i * n_across + j, b = k * n_across + j;
          const unsigned c = k * n_across + l, d = i * n_across + l;
          result.add_facet({{a, b, c}});
          result.add_facet({{a, c, d}});
        }
    return result;
  }
} // namespace undine_tests

#endif
