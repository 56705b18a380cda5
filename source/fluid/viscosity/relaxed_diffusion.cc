// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/relaxed_diffusion.h>

#include <algorithm>
#include <vector>

namespace undine
{
  template <int dim>
  RelaxedDiffusion<dim>::RelaxedDiffusion(const DiffusionProblem<dim> &problem)
    : problem(problem)
    , equations(problem.lattice)
  {
    for (unsigned int d = 0; d < dim; ++d)
      along[d] = distances(d);
  }


  template <int dim>
  typename RelaxedDiffusion<dim>::Distances
  RelaxedDiffusion<dim>::distances(const unsigned int direction) const
  {
    const auto &mine     = problem.lattice->owned();
    const auto &row      = problem.lattice->row(direction);
    const auto  is_point = [&](const int index) {
      return row.periodic() || (index >= 0 && index < row.size());
    };
    Distances result{mine.lower[direction] - 1, {}, {}};
    for (int i = result.first; i < mine.upper[direction]; ++i)
      {
        GridIndex<dim> index{};
        index[direction] = i;
        result.extents.push_back(
          is_point(i) ? extent(problem.model.grid(), *problem.lattice, direction, index) : 0.);
        result.links.push_back(
          is_point(i) && is_point(i + 1) ? 1 / (row.position(i + 1) - row.position(i)) : 0.);
      }
    return result;
  }


  namespace
  {
    /// The entries by friction k = `factor` * `along_row` between the points of a row and the next
    /// ones, and by `step` * rate with which the flow carries from the former to the latter.
    void
    set_couplings(double *__restrict above,
                  double *__restrict below,
                  const double  factor,
                  const double *along_row,
                  const double  step,
                  const double *rates,
                  const int     length)
    {
      for (int i = 0; i < length; ++i)
        {
          const double friction = factor * along_row[i];
          const double carried  = step * rates[i] / 2;
          above[i]              = carried - friction;
          below[i]              = -carried - friction;
        }
    }
  } // namespace


  /// Points with the next ones in a direction, which other ranks may own.
  template <int dim>
  void
  RelaxedDiffusion<dim>::couple(const unsigned int     direction,
                                const double           dt,
                                const DualFluxes<dim> *fluxes)
  {
    const auto &row = problem.lattice->row(direction);
    if (row.periodic() && row.size() == 1)
      return; // what a point gives to itself
    auto pairs = problem.lattice->owned();
    if (row.periodic() || pairs.lower[direction] > 0)
      --pairs.lower[direction];
    if (!row.periodic())
      pairs.upper[direction] = std::min(pairs.upper[direction], row.size() - 1);
    std::vector<double> rates(std::max(0, pairs.upper[0] - pairs.lower[0]), 0.);
    const auto         &first_row = direction == 0 ? along[0].links : along[0].extents;
    for_each_row(pairs, [&](const GridIndex<dim> &first, const int length) {
      double factor = dt * problem.diffusivity;
      for (unsigned int d = 1; d < dim; ++d)
        factor *= d == direction ? along[d].link(first[d]) : along[d].extent(first[d]);
      if (fluxes)
        fluxes->rates_to_next(problem.lattice->normal_axis(), direction, first, rates);
      const auto here = equations.position(first);
      set_couplings(equations.above[direction].data() + here,
                    equations.below[direction].data() + here + equations.owned().strides[direction],
                    factor,
                    first_row.data() + (first[0] - along[0].first),
                    dt,
                    rates.data(),
                    length);
    });
  }


  /// Rows of the matrix have the sum V, apart from what sides of the domain add.
  template <int dim>
  void
  RelaxedDiffusion<dim>::fill_points(const Field<dim> &field)
  {
    for_each_row(problem.lattice->owned(), [&](const GridIndex<dim> &first, const int length) {
      double area = 1;
      for (unsigned int d = 1; d < dim; ++d)
        area *= along[d].extent(first[d]);
      const auto    here       = equations.position(first);
      double       *diagonal   = equations.diagonal.data() + here;
      double       *right_side = equations.right_side.data() + here;
      const double *extents    = along[0].extents.data() + (first[0] - along[0].first);
      const double *value      = field.data(first);
      for (int i = 0; i < length; ++i)
        {
          diagonal[i]   = area * extents[i];
          right_side[i] = diagonal[i] * value[i];
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *above = equations.above[d].data() + here;
          const double *below = equations.below[d].data() + here;
          for (int i = 0; i < length; ++i)
            diagonal[i] -= above[i] + below[i];
        }
    });
  }


  /// Friction on Dirichlet boundaries, half a cell away from the points along them.
  template <int dim>
  void
  RelaxedDiffusion<dim>::add_sides(const double time, const double dt)
  {
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int end = 0; end < 2 && problem.lattice->row(d).has_boundary_points(); ++end)
        {
          const Side side{d, end};
          const int  last  = end == 0 ? 0 : problem.lattice->row(d).size() - 1;
          auto       layer = problem.lattice->owned();
          layer.lower[d]   = std::max(layer.lower[d], last);
          layer.upper[d]   = std::min(layer.upper[d], last + 1);
          for_each(layer, [&](const GridIndex<dim> &index) {
            const auto   on_side = moved<dim>(index, d, side.sign());
            const auto   here    = equations.position(index);
            const double factor =
              dt * problem.diffusivity *
              coupling(problem.model.grid(), *problem.lattice, index, d, side.sign());
            for_each_boundary_around(
              problem.model.boundaries(),
              *problem.lattice,
              side,
              on_side,
              [&](const Boundary<dim> &boundary, const double fraction, const GridIndex<dim> &) {
                if (!problem.condition.is_dirichlet(boundary))
                  return;
                equations.diagonal[here] += fraction * factor;
                equations.right_side[here] += fraction * factor *
                                              problem.condition.dirichlet_value(
                                                boundary, d, problem.lattice->point(on_side), time);
              });
          });
        }
  }


  template <int dim>
  void
  RelaxedDiffusion<dim>::carry_through_sides(const double dt, const DualFluxes<dim> &fluxes)
  {
    const unsigned int axis = problem.lattice->normal_axis();
    fluxes.for_each_entering(
      axis, [&](const FacePlace<dim> &place, const double rate, const double velocity) {
        const auto here = equations.position(place.face);
        equations.diagonal[here] += dt * rate;
        equations.right_side[here] += dt * rate * velocity;
      });
    fluxes.for_each_extrapolated(
      axis, [&](const FacePlace<dim> &place, const FacePlace<dim> &behind, const double rate) {
        const auto here = equations.position(place.face);
        equations.diagonal[here] += dt * rate;
        for (unsigned int d = 0; d < dim; ++d)
          if (const int way = behind.face[d] - place.face[d]; way != 0)
            (way > 0 ? equations.above : equations.below)[d][here] -= dt * rate;
      });
  }


  template <int dim>
  void
  RelaxedDiffusion<dim>::keep_prescribed(const Field<dim> &field)
  {
    const unsigned int axis = problem.lattice->normal_axis();
    for (unsigned int end = 0; end < 2 && axis < dim && !problem.model.grid().periodic(axis); ++end)
      {
        const int last    = end == 0 ? 0 : problem.lattice->row(axis).size() - 1;
        auto      layer   = problem.lattice->owned();
        layer.lower[axis] = std::max(layer.lower[axis], last);
        layer.upper[axis] = std::min(layer.upper[axis], last + 1);
        for_each(layer, [&](const GridIndex<dim> &face) {
          if (!is_prescribed(problem.model, *problem.lattice, face))
            return;
          const auto here = equations.position(face);
          for (auto *entries : {&equations.above, &equations.below})
            for (auto &in_direction : *entries)
              in_direction[here] = 0;
          equations.diagonal[here]   = volume(problem.model.grid(), *problem.lattice, face);
          equations.right_side[here] = equations.diagonal[here] * field(face);
        });
      }
  }


  template <int dim>
  std::optional<unsigned int>
  RelaxedDiffusion<dim>::step(Field<dim>            &field,
                              const double           time,
                              const double           dt,
                              const DualFluxes<dim> *fluxes)
  {
    for (unsigned int direction = 0; direction < dim; ++direction)
      couple(direction, dt, fluxes);
    fill_points(field);
    if (problem.diffusivity > 0)
      add_sides(time, dt);
    if (fluxes)
      carry_through_sides(dt, *fluxes);
    keep_prescribed(field);
    return equations.solve(field);
  }


  template <int dim>
  std::size_t
  RelaxedDiffusion<dim>::memory_consumption() const
  {
    return equations.memory_consumption();
  }


  template class RelaxedDiffusion<2>;
  template class RelaxedDiffusion<3>;
} // namespace undine
