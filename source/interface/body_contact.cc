// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/interface/barrier.h>
#include <undine/interface/body_contact.h>
#include <undine/solid/sparse.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace undine
{
  namespace
  {
    /// A tenth of the facets' size: bodies seem larger by half of it.
    constexpr double share_of_facet = 0.1;


    template <int dim>
    double
    least_modulus(const SolidModel<dim> &solid)
    {
      double result = std::numeric_limits<double>::infinity();
      for (const auto &body : solid.bodies())
        result = std::min(result, body.material->p_wave_modulus());
      return result;
    }
  } // namespace


  template <int dim>
  BodyContact<dim>::BodyContact(const ContactSettings<dim> &given,
                                const SolidModel<dim>      &solid,
                                const FluidModel<dim>      *fluid,
                                const Obstacles<dim>       *obstacles)
    : solid(solid)
    , settings(given)
    , surfaces(given, solid, fluid, obstacles)
  {
    if (settings.gap == 0)
      settings.gap = share_of_facet * surfaces.facet_size();
    if (settings.stiffness == 0)
      settings.stiffness = least_modulus(solid);
  }


  template <int dim>
  BodyContact<dim>::BodyContact(const BodyContact      &all,
                                const SolidModel<dim>  &solid,
                                const BodySurface<dim> &bodies)
    : solid(solid)
    , settings(all.settings)
    , surfaces(all.surfaces, bodies)
  {
  }


  /// Throws SolveError where a gap is closed.
  template <int dim>
  typename BodyContact<dim>::Terms
  BodyContact<dim>::terms(const Places &places) const
  {
    const auto result = find_contact_terms(surfaces, places, settings.gap);
    for (const auto &term : result)
      if (!(term.distance > 0))
        throw SolveError(fmt::format(
          "'{}' runs into {}. Try: a smaller step.",
          surfaces.surface().body_names()[surfaces.surface_of_node(term.nodes[0])],
          term.wall == term.no_wall ? "another body"
                                    : "wall '" + surfaces.walls()[term.wall].name + "'"));
    return result;
  }


  template <int dim>
  double
  BodyContact<dim>::energy(const Terms &terms) const
  {
    double result = 0;
    for (const auto &term : terms)
      result +=
        settings.stiffness * term.area * settings.gap * barrier(term.distance / settings.gap);
    return result;
  }


  template <int dim>
  double
  BodyContact<dim>::energy(const Vector &displacement, const double time) const
  {
    return energy(terms(surfaces.places(displacement, time)));
  }


  template <int dim>
  typename BodyContact<dim>::Forces
  BodyContact<dim>::nodal_forces(const Terms &terms) const
  {
    Forces result(surfaces.bodies().n_nodes());
    for (const auto &term : terms)
      {
        const double slope =
          settings.stiffness * term.area * barrier_slope(term.distance / settings.gap);
        for (unsigned int i = 0; i < term.n; ++i)
          if (term.nodes[i] < result.size())
            result[term.nodes[i]] -= (slope * term.shares[i]) * term.direction;
      }
    return result;
  }


  template <int dim>
  typename BodyContact<dim>::Vector
  BodyContact<dim>::forces(const Vector &displacement, const double time) const
  {
    const auto found = terms(surfaces.places(displacement, time));
    if (found.empty())
      return {};
    Vector result = solid.vector();
    surfaces.bodies().add(result, nodal_forces(found));
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  BodyContact<dim>::nodal_forces(const Vector &displacement, const double time) const
  {
    return nodal_forces(terms(surfaces.places(displacement, time)));
  }


  /// A gets places for all pairs of nodes of different bodies in contact.
  template <int dim>
  void
  BodyContact<dim>::make_room(Matrix &A, const Terms &terms) const
  {
    std::set<std::pair<unsigned int, unsigned int>> needed;
    for (const auto &term : terms)
      for (unsigned int i = 1; i < term.n; ++i)
        if (surfaces.moves(term.nodes[0]) && surfaces.moves(term.nodes[i]))
          needed.insert({term.nodes[0], term.nodes[i]});
    if (needed.empty())
      return;
    const std::vector<std::pair<unsigned int, unsigned int>> list(needed.begin(), needed.end());
    const auto                                              &owned = solid.locally_owned();
    if (list != pairs)
      {
        dealii::DynamicSparsityPattern rows(A.m(), A.n(), owned);
        for (const auto row : owned)
          for (auto entry = A.begin(row); entry != A.end(row); ++entry)
            rows.add(row, entry->column());
        for (const auto &pair : list)
          for (const auto a : surfaces.bodies().dofs_of_node(pair.first))
            for (const auto b : surfaces.bodies().dofs_of_node(pair.second))
              {
                if (owned.is_element(a))
                  rows.add(a, b);
                if (owned.is_element(b))
                  rows.add(b, a);
              }
        pattern.reinit(owned, rows, solid.communicator());
        pairs = list;
      }
    Matrix larger;
    larger.reinit(pattern);
    std::vector<Index>  columns;
    std::vector<double> values;
    for (const auto row : owned)
      {
        columns.clear();
        values.clear();
        for (auto entry = A.begin(row); entry != A.end(row); ++entry)
          {
            columns.push_back(entry->column());
            values.push_back(entry->value());
          }
        larger.add(row, columns.size(), columns.data(), values.data());
      }
    larger.compress(dealii::VectorOperation::add);
    A.reinit(larger);
    add_matrix(A, 1, larger);
  }


  template <int dim>
  void
  BodyContact<dim>::add_stiffness(Matrix       &A,
                                  const double  factor,
                                  const Vector &displacement,
                                  const double  time) const
  {
    const auto places = surfaces.places(displacement, time);
    const auto found  = terms(places);
    if (found.empty())
      return;
    make_room(A, found);
    const auto &owned = solid.locally_owned();
    for (const auto &term : found)
      {
        const double s        = term.distance / settings.gap;
        const double size     = factor * settings.stiffness * term.area;
        const auto   of_nodes = second_derivatives(
          term, places, size * barrier_slope(s), size / settings.gap * barrier_curvature(s));
        for (unsigned int i = 0; i < term.n; ++i)
          for (unsigned int j = 0; j < term.n; ++j)
            if (surfaces.moves(term.nodes[i]) && surfaces.moves(term.nodes[j]))
              for (unsigned int a = 0; a < dim; ++a)
                if (const auto row = surfaces.bodies().dofs_of_node(term.nodes[i])[a];
                    owned.is_element(row))
                  for (unsigned int b = 0; b < dim; ++b)
                    A.add(
                      row, surfaces.bodies().dofs_of_node(term.nodes[j])[b], of_nodes[i][j][a][b]);
      }
    A.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  Columns
  BodyContact<dim>::columns(const Vector &displacement, const double time) const
  {
    const auto             found = terms(surfaces.places(displacement, time));
    double                 least = settings.gap;
    Forces                 forces(surfaces.n_bodies());
    std::set<unsigned int> nodes;
    for (const auto &term : found)
      {
        least = std::min(least, term.distance);
        nodes.insert(term.nodes[0]);
      }
    const auto of_nodes = nodal_forces(found);
    for (unsigned int node = 0; node < of_nodes.size(); ++node)
      forces[surfaces.surface_of_node(node)] += of_nodes[node];

    Columns result{{"contact energy", "J", energy(found)},
                   {"least gap", "m", least},
                   {"nodes in contact", "1", double(nodes.size())}};
    for (unsigned int body = 0; body < forces.size(); ++body)
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back(
          {"contact force " + surfaces.surface().body_names()[body] + " " + "xyz"[axis],
           "N",
           forces[body][axis]});
    return result;
  }


  template class BodyContact<2>;
  template class BodyContact<3>;
} // namespace undine
