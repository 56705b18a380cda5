// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_surface_bodies_h
#define undine_tests_surface_bodies_h

#include <undine/surface/surface.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace undine_tests
{
  using undine::Surface;

  /// Random numbers that are the same with every standard library.
  class Random
  {
  public:
    explicit Random(const std::uint64_t seed)
      : engine(seed)
    {
    }

    double
    between(const double lower, const double upper)
    {
      return lower + (upper - lower) * (engine() >> 11) * 0x1p-53;
    }

    /// 0 .. n - 1
    int
    below(const int n)
    {
      return engine() % n;
    }

    double
    power(const double lower, const double upper)
    {
      return std::pow(10., between(lower, upper));
    }

  private:
    std::mt19937_64 engine;
  };


  /// What a facet of a sheet belongs to.
  enum class Part
  {
    other,
    lower,
    upper,
    rim
  };


  /// Closed surfaces of one or more bodies.
  template <int dim>
  struct Bodies
  {
    std::vector<dealii::Point<dim>>        nodes;
    std::vector<std::array<unsigned, dim>> facets;
    std::vector<unsigned>                  bodies; ///< of each facet
    std::vector<Part>                      parts;  ///< of each facet
    unsigned                               n_bodies = 0;

    Surface<dim>
    surface() const
    {
      std::vector<std::string> names;
      for (unsigned b = 0; b < n_bodies; ++b)
        names.push_back("body " + std::to_string(b));
      return Surface<dim>(nodes.size(), facets, bodies, names);
    }

    void
    add_facet(const std::array<unsigned, dim> &facet, const Part part = Part::other)
    {
      n_bodies = 1;
      facets.push_back(facet);
      bodies.push_back(0);
      parts.push_back(part);
    }

    void
    flip()
    {
      for (auto &facet : facets)
        std::swap(facet[0], facet[1]);
    }

    /// Volume in all.
    double
    volume() const
    {
      double sum = 0;
      for (const double v : undine::body_volumes(surface(), nodes))
        sum += v;
      return sum;
    }

    Bodies &
    orient()
    {
      if (volume() < 0)
        flip();
      return *this;
    }

    template <class Map>
    Bodies &
    map(const Map &function)
    {
      for (auto &node : nodes)
        node = function(node);
      return *this;
    }

    Bodies &
    shift(const dealii::Tensor<1, dim> &distance)
    {
      return map([&](const dealii::Point<dim> &x) { return x + distance; });
    }

    Bodies &
    scale(const double factor)
    {
      return map([&](const dealii::Point<dim> &x) { return dealii::Point<dim>(factor * x); });
    }

    Bodies &
    without_parts()
    {
      std::fill(parts.begin(), parts.end(), Part::other);
      return *this;
    }

    /// A random rotation: the product of rotations in all coordinate planes.
    Bodies &
    rotate(Random &random)
    {
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = a + 1; b < dim; ++b)
          {
            const double angle = random.between(0, 2 * M_PI);
            const double c = std::cos(angle), s = std::sin(angle);
            for (auto &x : nodes)
              {
                const double u = x[a], v = x[b];
                x[a] = c * u - s * v;
                x[b] = s * u + c * v;
              }
          }
      return *this;
    }

    /// Append bodies of their own.
    void
    append(const Bodies &other)
    {
      append_to_body(other, n_bodies);
      n_bodies += other.n_bodies;
    }

    /// Append as further boundaries of body `first`, such as the wall of a cavity.
    void
    append_to_body(const Bodies &other, const unsigned first)
    {
      for (std::size_t f = 0; f < other.facets.size(); ++f)
        {
          auto facet = other.facets[f];
          for (auto &node : facet)
            node += nodes.size();
          facets.push_back(facet);
          bodies.push_back(first + other.bodies[f]);
          parts.push_back(other.parts[f]);
        }
      nodes.insert(nodes.end(), other.nodes.begin(), other.nodes.end());
    }

    /// Append the wall of a cavity in the last body.
    void
    append_cavity(Bodies other)
    {
      other.flip();
      append_to_body(other, n_bodies - 1);
    }
  };


  inline dealii::Point<2>
  all_equal(const double x, std::integral_constant<int, 2>)
  {
    return {x, x};
  }

  inline dealii::Point<3>
  all_equal(const double x, std::integral_constant<int, 3>)
  {
    return {x, x, x};
  }

  /// (x, x, ...)
  template <int dim>
  dealii::Point<dim>
  all_equal(const double x)
  {
    return all_equal(x, std::integral_constant<int, dim>());
  }


  /// Split the side of a lattice cell into facets; corners counter-clockwise from outside. @{
  inline void
  add_side(Bodies<2> &bodies, const std::array<unsigned, 2> &corners, const Part part, const bool)
  {
    bodies.add_facet(corners, part);
  }

  inline void
  add_side(Bodies<3>                     &bodies,
           const std::array<unsigned, 4> &c,
           const Part                     part,
           const bool                     diagonal)
  {
    bodies.add_facet(diagonal ? std::array<unsigned, 3>{{c[1], c[2], c[3]}}
                              : std::array<unsigned, 3>{{c[0], c[1], c[2]}},
                     part);
    bodies.add_facet(diagonal ? std::array<unsigned, 3>{{c[1], c[3], c[0]}}
                              : std::array<unsigned, 3>{{c[0], c[2], c[3]}},
                     part);
  }
  /// @}


  /// The boundary of a lattice of `cells` cells on [0,1]^dim, mapped; `lower` and `upper` are the
  /// sides of the last direction. Diagonals at random if `random` is given.
  template <int dim, class Map>
  Bodies<dim>
  lattice(const std::array<int, dim> &cells, const Map &map, Random *random = nullptr)
  {
    constexpr int                                n_corners = 1 << (dim - 1);
    Bodies<dim>                                  result;
    std::map<std::array<int, dim>, unsigned int> numbers;
    const auto                                   node = [&](const std::array<int, dim> &index) {
      const auto inserted = numbers.emplace(index, result.nodes.size());
      if (inserted.second)
        {
          dealii::Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = static_cast<double>(index[d]) / cells[d];
          result.nodes.push_back(map(place));
        }
      return inserted.first->second;
    };
    for (int axis = 0; axis < dim; ++axis)
      for (int side = 0; side < 2; ++side)
        {
          std::array<int, dim> index{};
          index[axis]     = side * cells[axis];
          const Part part = axis < dim - 1 ? Part::rim : side == 0 ? Part::lower : Part::upper;
          const int  u    = (axis + 1) % dim;
          const int  v    = (axis + 2) % dim; // in 2D the axis itself
          const int  n_v  = dim == 3 ? cells[v] : 1;
          for (int i = 0; i < cells[u]; ++i)
            for (int j = 0; j < n_v; ++j)
              {
                std::array<unsigned, n_corners> corners;
                for (int k = 0; k < n_corners; ++k)
                  {
                    if (dim == 3)
                      index[v] = j + (k >= 2);
                    index[u]   = i + (k == 1 || k == 2);
                    corners[k] = node(index);
                  }
                if ((side == 1) != (dim == 3 || axis == 0))
                  std::swap(corners[1], corners[n_corners - 1 == 1 ? 0 : 3]);
                const bool diagonal = random != nullptr && random->below(2) == 1;
                add_side(result, corners, part, diagonal);
              }
        }
    return result.orient();
  }


  template <int dim>
  Bodies<dim>
  box(const dealii::Point<dim>   &lower,
      const dealii::Point<dim>   &upper,
      const std::array<int, dim> &cells,
      Random                     *random = nullptr)
  {
    return lattice<dim>(
      cells,
      [&](const dealii::Point<dim> &x) {
        dealii::Point<dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = x[d] == 1 ? upper[d] : lower[d] + x[d] * (upper[d] - lower[d]);
        return result;
      },
      random);
  }
} // namespace undine_tests

#endif
