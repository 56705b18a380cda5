// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// A copy whose upper faces are known for every owned cell.
    template <int dim>
    Velocity<dim>
    with_ghosts(Velocity<dim> velocity)
    {
      exchange(velocity);
      return velocity;
    }


    /// Mean of the two faces of a cell normal to `axis` [m/s].
    template <int dim>
    double
    at_centre(const Velocity<dim> &velocity, const unsigned int axis, const GridIndex<dim> &cell)
    {
      return (velocity[axis](cell) + velocity[axis](moved<dim>(cell, axis, 1))) / 2;
    }


    /// action(axis, rho V_f, v_f, w_f) for all owned faces and pieces, v and w being on the same
    /// topology.
    template <int dim, class Action>
    void
    for_each_mass(const FluidModel<dim> &model,
                  const Velocity<dim>   &velocity,
                  const Velocity<dim>   &other,
                  const Action          &action)
    {
      const auto *open = velocity.topology();
      const auto &grid = model.grid();
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const auto &component = velocity[axis];
          const auto *divided   = component.divided();
          const auto  width     = [&](const unsigned int d, const int i) {
            return d == axis ? grid.dual_width(d, i) : grid.cell_width(d, i);
          };
          std::vector<double> along; // the widths of a row's volumes
          for (int i = component.owned().lower[0]; i < component.owned().upper[0]; ++i)
            along.push_back(width(0, i));
          for_each_row(component.owned(), [&](const GridIndex<dim> &first, const int n) {
            double across = model.density();
            for (unsigned int d = 1; d < dim; ++d)
              across *= width(d, first[d]);
            const double *v = component.data(first);
            const double *w = other[axis].data(first);
            for (int i = 0; i < n; ++i)
              if (!divided ||
                  divided->kind(moved<dim>(first, 0, i)) == SubLattice<dim>::Kind::whole)
                action(axis, across * along[i], v[i], w[i]);
          });
          for (std::size_t k = 0; k < component.parts().size(); ++k)
            if (divided->owns(k))
              action(axis,
                     model.density() * open->pieces[axis][k].volume,
                     component.parts()[k],
                     other[axis].parts()[k]);
        }
    }


    /// action(axis, rho V_f, v_f).
    template <int dim, class Action>
    void
    for_each_mass(const FluidModel<dim> &model, const Velocity<dim> &velocity, const Action &action)
    {
      for_each_mass(model,
                    velocity,
                    velocity,
                    [&](const unsigned int axis, const double mass, const double v, const double) {
                      action(axis, mass, v);
                    });
    }

  } // namespace


  void
  throw_unless_finite(const bool finite, const MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::min(finite ? 1 : 0, communicator) == 0)
      throw SolveError("The fluid's velocity is not a finite number. Try: look at expressions for "
                       "initial velocities, forces and boundary values, whether they have a value "
                       "everywhere at this time; else a smaller step.");
  }


  template <int dim>
  double
  kinetic_energy(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    double energy = 0;
    for_each_mass(model, velocity, [&](const unsigned int, const double mass, const double v) {
      energy += mass * v * v / 2;
    });
    return dealii::Utilities::MPI::sum(energy, model.grid().communicator());
  }


  template <int dim>
  double
  inner_product(const FluidModel<dim> &model, const Velocity<dim> &v, const Velocity<dim> &w)
  {
    double product = 0;
    for_each_mass(
      model, v, w, [&](const unsigned int, const double mass, const double a, const double b) {
        product += mass * a * b;
      });
    return dealii::Utilities::MPI::sum(product, model.grid().communicator());
  }


  template <int dim>
  dealii::Tensor<1, dim>
  linear_momentum(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    dealii::Tensor<1, dim> momentum;
    for_each_mass(model, velocity, [&](const unsigned int axis, const double mass, const double v) {
      momentum[axis] += mass * v;
    });
    return dealii::Utilities::MPI::sum(momentum, model.grid().communicator());
  }


  template <int dim>
  dealii::Tensor<1, dim>
  largest_components(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    dealii::Tensor<1, dim> result;
    bool                   finite = true;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        double     largest = 0;
        const auto include = [&](const double value) {
          finite  = finite && std::isfinite(value);
          largest = std::max(largest, std::abs(value));
        };
        for_each_row(velocity[axis].owned(), [&](const GridIndex<dim> &first, const int n) {
          const double *values = velocity[axis].data(first);
          std::for_each(values, values + n, include);
        });
        for (const double value : velocity[axis].parts())
          include(value);
        result[axis] = dealii::Utilities::MPI::max(largest, model.grid().communicator());
      }
    throw_unless_finite(finite, model.grid().communicator());
    return result;
  }


  template <int dim>
  double
  largest_speed(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto known   = with_ghosts(velocity);
    double     largest = 0;
    bool       finite  = true;
    for_each(model.grid().cells()->owned(), [&](const GridIndex<dim> &cell) {
      double square = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        square += std::pow(at_centre(known, axis, cell), 2);
      finite  = finite && std::isfinite(square);
      largest = std::max(largest, square);
    });
    throw_unless_finite(finite, model.grid().communicator());
    return std::sqrt(dealii::Utilities::MPI::max(largest, model.grid().communicator()));
  }


  template <int dim>
  double
  integral(const FluidModel<dim> &model, const Field<dim> &scalar)
  {
    Field<dim> volumes(scalar.shared_lattice(), scalar.topology());
    set_volumes(volumes, model.grid());
    double sum = 0;
    for_each(scalar.owned(),
             [&](const GridIndex<dim> &cell) { sum += volumes(cell) * scalar(cell); });
    for (std::size_t c = 0; c < scalar.parts().size(); ++c)
      if (scalar.divided()->owns(c))
        sum += volumes.parts()[c] * scalar.parts()[c];
    return dealii::Utilities::MPI::sum(sum, model.grid().communicator());
  }


  template <int dim>
  std::vector<double>
  kinetic_energy_densities(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto *open = velocity.topology();
    if (!open)
      return {};
    const auto          known = with_ghosts(velocity);
    std::vector<double> densities(open->cells.all().size());
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        std::vector<double> areas(densities.size()), sums(densities.size());
        for (std::size_t k = 0; k < open->pieces[axis].size(); ++k)
          for (const int component : open->pieces[axis][k].components)
            if (component >= 0)
              {
                const double area = open->faces[axis].all()[k].measure;
                areas[component] += area;
                sums[component] += area * std::pow(known[axis].parts()[k], 2);
              }
        for (std::size_t c = 0; c < densities.size(); ++c)
          if (areas[c] > 0)
            densities[c] += model.density() * sums[c] / areas[c] / 2;
      }
    return densities;
  }


  template <int dim>
  double
  kinetic_energy_outflow(const FluidModel<dim> &model, const Velocity<dim> &velocity)
  {
    const auto &boundaries = model.boundaries();
    if (std::none_of(boundaries.all().begin(), boundaries.all().end(), [](const auto &boundary) {
          return boundary.lets_fluid_pass();
        }))
      return 0;
    const auto &grid  = model.grid();
    const auto  known = with_ghosts(velocity);
    double      power = 0;
    for_each_side_face(
      grid, velocity[0].topology().get(), [&](const SideFace<dim> &face, const auto &) {
        const auto &boundary = boundaries.at(face.side, face.face);
        if (!boundary.lets_fluid_pass())
          return;
        const double flux          = outward_flux(grid, velocity, face);
        const bool   enters_freely = boundary.is_open() && flux < 0; // at right angles
        double       square        = std::pow(value_on(velocity, face), 2);
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (axis != face.side.axis && !enters_freely)
            square += std::pow(at_centre(known, axis, face.cell), 2);
        power += flux * model.density() * square / 2;
      });
    return dealii::Utilities::MPI::sum(power, grid.communicator());
  }


  template <int dim>
  Columns
  fluid_columns(const FluidModel<dim>        &model,
                const FluidState<dim>        &state,
                const dealii::Tensor<1, dim> &gravity,
                const double                  divergence)
  {
    Columns    columns{{"Fluid kinetic energy", "J", kinetic_energy(model, state.velocity)},
                    {"Fluid largest speed", "m/s", largest_speed(model, state.velocity)},
                    {"Fluid divergence", "1", divergence}};
    const auto fluxes = boundary_fluxes(model.boundaries(), state.velocity);
    for (unsigned int b = 0; b < fluxes.size(); ++b)
      {
        const auto &boundary = model.boundaries().all()[b];
        if (boundary.lets_fluid_pass())
          columns.push_back(
            {"Flux through " + boundary.name, "m^" + std::to_string(dim) + "/s", fluxes[b]});
      }
    const auto forces =
      force_columns("Pressure force",
                    model.boundaries(),
                    pressure_forces(model.boundaries(), state, model.density() * gravity));
    columns.insert(columns.end(), forces.begin(), forces.end());
    return columns;
  }


#define INSTANTIATE(dim)                                                                           \
  template double              kinetic_energy(const FluidModel<dim> &, const Velocity<dim> &);     \
  template std::vector<double> kinetic_energy_densities(const FluidModel<dim> &,                   \
                                                        const Velocity<dim> &);                    \
  template double kinetic_energy_outflow(const FluidModel<dim> &, const Velocity<dim> &);          \
  template double inner_product(                                                                   \
    const FluidModel<dim> &, const Velocity<dim> &, const Velocity<dim> &);                        \
  template dealii::Tensor<1, dim> linear_momentum(const FluidModel<dim> &, const Velocity<dim> &); \
  template dealii::Tensor<1, dim> largest_components(const FluidModel<dim> &,                      \
                                                     const Velocity<dim> &);                       \
  template double                 largest_speed(const FluidModel<dim> &, const Velocity<dim> &);   \
  template double                 integral(const FluidModel<dim> &, const Field<dim> &);           \
  template Columns                fluid_columns(const FluidModel<dim> &,                           \
                                                const FluidState<dim> &,                           \
                                                const dealii::Tensor<1, dim> &,                    \
                                                const double);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
