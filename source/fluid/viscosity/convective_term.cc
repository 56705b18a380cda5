// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/convective_term.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace undine
{
  template <int dim>
  ConvectiveTerm<dim>::ConvectiveTerm(const FaceUnknowns<dim> &unknowns)
    : unknowns(unknowns)
  {
  }


  template <int dim>
  void
  ConvectiveTerm<dim>::start_pattern(dealii::DynamicSparsityPattern &pattern,
                                     const DualFluxes<dim>          &fluxes)
  {
    entries.clear();
    fluxes.for_each_between(
      unknowns.axis(), [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double) {
        if (unknowns.is_prescribed(from) || unknowns.is_prescribed(to))
          return;
        pattern.add(unknowns.number(from), unknowns.number(to));
        pattern.add(unknowns.number(to), unknowns.number(from));
      });
  }


  template <int dim>
  void
  ConvectiveTerm<dim>::add(Matrix                &matrix,
                           Vector                &load,
                           const double           dt,
                           const DualFluxes<dim> &fluxes,
                           const Field<dim>      &field)
  {
    const Equations equations{matrix, load, dt * unknowns.model().density(), field};
    Vector          leaving = unknowns.vector();
    add_between(equations, fluxes, leaving);
    add_sides(equations, fluxes);
    if (fluxes.start())
      add_shrinkage(equations, fluxes, leaving);
  }


  /// rho phi (v_to - v_from) / 2 in the equations of both places, phi being what flows from one to
  /// the other, and what prescribed velocities contribute to the load. `leaving` gets what leaves
  /// the dual volumes in a step [kg].
  template <int dim>
  void
  ConvectiveTerm<dim>::add_between(const Equations       &equations,
                                   const DualFluxes<dim> &fluxes,
                                   Vector                &leaving)
  {
    const auto &mine = unknowns.owned();
    if (entries.empty())
      entries.find(fluxes, unknowns.axis(), equations.matrix, [&](const FacePlace<dim> &place) {
        if (unknowns.is_prescribed(place) || !mine.is_element(unknowns.number(place)))
          return ConvectiveEntries<dim>::none;
        return static_cast<int>(mine.index_within_set(unknowns.number(place)));
      });
    const auto   rows = rows_of(equations.matrix);
    double      *mass = leaving.begin();
    std::size_t  k    = 0;
    const double step = equations.mass_per_rate;
    // A matrix must not get values by address while it collects those of other ranks.
    std::vector<std::tuple<FacePlace<dim>, FacePlace<dim>, double>> others;
    fluxes.for_each_between(
      unknowns.axis(),
      [&](const FacePlace<dim> &from, const FacePlace<dim> &to, const double flux) {
        const auto &pair = entries[k++];
        if (pair.from == ConvectiveEntries<dim>::none)
          {
            others.emplace_back(from, to, flux);
            return;
          }
        const double half = step * flux / 2;
        rows[pair.from][pair.places[0]] -= half;
        rows[pair.from][pair.places[1]] += half;
        rows[pair.to][pair.places[2]] -= half;
        rows[pair.to][pair.places[3]] += half;
        mass[pair.from] += 2 * half;
        mass[pair.to] -= 2 * half;
      });
    for (const auto &[from, to, flux] : others)
      {
        leaving(unknowns.number(from)) += step * flux;
        leaving(unknowns.number(to)) -= step * flux;
        for (const auto &row : {from, to})
          if (!unknowns.is_prescribed(row))
            {
              add_entry(equations, row, from, -step * flux / 2);
              add_entry(equations, row, to, step * flux / 2);
            }
      }
    leaving.compress(dealii::VectorOperation::add);
  }


  /// To the matrix, or to the load if the velocity of the column is prescribed.
  template <int dim>
  void
  ConvectiveTerm<dim>::add_entry(const Equations      &equations,
                                 const FacePlace<dim> &row,
                                 const FacePlace<dim> &column,
                                 const double          mass) const
  {
    if (unknowns.is_prescribed(column))
      equations.load(unknowns.number(row)) -= mass * value_at(equations.field, column);
    else
      equations.matrix.add(unknowns.number(row), unknowns.number(column), mass);
  }


  template <int dim>
  void
  ConvectiveTerm<dim>::add_sides(const Equations &equations, const DualFluxes<dim> &fluxes) const
  {
    fluxes.for_each_entering(
      unknowns.axis(), [&](const FacePlace<dim> &place, const double flux, const double velocity) {
        if (unknowns.is_prescribed(place))
          return;
        const double mass   = equations.mass_per_rate * flux;
        const auto   number = unknowns.number(place);
        equations.matrix.add(number, number, mass);
        equations.load(number) += mass * velocity;
      });
    fluxes.for_each_extrapolated(
      unknowns.axis(),
      [&](const FacePlace<dim> &place, const FacePlace<dim> &behind, const double flux) {
        if (unknowns.is_prescribed(place))
          return;
        const double mass = equations.mass_per_rate * flux;
        add_entry(equations, place, place, mass);
        add_entry(equations, place, behind, -mass);
      });
    equations.matrix.compress(dealii::VectorOperation::add);
    equations.load.compress(dealii::VectorOperation::add);
  }


  /// What leaves the dual volumes in a step where surfaces move [kg], besides what crosses sides
  /// in `leaving`. V^0 is not negative, but for what the flow does not fit.
  template <int dim>
  void
  ConvectiveTerm<dim>::add_shrinkage(const Equations       &equations,
                                     const DualFluxes<dim> &fluxes,
                                     Vector                &leaving) const
  {
    const auto axis = unknowns.axis();
    fluxes.for_each_leaving(axis, [&](const FacePlace<dim> &place, const double flux) {
      leaving(unknowns.number(place)) += equations.mass_per_rate * flux;
    });
    leaving.compress(dealii::VectorOperation::add);
    std::size_t k = 0;
    unknowns.for_each_owned([&](const FacePlace<dim> &place) {
      const double shrinkage =
        unknowns.is_prescribed(place) ? 0. : std::max(leaving.begin()[k], -unknowns.mass(place));
      const auto number = unknowns.number(place);
      equations.matrix.add(number, number, shrinkage);
      equations.load.begin()[k++] += shrinkage * value_at((*fluxes.start())[axis], place);
    });
    equations.matrix.compress(dealii::VectorOperation::add);
  }


  template <int dim>
  std::size_t
  ConvectiveTerm<dim>::memory_consumption() const
  {
    return entries.memory_consumption();
  }


  template class ConvectiveTerm<2>;
  template class ConvectiveTerm<3>;
} // namespace undine
