// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/scalars/face_means.h>
#include <undine/fluid/scalars/flux_correction.h>
#include <undine/fluid/scalars/scalar_step.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace undine
{
  namespace
  {
    using Vector   = DiffusionSolver::Vector;
    using Matrices = DiffusionSolver::Matrices;

    const double gamma = 1 - std::sqrt(.5); ///< of Alexander's method


    /// values += factor * volumes * changes in cells and components.
    template <int dim>
    void
    add_amounts(Field<dim>       &values,
                const double      factor,
                const Field<dim> &volumes,
                const Field<dim> &changes)
    {
      for_each_cell_place(values, [&](const PressurePlace<dim> &place) {
        value_at(values, place) += factor * value_at(volumes, place) * value_at(changes, place);
      });
    }


    /// One everywhere, ghosts too.
    template <int dim>
    Field<dim>
    ones(const Field<dim> &like)
    {
      Field<dim> result(like.shared_lattice(), like.topology());
      for_each_value(result, [](double &value, const auto &, const auto &) { value = 1; });
      result.exchange(1);
      return result;
    }
  } // namespace


  template <int dim>
  void
  ScalarStep<dim>::number()
  {
    const auto &grid = flow.model().grid();
    numbers          = std::make_unique<PressureNumbers<dim>>(grid, flow.topology());
    // A rank without fluid must not announce rows: their numbers would be taken for a huge range.
    pattern.reinit(
      numbers->owned(), grid.communicator(), numbers->owned().is_empty() ? 0 : 2 * dim + 1);
    for (const auto row : numbers->owned())
      pattern.add(row, row);
    for_each_cell_link(grid, flow.topology().get(), [&](const CellLink<dim> &link) {
      pattern.add(numbers->of(link.from), numbers->of(link.to));
    });
    pattern.compress();
  }


  /// Where fluxes balance the change of volume, what other values contribute to the diagonal makes
  /// the values means of others, whatever rounding does. `coefficients` of a flux.
  template <int dim>
  template <class Coefficients>
  void
  ScalarStep<dim>::assemble(Equations               &equations,
                            const ScalarFluxes<dim> &fluxes,
                            const Matrices           matrices,
                            const Coefficients      &coefficients)
  {
    if (!numbers)
      number();
    const double h        = equations.duration;
    auto        &diagonal = equations.diagonal = equations.retained;
    auto        &matrix                        = equations.solver.matrix;
    matrix.reinit(pattern);
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      const double other = h * coefficients(flux).other;
      value_at(diagonal, link.from) -= other;
      if (const double share = value_at(equations.shares, link.to); share * other != 0)
        matrix.add(numbers->of(link.from), numbers->of(link.to), share * other);
    });
    fluxes.for_each_side(flow.begin(), [&](const PressurePlace<dim> &place, const auto &flux) {
      value_at(diagonal, place) -= h * coefficients(flux).other;
    });
    for_each_cell_place(diagonal, [&](const PressurePlace<dim> &place) {
      matrix.add(numbers->of(place), numbers->of(place), value_at(diagonal, place));
    });
    matrix.compress(dealii::VectorOperation::add);
    equations.solver.set_up(fluxes.diffusion_number(h), matrices);
  }


  /// The last correction is one of Jacobi's: what is small follows its neighbours to rounding, and
  /// not only to the solver's tolerance.
  template <int dim>
  Field<dim>
  ScalarStep<dim>::solve(const Equations  &equations,
                         const Field<dim> &load,
                         const Field<dim> &guess)
  {
    Vector right_side(numbers->owned(), flow.model().grid().communicator()), solution(right_side),
      residual(right_side);
    copy_to_vector(right_side, load);
    copy_to_vector(solution, guess);
    n_iterations += equations.solver.solve(solution, right_side);
    equations.solver.matrix.residual(residual, solution, right_side);
    Field<dim> result(load.shared_lattice(), load.topology()), rest(result);
    copy_from_vector(result, solution);
    copy_from_vector(rest, residual);
    for_each_cell_place(result, [&](const PressurePlace<dim> &place) {
      value_at(result, place) += value_at(rest, place) / value_at(equations.diagonal, place);
    });
    result.exchange(1);
    memory =
      std::max(memory, equations.solver.memory_consumption() + 14 * result.memory_consumption());
    return result;
  }


  /// h q, by the quadrature of Alexander's method.
  template <int dim>
  Field<dim>
  ScalarStep<dim>::gains(const Source &source) const
  {
    const double h = flow.duration();
    Field<dim>   result(flow.model().grid().cells(), flow.topology());
    if (source)
      {
        add_amounts(result, (1 - gamma) * h, flow.volumes(gamma), source(flow.begin() + gamma * h));
        add_amounts(result, gamma * h, flow.volumes(1), source(flow.begin() + h));
      }
    return result;
  }


  /// (F19)
  template <int dim>
  typename ScalarStep<dim>::Low
  ScalarStep<dim>::low_order(const ScalarFluxes<dim> &fluxes,
                             const Field<dim>        &begin,
                             const Field<dim>        &gains)
  {
    const double h = flow.duration();
    Equations    equations{
      h, flow.volumes(0), Field<dim>(begin.shared_lattice(), begin.topology()), {}, {}};
    auto &leaving = equations.shares;
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      value_at(leaving, link.from) += h * flux.upwind().own;
    });
    fluxes.for_each_side(flow.begin(), [&](const PressurePlace<dim> &place, const auto &flux) {
      value_at(leaving, place) += h * flux.upwind().own;
    });
    auto explicit_part = begin;
    int  is_implicit   = 0;
    for_each_cell_place(begin, [&](const PressurePlace<dim> &place) {
      double &share       = value_at(equations.shares, place),
             &volume      = value_at(equations.retained, place);
      const double amount = share;
      share               = amount > volume ? 1 - volume / amount : 0.;
      volume              = std::max(0., volume - amount);
      is_implicit         = is_implicit || share > 0;
      value_at(explicit_part, place) *= 1 - share;
    });
    equations.shares.exchange(1);
    explicit_part.exchange(1);
    auto load = gains;
    add_amounts(load, 1., equations.retained, begin);
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      value_at(load, link.from) -= h * flux.upwind().other * value_at(explicit_part, link.to);
    });
    fluxes.for_each_side(flow.begin() + h / 2, [&](const auto &place, const auto &flux) {
      value_at(load, place) -= h * flux.upwind().other * flux.beyond;
    });
    is_implicit = dealii::Utilities::MPI::max(is_implicit, flow.model().grid().communicator());
    if (is_implicit == 0)
      {
        const auto volumes = flow.volumes(1);
        for_each_cell_place(load, [&](const PressurePlace<dim> &place) {
          value_at(load, place) /= value_at(volumes, place);
        });
        return {load, explicit_part};
      }
    assemble(
      equations, fluxes, Matrices::with_convection, [](const auto &flux) { return flux.upwind(); });
    Low result{solve(equations, load, begin), explicit_part};
    add_amounts(result.carried, 1., equations.shares, result.end);
    result.carried.exchange(1);
    return result;
  }


  /// What would become of the values at the begin in half of the stage if nothing flowed.
  template <int dim>
  Field<dim>
  ScalarStep<dim>::after_half(const ScalarFluxes<dim> &fluxes,
                              const Field<dim>        &begin,
                              const Low               &low,
                              const Field<dim>        &gains) const
  {
    const double h       = flow.duration();
    const auto   volumes = flow.volumes(1);
    auto         change  = gains;
    if (fluxes.has_diffusion())
      {
        fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
          value_at(change, link.from) -=
            h * flux.conductance *
            (value_at(low.carried, link.from) - value_at(low.carried, link.to));
        });
        fluxes.for_each_side(flow.begin() + h / 2, [&](const auto &place, const auto &flux) {
          value_at(change, place) -=
            h * flux.conductance * (value_at(low.carried, place) - flux.beyond);
        });
      }
    auto result = begin;
    for_each_cell_place(result, [&](const PressurePlace<dim> &place) {
      value_at(result, place) += value_at(change, place) / (2 * value_at(volumes, place));
    });
    result.exchange(1);
    return result;
  }


  /// face_means(), and next to bodies the mean in time of both sides. The smaller of two components
  /// that is less than half of its cell has little to say about the value at the face between them:
  /// that turns to upwind there.
  template <int dim>
  Velocity<dim>
  ScalarStep<dim>::values_on_faces(const ScalarFluxes<dim> &fluxes,
                                   const Field<dim>        &begin,
                                   const Field<dim>        &half,
                                   const Low               &low,
                                   ScalarBounds<dim>       &bounds) const
  {
    const auto &grid   = flow.model().grid();
    auto        result = face_means(fluxes, begin, half, bounds);
    auto        mean = begin, fullness = flow.volumes(0);
    const auto  volumes = flow.volumes(1);
    for_each_cell_place(mean, [&](const PressurePlace<dim> &place) {
      value_at(mean, place) += (value_at(low.end, place) - value_at(mean, place)) / 2;
      value_at(fullness, place) = std::min(value_at(fullness, place), value_at(volumes, place)) /
                                  flow.model().grid().cell_volume(place.cell);
    });
    mean.exchange(1);
    fullness.exchange(1);
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      double &value = value_at(result[link.axis], link.face.face, link.face.part);
      if (!std::isnan(value))
        return;
      const double from = value_at(mean, link.from), to = value_at(mean, link.to);
      const double central =
        std::min({1., 2 * value_at(fullness, link.from), 2 * value_at(fullness, link.to)});
      const auto width = [&](const PressurePlace<dim> &place) {
        return grid.cell_width(link.axis, place.cell[link.axis]);
      };
      const double linear =
        (width(link.to) * from + width(link.from) * to) / (width(link.from) + width(link.to));
      value = central * linear + (1 - central) * (flux.rate > 0 ? from : to);
    });
    fluxes.for_each_side(flow.begin(), [&](const PressurePlace<dim> &place, const auto &flux) {
      double &value = value_at(result[flux.axis], flux.face.face, flux.face.part);
      if (std::isnan(value))
        value = value_at(mean, place);
    });
    return result;
  }


  /// The mean in time of what diffuses, while the values on faces flow.
  template <int dim>
  Field<dim>
  ScalarStep<dim>::diffused(const ScalarFluxes<dim> &fluxes,
                            const Field<dim>        &begin,
                            const Velocity<dim>     &on_faces,
                            const Field<dim>        &gains)
  {
    const double h      = flow.duration();
    auto         change = gains; // besides diffusion
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      value_at(change, link.from) -= h * flux.rate * value_at(on_faces[link.axis], link.face);
    });
    fluxes.for_each_side(flow.begin() + h / 2, [&](const auto &place, const auto &flux) {
      value_at(change, place) -=
        h * flux.rate * (flux.rate > 0 ? value_at(on_faces[flux.axis], flux.face) : flux.beyond);
    });
    const auto step = [&](const double end, const Field<dim> &load, const Field<dim> &guess) {
      Equations equations{gamma * h, flow.volumes(end), ones(begin), {}, {}};
      auto      full_load = load;
      fluxes.for_each_side(flow.begin() + end * h, [&](const auto &place, const auto &flux) {
        value_at(full_load, place) += gamma * h * flux.conductance * flux.beyond;
      });
      assemble(equations, fluxes, Matrices::symmetric, [](const auto &flux) {
        return typename ScalarFluxes<dim>::Coefficients{flux.conductance, -flux.conductance};
      });
      return solve(equations, full_load, guess);
    };
    Field<dim> start(begin.shared_lattice(), begin.topology());
    add_amounts(start, 1., flow.volumes(0), begin);
    auto load = start;
    add(load, gamma, change);
    auto result = step(gamma, load, begin);
    load        = start;
    add(load, -(1 - gamma) / gamma, start);
    add(load, gamma, change);
    add_amounts(load, (1 - gamma) / gamma, flow.volumes(gamma), result);
    const auto second = step(1., load, result);
    add(result, -gamma, Field<dim>(result));
    add(result, gamma, second);
    result.exchange(1);
    return result;
  }


  /// By how much the mean of what sides give in Alexander's two stages exceeds what they give in
  /// the middle of the stage, for each of for_each_side(): a difference of second order, which the
  /// small cells of long steps would multiply. Empty without diffusion.
  template <int dim>
  std::vector<double>
  ScalarStep<dim>::later_than_middle(const ScalarFluxes<dim> &fluxes) const
  {
    std::vector<double> result;
    if (!fluxes.has_diffusion())
      return result;
    const auto add_values = [&](const double share, const double weight) {
      std::size_t k = 0;
      fluxes.for_each_side(flow.begin() + share * flow.duration(),
                           [&](const auto &, const auto &flux) {
                             result.resize(std::max(result.size(), k + 1));
                             result[k++] += weight * flux.beyond;
                           });
    };
    add_values(gamma, 1 - gamma);
    add_values(1, gamma);
    add_values(.5, -1);
    return result;
  }


  /// (F21)
  template <int dim>
  Field<dim>
  ScalarStep<dim>::corrected(const ScalarFluxes<dim> &fluxes,
                             const Low               &low,
                             const Velocity<dim>     &on_faces,
                             const Field<dim>        &diffused,
                             const ScalarBounds<dim> &bounds) const
  {
    const double        h       = flow.duration();
    const auto          volumes = flow.volumes(1);
    const auto         &carried = low.carried;
    FluxCorrection<dim> correction(fluxes, bounds, volumes);
    fluxes.for_each([&](const CellLink<dim> &link, const auto &flux) {
      const auto   upwind = flux.upwind();
      const double high =
        flux.rate * value_at(on_faces[link.axis], link.face) +
        flux.conductance * (value_at(diffused, link.from) - value_at(diffused, link.to));
      correction.add(h * (high - upwind.own * value_at(carried, link.from) -
                          upwind.other * value_at(carried, link.to)));
    });
    const auto later = later_than_middle(fluxes);
    auto       next  = later.begin();
    fluxes.for_each_side(flow.begin(), [&](const auto &place, const auto &flux) {
      const double value = value_at(carried, place);
      correction.add_at_side(
        place,
        h * (std::max(0., flux.rate) * (value_at(on_faces[flux.axis], flux.face) - value) +
             flux.conductance *
               (value_at(diffused, place) - value - (later.empty() ? 0. : *next++))));
    });
    auto result = low.end;
    correction.move(result);
    return result;
  }


  template <int dim>
  Field<dim>
  ScalarStep<dim>::advance(const Field<dim>             &scalar,
                           const BoundaryCondition<dim> &condition,
                           const double                  diffusivity,
                           const Source                 &source)
  {
    const ScalarFluxes<dim> fluxes(flow, condition, diffusivity);
    const auto              gained = gains(source);
    ScalarBounds<dim>       bounds(scalar);
    if (source)
      {
        const auto volumes = flow.volumes(1);
        for_each_cell_place(gained, [&](const PressurePlace<dim> &place) {
          bounds.include(
            place, value_at(scalar, place) + value_at(gained, place) / value_at(volumes, place));
        });
      }
    auto low = low_order(fluxes, scalar, gained);
    bounds.spread(fluxes);
    bounds.include_neighbours(fluxes, low.end);
    const auto on_faces =
      values_on_faces(fluxes, scalar, after_half(fluxes, scalar, low, gained), low, bounds);
    const auto diffusing =
      fluxes.has_diffusion() ? diffused(fluxes, scalar, on_faces, gained) : low.end;
    return corrected(fluxes, low, on_faces, diffusing, bounds);
  }


  template class ScalarStep<2>;
  template class ScalarStep<3>;
} // namespace undine
