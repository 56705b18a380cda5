// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_operators_immersed_h
#define undine_tests_operators_immersed_h

#include <undine/cutting/cut_block.h>
#include <undine/operators/boundary_flux.h>
#include <undine/operators/cut_topology.h>

#include <cutting/kinds.h>

namespace undine_tests
{
  using namespace undine;

  /// A surface in a grid, cut on all ranks.
  template <int dim>
  struct Immersed
  {
    Immersed(const typename MacGrid<dim>::Planes   &planes,
             const Surface<dim>                    &surface,
             const std::vector<dealii::Point<dim>> &positions,
             const std::array<bool, dim>            periodic = {})
      : grid(MPI_COMM_WORLD, planes, periodic)
      , surface(surface)
      , positions(positions)
      , cut(block_of_rank(grid))
    {
      CutWorkspace<dim> work;
      cut_block(cut, work, {surface, positions}, grid.cells()->blocks());
      parts = make_cut_topology(grid, cut);
    }

    const FluidTopology<dim> &
    open() const
    {
      return *parts.open;
    }

    /// A number between -1 and 1 for each component of open(), the same on all ranks.
    std::vector<double>
    scattered() const
    {
      std::vector<double> result;
      const auto         &components = open().cells.all();
      for (unsigned int k = 0; k < components.size(); ++k)
        {
          const auto cell = grid.cells()->wrapped(components[k].index);
          double     sum  = k - open().cells.first(components[k].index);
          for (unsigned int d = 0; d < dim; ++d)
            sum = std::sin(12.9898 * sum + 78.233 * (cell[d] + 1) * (d + 1));
          result.push_back(sum);
        }
      return result;
    }

    /// Sum over the pieces of component's faces of +- a v for velocity v, added up for the owned
    /// components: D v.
    std::vector<double>
    divergence(const dealii::Tensor<1, dim> &velocity) const
    {
      std::vector<double> result(open().cells.all().size(), 0.);
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (unsigned int k = 0; k < open().pieces[axis].size(); ++k)
          for (const int end : {0, 1})
            if (const int c = open().pieces[axis][k].components[end]; c >= 0)
              result[c] +=
                (end == 0 ? 1 : -1) * open().faces[axis].all()[k].measure * velocity[axis];
      return result;
    }

    MacGrid<dim>                    grid;
    Surface<dim>                    surface;
    std::vector<dealii::Point<dim>> positions;
    CutCells<dim>                   cut;
    CutTopology<dim>                parts;
  };


  /// The random bodies of a kind, in a grid stretched with them.
  template <int dim>
  Bodies<dim>
  bodies_of_kind(const std::string &name, Random &random)
  {
    for (const auto &kind : kinds<dim>())
      if (kind.name == name)
        return kind.make(random).bodies;
    throw std::runtime_error("no kind " + name);
  }


  /// int f N_i n dGamma over the uncut facets, n into the solid, by quadrature.
  template <int dim, class Function>
  std::vector<dealii::Tensor<1, dim>>
  forces_by_quadrature(const Surface<dim>                    &surface,
                       const std::vector<dealii::Point<dim>> &positions,
                       const Function                        &f)
  {
    // Exact for quadratic polynomials: the values on the way from each node to the middle.
    const double                        near = dim == 2 ? (1 + std::sqrt(1. / 3)) / 2 : 2. / 3;
    std::vector<dealii::Tensor<1, dim>> result(surface.n_nodes());
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      {
        const auto &nodes  = surface.facets()[facet];
        const auto  normal = -area_vector(surface, facet, positions);
        for (unsigned int q = 0; q < dim; ++q)
          {
            dealii::Point<dim> place;
            const auto         weight = [&](const unsigned int k) {
              return k == q ? near : (1 - near) / (dim - 1);
            };
            for (unsigned int k = 0; k < dim; ++k)
              place += weight(k) * positions[nodes[k]];
            for (unsigned int k = 0; k < dim; ++k)
              result[nodes[k]] += f(place) * weight(k) / dim * normal;
          }
      }
    return result;
  }


  /// All coordinates between -size and size.
  template <int dim>
  dealii::Point<dim>
  random_point(Random &random, const double size)
  {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = random.between(-size, size);
    return result;
  }


  template <int dim>
  double
  largest_norm(const std::vector<dealii::Tensor<1, dim>> &values)
  {
    double result = 0;
    for (const auto &value : values)
      result = std::max(result, value.norm());
    return result;
  }


  template <int dim>
  double
  largest_difference(std::vector<dealii::Tensor<1, dim>>        a,
                     const std::vector<dealii::Tensor<1, dim>> &b)
  {
    for (unsigned int k = 0; k < a.size(); ++k)
      a[k] -= b[k];
    return largest_norm(a);
  }
} // namespace undine_tests

#endif
