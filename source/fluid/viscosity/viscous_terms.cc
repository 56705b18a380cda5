// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/viscosity/viscous_terms.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// What is nearer than this share of a cell's width counts as so near: it moves along anyway,
    /// and the equations keep their condition.
    constexpr double least_share = 0.01;
  } // namespace


  template <int dim>
  ViscousTerms<dim>::ViscousTerms(const FluidModel<dim>     &model,
                                  const unsigned int         axis,
                                  const FluidTopology<dim>  &open,
                                  const NoSlipSurfaces<dim> &walls,
                                  const double               viscosity)
    : model(model)
    , grid(model.grid())
    , axis(axis)
    , open(open)
    , walls(walls)
    , viscosity(viscosity)
    , links(grid, axis, open, walls)
  {
  }


  template <int dim>
  void
  ViscousTerms<dim>::for_each(const Action &action) const
  {
    cells(action);
    components(action);
    neighbours(action);
    sides(action);
    contacts(action);
  }


  template <int dim>
  double
  ViscousTerms<dim>::area(const FacePlace<dim> &place) const
  {
    return place.part < 0 ? grid.face_area(axis, place.face)
                          : open.faces[axis].all()[place.part].measure;
  }


  template <int dim>
  void
  ViscousTerms<dim>::cells(const Action &action) const
  {
    Term term;
    undine::for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
      if (open.cells.kind(cell) != SubLattice<dim>::Kind::whole)
        return;
      term.faces.clear();
      term.weight = viscosity / grid.cell_volume(cell);
      for (const int end : {0, 1})
        links.for_each_place(moved<dim>(cell, axis, end), [&](const FacePlace<dim> &place) {
          term.faces.emplace_back(place, end == 0 ? -area(place) : area(place));
        });
      action(term);
    });
  }


  template <int dim>
  void
  ViscousTerms<dim>::components(const Action &action) const
  {
    const auto       &all = open.cells.all();
    std::vector<Term> terms(all.size());
    for (std::size_t k = 0; k < open.pieces[axis].size(); ++k)
      for (const unsigned int end : {0, 1})
        if (const int c = open.pieces[axis][k].components[end]; c >= 0)
          {
            const FacePlace<dim> place{open.faces[axis].all()[k].index, static_cast<int>(k)};
            terms[c].faces.emplace_back(place, end == 0 ? area(place) : -area(place));
          }
    for (const auto &patch : walls.patches)
      if (patch.area[axis] != 0)
        terms[patch.component].nodes.emplace_back(patch.node, patch.area[axis]);
    for (std::size_t c = 0; c < all.size(); ++c)
      {
        if (!open.cells.owns(c) || terms[c].faces.empty())
          continue;
        double largest = 0;
        for (const auto &[place, coefficient] : terms[c].faces)
          largest = std::max(largest, std::abs(coefficient));
        const double least = least_share * largest * grid.cell_width(axis, all[c].index[axis]);
        terms[c].weight    = viscosity / std::max(all[c].measure, least);
        action(terms[c]);
      }
  }


  template <int dim>
  void
  ViscousTerms<dim>::neighbours(const Action &action) const
  {
    Term       term;
    const auto between = [&](const FacePlace<dim> &one,
                             const FacePlace<dim> &other,
                             const double          area,
                             const double          distance) {
      term.faces.clear();
      term.nodes.clear();
      add(term, one, 1);
      add(term, other, -1);
      term.weight = viscosity * area / distance;
      action(term);
    };
    undine::for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      for (unsigned int d = 0; d < dim; ++d)
        if (const Side side{d, 1}; d != axis && links.has_neighbour(face, side))
          links.for_each_place(face, [&](const FacePlace<dim> &place) {
            links.for_each_neighbour(
              place, side, [&](const FacePlace<dim> &next, const double area) {
                between(place,
                        next,
                        walls.share_between(axis, place, next, d) * area,
                        links.distance(place, next, d));
              });
          });
    });
    for (const auto &passage : walls.passages[axis])
      between(passage.pieces[0], passage.pieces[1], passage.area, passage.distance);
  }


  /// Add `sign` times the velocity with which the fluid of a piece flows past others (I14).
  template <int dim>
  void
  ViscousTerms<dim>::add(Term &term, const FacePlace<dim> &place, const double sign) const
  {
    const auto *edge = walls.past_edge(axis, place);
    term.faces.emplace_back(place, edge ? sign * edge->factor : sign);
    if (edge)
      for (unsigned int k = 0; k <= dim; ++k)
        term.nodes.emplace_back(edge->nodes[k], -sign * (edge->factor - 1) * edge->weights[k]);
  }


  template <int dim>
  void
  ViscousTerms<dim>::sides(const Action &action) const
  {
    Term                         term;
    const auto                  &lattice = *grid.faces(axis);
    const VelocityCondition<dim> condition(axis);
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int end = 0; end < 2 && d != axis && !grid.periodic(d); ++end)
        {
          const Side side{d, end};
          auto       layer = lattice.owned();
          const int  last  = end == 0 ? 0 : lattice.row(d).size() - 1;
          layer.lower[d]   = std::max(layer.lower[d], last);
          layer.upper[d]   = std::min(layer.upper[d], last + 1);
          undine::for_each(layer, [&](const GridIndex<dim> &face) {
            const auto on_side = moved<dim>(face, d, side.sign());
            links.for_each_place(face, [&](const FacePlace<dim> &place) {
              const double distance =
                std::max(std::abs(links.position(face, side) - links.middle(place)[d]),
                         least_share * grid.cell_width(d, face[d]));
              const double share  = walls.share_beside(axis, place, d);
              const double weight = viscosity * share * links.area_on_side(place, side) / distance;
              term.faces.clear();
              term.nodes.clear();
              add(term, place, 1);
              for_each_boundary_around(
                model.boundaries(),
                lattice,
                side,
                on_side,
                [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
                  if (!condition.is_dirichlet(boundary) || weight == 0)
                    return;
                  term.weight = fraction * weight;
                  term.wall   = {&boundary, d, lattice.point(on_side)};
                  action(term);
                });
            });
          });
        }
  }


  template <int dim>
  void
  ViscousTerms<dim>::contacts(const Action &action) const
  {
    Term term;
    for (const auto &contact : walls.contacts[axis])
      {
        term.faces.clear();
        term.nodes.clear();
        term.weight = viscosity * contact.area / contact.distance;
        add(term, contact.piece, 1);
        for (unsigned int k = 0; k < dim; ++k)
          term.nodes.emplace_back(contact.nodes[k], -contact.weights[k]);
        action(term);
      }
  }


  template struct ViscousTerm<2>;
  template struct ViscousTerm<3>;
  template class ViscousTerms<2>;
  template class ViscousTerms<3>;
} // namespace undine
