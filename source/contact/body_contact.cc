// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/point_text.h>
#include <undine/contact/body_contact.h>
#include <undine/contact/collision_free_fraction.h>
#include <undine/contact/domain_walls.h>
#include <undine/contact/find_overlap.h>
#include <undine/contact/make_contact.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

namespace undine
{
  namespace
  {
    /// A tenth of the facets' size: bodies seem larger by half of it.
    constexpr double distance_over_facet = 0.1;


    template <int dim>
    double
    least_modulus(const SolidModel<dim> &solid)
    {
      double result = std::numeric_limits<double>::infinity();
      for (const auto &body : solid.bodies())
        result = std::min(result, body.material->p_wave_modulus());
      return result;
    }


    /// Those of the scene and, if it wants them, sides of the fluid's domain through which no fluid
    /// passes.
    template <int dim>
    std::vector<ContactWall<dim>>
    all_walls(const ContactSettings<dim> &settings, const FluidModel<dim> *fluid)
    {
      auto result = settings.walls;
      if (fluid && settings.at_domain)
        for (const auto &wall : domain_walls(*fluid))
          if (wall.is_closed)
            result.push_back(wall.plane);
      return result;
    }


    /// The settings, with what the scene leaves to the mesh.
    template <int dim>
    ContactSettings<dim>
    completed(ContactSettings<dim>        settings,
              const SolidModel<dim>      &solid,
              const ContactSurfaces<dim> &surfaces)
    {
      if (settings.activation_distance == 0)
        settings.activation_distance = distance_over_facet * surfaces.facet_size();
      if (settings.stiffness == 0)
        settings.stiffness = least_modulus(solid);
      return settings;
    }


    /// Is it contact of a surface with itself?
    template <int dim>
    bool
    meets_itself(const ContactTerm<dim> &term, const ContactSurfaces<dim> &surfaces)
    {
      return term.n > 1 && surfaces.surface_of_node(term.nodes[0]) ==
                             surfaces.surface_of_node(term.nodes[term.n - 1]);
    }


    /// Pairs of nodes that terms couple and elements may not: those of different surfaces, and of a
    /// surface in contact with itself.
    template <int dim>
    typename ContactPattern<dim>::Pairs
    coupled_pairs(const std::vector<ContactTerm<dim>> &terms, const ContactSurfaces<dim> &surfaces)
    {
      typename ContactPattern<dim>::Pairs result;
      const auto surface = [&](const unsigned int node) { return surfaces.surface_of_node(node); };
      for (const auto &term : terms)
        for (unsigned int i = 0; i < term.n; ++i)
          for (unsigned int j = i + 1; j < term.n; ++j)
            if (surfaces.moves(term.nodes[i]) && surfaces.moves(term.nodes[j]) &&
                (surface(term.nodes[i]) != surface(term.nodes[j]) || meets_itself(term, surfaces)))
              result.insert({term.nodes[i], term.nodes[j]});
      return result;
    }


    /// The rows that this rank owns.
    template <int dim>
    void
    add_to_rows(dealii::TrilinosWrappers::SparseMatrix &A,
                const double                            factor,
                const NodeMatrices<dim>                &of_nodes,
                const ContactTerm<dim>                 &term,
                const ContactSurfaces<dim>             &surfaces,
                const dealii::IndexSet                 &owned)
    {
      const auto                                  &bodies = surfaces.bodies();
      std::vector<dealii::types::global_dof_index> columns;
      std::vector<double>                          values;
      for (unsigned int i = 0; i < term.n; ++i)
        for (unsigned int a = 0; a < dim && surfaces.moves(term.nodes[i]); ++a)
          {
            columns.clear();
            values.clear();
            for (unsigned int j = 0; j < term.n; ++j)
              for (unsigned int b = 0; b < dim && surfaces.moves(term.nodes[j]); ++b)
                for (const auto &share : bodies.shares(term.nodes[j]))
                  {
                    columns.push_back(share.dofs[b]);
                    values.push_back(factor * share.weight * of_nodes[i][j][a][b]);
                  }
            for (const auto &share : bodies.shares(term.nodes[i]))
              if (owned.is_element(share.dofs[a]))
                {
                  auto of_row = values;
                  for (auto &value : of_row)
                    value *= share.weight;
                  A.add(share.dofs[a], columns.size(), columns.data(), of_row.data(), false);
                }
          }
    }
  } // namespace


  template <int dim>
  BodyContact<dim>::BodyContact(const ContactSettings<dim> &given,
                                const SolidModel<dim>      &solid,
                                const FluidModel<dim>      *fluid,
                                const Obstacles<dim>       *obstacles)
    : solid(solid)
    , surfaces(all_walls(given, fluid), solid, obstacles)
    , settings(completed(given, solid, surfaces))
    , distances(surfaces, settings.activation_distance)
    , own_pairs(surfaces, distances)
    , pattern(solid, surfaces.bodies())
  {
  }


  template <int dim>
  BodyContact<dim>::BodyContact(const BodyContact      &all,
                                const SolidModel<dim>  &solid,
                                const BodySurface<dim> &bodies)
    : solid(solid)
    , surfaces(all.surfaces, bodies)
    , settings(all.settings)
    , distances(all.distances, surfaces)
    , own_pairs(surfaces, distances)
    , pattern(solid, surfaces.bodies())
  {
  }


  /// Throws SolveError where a gap is closed.
  template <int dim>
  typename BodyContact<dim>::Terms
  BodyContact<dim>::terms(const Positions &places) const
  {
    const auto result =
      find_contact_terms(surfaces, distances, own_pairs.nearby(places, places), places);
    const auto owner = [&](const unsigned int node) {
      return "'" + surfaces.surface().body_names()[surfaces.surface_of_node(node)] + "'";
    };
    for (const auto &term : result)
      if (!(term.distance > 0))
        {
          // Corrections stop short of contact, so that nothing else leads here.
          const auto &place = places[term.nodes[0]];
          throw SolveError(fmt::format(
            "{} runs into {} near ({:.4g}): the gap there is {:.3g} m. Try: another "
            "motion of supports or obstacles that leaves a gap, or a smaller step, in "
            "which what is pushed can give way.",
            owner(term.nodes[0]),
            term.wall != term.no_wall      ? "wall '" + surfaces.walls()[term.wall].name + "'"
            : meets_itself(term, surfaces) ? "itself"
                                           : owner(term.nodes[term.n - 1]),
            fmt::join(place.begin_raw(), place.begin_raw() + dim, ", "),
            term.distance));
        }
    return result;
  }


  template <int dim>
  ContactPotential<dim>
  BodyContact<dim>::potential() const
  {
    return ContactPotential<dim>(settings.stiffness);
  }


  template <int dim>
  double
  BodyContact<dim>::energy(const Terms &terms, const Positions &places) const
  {
    double result = 0;
    for (const auto &term : terms)
      result += potential().energy(term, places);
    return result;
  }


  template <int dim>
  double
  BodyContact<dim>::energy(const Vector &displacement, const double time) const
  {
    const auto places = surfaces.positions(displacement, time);
    return energy(terms(places), places);
  }


  template <int dim>
  typename BodyContact<dim>::Forces
  BodyContact<dim>::nodal_forces(const Terms &terms, const Positions &places) const
  {
    Forces result(surfaces.bodies().n_nodes());
    for (const auto &term : terms)
      {
        const auto of_nodes = potential().forces(term, places);
        for (unsigned int i = 0; i < term.n; ++i)
          if (term.nodes[i] < result.size())
            result[term.nodes[i]] += of_nodes[i];
      }
    return result;
  }


  template <int dim>
  typename BodyContact<dim>::Vector
  BodyContact<dim>::forces(const Vector &displacement, const double time) const
  {
    const auto places = surfaces.positions(displacement, time);
    const auto found  = terms(places);
    if (found.empty())
      return {};
    Vector result = solid.vector();
    surfaces.bodies().add(result, nodal_forces(found, places));
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  BodyContact<dim>::nodal_forces(const Vector &displacement, const double time) const
  {
    const auto places = surfaces.positions(displacement, time);
    return nodal_forces(terms(places), places);
  }


  template <int dim>
  void
  BodyContact<dim>::add_stiffness(Matrix       &A,
                                  const double  factor,
                                  const Vector &displacement,
                                  const double  time,
                                  const Tangent kind) const
  {
    const auto places = surfaces.positions(displacement, time);
    const auto found  = terms(places);
    if (found.empty())
      return;
    pattern.make_room(A, coupled_pairs(found, surfaces));
    for (const auto &term : found)
      add_to_rows(A,
                  factor,
                  kind == Tangent::exact ? potential().second_derivatives(term, places)
                                         : potential().convex_part(term, places),
                  term,
                  surfaces,
                  solid.locally_owned());
    A.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  void
  BodyContact<dim>::begin_stage() const
  {
    pattern.clear();
  }


  template <int dim>
  double
  BodyContact<dim>::collision_free_fraction(const Configuration &from,
                                            const Configuration &to) const
  {
    const auto places_from = surfaces.positions(from.displacement, from.time);
    const auto places_to   = surfaces.positions(to.displacement, to.time);
    return undine::collision_free_fraction(
      surfaces, distances, own_pairs.nearby(places_from, places_to), places_from, places_to);
  }


  template <int dim>
  void
  BodyContact<dim>::check_start(const Vector &displacement, const double time) const
  {
    const std::string overlap =
      find_overlap(surfaces, distances, surfaces.positions(displacement, time));
    if (!overlap.empty())
      throw settings.options.error(
        "",
        overlap + " at the start",
        "Try: leave a gap, or fix the body there by a support that reaches to the wall or into "
        "the other surface: what is fixed so is not in contact.");
  }


  template <int dim>
  std::string
  BodyContact<dim>::note_of_start(const Vector &displacement, const double time) const
  {
    const auto places = surfaces.positions(displacement, time);
    const auto found  = terms(places);
    if (found.empty())
      return "";
    const auto &closest =
      *std::min_element(found.begin(), found.end(), [](const auto &one, const auto &other) {
        return one.distance < other.distance;
      });
    const auto name_of = [&](const unsigned int node) {
      return "'" + surfaces.surface().body_names()[surfaces.surface_of_node(node)] + "'";
    };
    const bool is_wall = closest.wall != ContactTerm<dim>::no_wall;
    return fmt::format("{} is {:.3g} m from {} near {}, where contact acts within {:.3g} m: it "
                       "pushes from the start, "
                       "with an energy of {:.3g} J. Unless that is meant, leave a larger gap",
                       name_of(closest.nodes[0]),
                       closest.distance,
                       is_wall ? "wall '" + surfaces.walls()[closest.wall].name + "'"
                               : name_of(closest.nodes[closest.n - 1]),
                       text_of(places[closest.nodes[0]]),
                       closest.activation_distance,
                       energy(found, places));
  }


  template <int dim>
  Columns
  BodyContact<dim>::columns(const Vector &displacement, const double time) const
  {
    const auto             places = surfaces.positions(displacement, time);
    const auto             found  = terms(places);
    double                 least  = settings.activation_distance;
    Forces                 forces(surfaces.n_bodies());
    std::set<unsigned int> nodes;
    for (const auto &term : found)
      {
        least = std::min(least, term.distance);
        nodes.insert(term.nodes[0]);
      }
    const auto of_nodes = nodal_forces(found, places);
    for (unsigned int node = 0; node < of_nodes.size(); ++node)
      forces[surfaces.surface_of_node(node)] += of_nodes[node];

    Columns result{{"contact energy", "J", energy(found, places)},
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


  template <int dim>
  std::shared_ptr<const Contact<dim>>
  make_contact(const ContactSettings<dim> &settings,
               const SolidModel<dim>      &solid,
               const FluidModel<dim>      *fluid,
               const Obstacles<dim>       *obstacles)
  {
    return std::make_shared<const BodyContact<dim>>(settings, solid, fluid, obstacles);
  }


  template <int dim>
  std::shared_ptr<const Contact<dim>>
  make_contact(const Contact<dim>     &all,
               const SolidModel<dim>  &solid,
               const BodySurface<dim> &bodies)
  {
    return std::make_shared<const BodyContact<dim>>(
      dynamic_cast<const BodyContact<dim> &>(all), solid, bodies);
  }


#define UNDINE_INSTANTIATE(dim)                                                           \
  template class BodyContact<dim>;                                                        \
  template std::shared_ptr<const Contact<dim>> make_contact(const ContactSettings<dim> &, \
                                                            const SolidModel<dim> &,      \
                                                            const FluidModel<dim> *,      \
                                                            const Obstacles<dim> *);      \
  template std::shared_ptr<const Contact<dim>> make_contact(                              \
    const Contact<dim> &, const SolidModel<dim> &, const BodySurface<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
