// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/effects/face_forces.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// Gives back to vortices what the interpolation of transport takes (Fedkiw, Stam, Jensen 2001,
  /// section 4): a force around their cores, per mass
  ///
  ///     f = epsilon dx (N x omega),   N = grad|omega| / |grad|omega||
  ///
  /// or with the antisymmetric W_ab = d_a v_b - d_b v_a, in any dimension,
  ///
  ///     f_a = epsilon dx sum_b W_ab N_b,   |omega|^2 = sum_{a<b} W_ab^2                     (E6)
  ///
  /// in the centres of cells, and on a face the mean of both sides. Where a cell next to it is not
  /// whole or beyond the domain, vorticity is that of a boundary layer and there is no force;
  /// gradients do not use it. The force conserves neither momentum nor energy.
  template <int dim>
  class VorticityConfinement : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Strength",
                      strength,
                      "1/s",
                      Allowed::positive(),
                      "epsilon: acceleration per width of a cell and vorticity.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.fluid)
        throw options.error("",
                            "vorticity confinement acts on a fluid, but the scene has none",
                            "Remove the section or add a section 'Fluid'.");
      if (std::find(around.effects.begin(), around.effects.end(), "convection") ==
          around.effects.end())
        throw options.error("",
                            "vorticity confinement makes good what convection smooths, which the "
                            "scene does not call for",
                            "Remove the section or add a subsection 'convection' to 'Effects'.");
    }

    std::pair<std::string, std::string>
    reason_not_for_particles() const override
    {
      return {"it makes good what the advection on a grid smooths; particles smooth "
              "nothing in this way",
              "Remove the section."};
    }

    std::string
    summary() const override
    {
      return fmt::format("{:.4g} 1/s", strength);
    }

    void
    accelerate(FluidStage<dim> &step) const override
    {
      const auto timed  = step.timing.section(this->name);
      const auto forces = confining_forces(step);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const auto &grid  = step.model.grid();
          const auto &force = forces[axis];
          accelerate_faces(
            step,
            axis,
            [&](const GridIndex<dim> &face) {
              if (grid.at_boundary(axis, face))
                return 0.;
              const auto   below = moved<dim>(face, axis, -1);
              const double width = grid.cell_width(axis, below[axis]);
              const double other = grid.cell_width(axis, face[axis]);
              return (force(below) * other + force(face) * width) / (width + other);
            },
            [](const unsigned int) { return 0.; });
        }
    }

  private:
    using Fields = std::vector<Field<dim>>;

    /// W_ab for a < b, in this order, and 1 in cells where it is known.
    struct Vorticity
    {
      Fields     components; ///< [1/s]
      Field<dim> known;

      /// W_ab [1/s].
      double
      operator()(const unsigned int a, const unsigned int b, const GridIndex<dim> &cell) const
      {
        if (a == b)
          return 0;
        const double value = components[a + b - 1](cell);
        return a < b ? value : -value;
      }

      double
      magnitude(const GridIndex<dim> &cell) const
      {
        double sum = 0;
        for (const auto &component : components)
          sum += component(cell) * component(cell);
        return std::sqrt(sum);
      }
    };


    /// Velocities in the centres of whole cells, and after them 1 there.
    static Fields
    centre_velocities(const FluidStage<dim> &step)
    {
      // In stages the velocity before forces act is a whole stage of them off.
      auto velocity = step.stage.keeps_rates() ? step.flow_at_end() : step.state.velocity;
      exchange(velocity);
      Fields      result(dim + 1, Field<dim>(step.model.grid().cells()));
      const auto *open = velocity.topology();
      for_each(result[dim].owned(), [&](const GridIndex<dim> &cell) {
        if (open && open->cells.kind(cell) != SubLattice<dim>::Kind::whole)
          return;
        for (unsigned int axis = 0; axis < dim; ++axis)
          result[axis](cell) =
            (velocity[axis](cell) + velocity[axis](moved<dim>(cell, axis, 1))) / 2;
        result[dim](cell) = 1;
      });
      for (auto &field : result)
        field.exchange(1);
      return result;
    }


    /// Between the centres of the cells on either side [m].
    static double
    distance(const MacGrid<dim> &grid, const unsigned int axis, const int below, const int above)
    {
      double sum = (grid.cell_width(axis, below) + grid.cell_width(axis, above)) / 2;
      for (int between = below + 1; between < above; ++between)
        sum += grid.cell_width(axis, between);
      return sum;
    }


    static Vorticity
    vorticity(const FluidStage<dim> &step)
    {
      const auto &grid     = step.model.grid();
      const auto  velocity = centre_velocities(step);
      const auto &is_whole = velocity[dim];
      Vorticity   result{Fields(dim * (dim - 1) / 2, Field<dim>(grid.cells())),
                       Field<dim>(grid.cells())};
      for_each(is_whole.owned(), [&](const GridIndex<dim> &cell) {
        dealii::Tensor<2, dim> gradient; // [axis of derivative][component]
        double                 whole = is_whole(cell);
        for (unsigned int a = 0; a < dim; ++a)
          {
            const auto below = moved<dim>(cell, a, -1), above = moved<dim>(cell, a, 1);
            whole *= is_whole(below) * is_whole(above);
            if (whole == 0)
              return;
            for (unsigned int b = 0; b < dim; ++b)
              gradient[a][b] =
                (velocity[b](above) - velocity[b](below)) / distance(grid, a, below[a], above[a]);
          }
        result.known(cell) = 1;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = a + 1; b < dim; ++b)
            result.components[a + b - 1](cell) = gradient[a][b] - gradient[b][a];
      });
      for (auto &component : result.components)
        component.exchange(1);
      result.known.exchange(1);
      return result;
    }


    /// grad|omega| from the cell and those next to it whose vorticity is known [1/(m s)].
    static dealii::Tensor<1, dim>
    gradient_of_magnitude(const MacGrid<dim>   &grid,
                          const Vorticity      &vorticity,
                          const GridIndex<dim> &cell)
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int a = 0; a < dim; ++a)
        {
          auto below = moved<dim>(cell, a, -1), above = moved<dim>(cell, a, 1);
          if (vorticity.known(below) == 0)
            below = cell;
          if (vorticity.known(above) == 0)
            above = cell;
          if (below[a] < above[a])
            result[a] = (vorticity.magnitude(above) - vorticity.magnitude(below)) /
                        distance(grid, a, below[a], above[a]);
        }
      return result;
    }


    /// f in the centres of cells, with one ghost layer [m/s^2].
    Fields
    confining_forces(FluidStage<dim> &step) const
    {
      const auto &grid  = step.model.grid();
      const auto  omega = vorticity(step);
      Fields      result(dim, Field<dim>(grid.cells()));
      for_each(omega.known.owned(), [&](const GridIndex<dim> &cell) {
        if (omega.known(cell) == 0)
          return;
        constexpr double even     = 1e-6; // a relative change over a cell that has no direction
        const double     width    = std::pow(grid.cell_volume(cell), 1. / dim);
        const auto       gradient = gradient_of_magnitude(grid, omega, cell);
        if (gradient.norm() * width <= even * omega.magnitude(cell))
          return;
        const auto towards_core = gradient / gradient.norm();
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            result[a](cell) += strength * width * omega(a, b, cell) * towards_core[b];
      });
      std::size_t memory = (dim + 1) * omega.known.memory_consumption(); // velocities in centres
      for (auto &force : result)
        {
          force.exchange(1);
          memory += force.memory_consumption();
        }
      for (const auto &component : omega.components)
        memory += component.memory_consumption();
      step.timing.memory.hold_briefly(this->name, memory + omega.known.memory_consumption());
      return result;
    }

    double strength = 0; // [1/s]
  };


  namespace
  {
    const RegisterForDimensions<Effect, VorticityConfinement>
      registered_vorticity_confinement("vorticity confinement",
                                       "Keeps vortices that the grid would smooth away.");
  }
} // namespace undine
