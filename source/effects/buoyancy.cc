// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/effects/face_forces.h>
#include <undine/fluid/grid/pressure_numbers.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// Lift by small differences of density, rho (1 - beta (s - s0)) (Boussinesq): the faces are
  /// accelerated by -beta (s - s0) g (E2) for every field named. Weight itself is in the reduced
  /// pressure.
  template <int dim>
  class Buoyancy : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      for (const auto &name : options.named_sections("field"))
        {
          Lift       lift;
          const auto section = options.section(name);
          lift.scalar        = name;
          section.require("Expansion coefficient",
                          lift.expansion,
                          "",
                          Allowed::anything(),
                          "beta: loss of density, relative, per unit of the field; > 0 for what "
                          "rises, < 0 for what sinks.");
          section.add("Reference value",
                      lift.reference,
                      "",
                      Allowed::anything(),
                      "s0: value at which the fluid has its nominal density.");
          lifts.push_back(lift);
        }
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      const auto contains = [](const std::vector<std::string> &list, const std::string &word) {
        return std::find(list.begin(), list.end(), word) != list.end();
      };
      if (lifts.empty())
        throw options.error("",
                            "names no field that makes the fluid lighter or heavier",
                            "Add a subsection with the name of an advected field.");
      if (!contains(around.effects, "gravity"))
        throw options.error("",
                            "buoyancy needs gravity, which the scene does not call for",
                            "Add a subsection 'gravity' to 'Effects'.");
      for (const auto &lift : lifts)
        if (!contains(around.scalars, lift.scalar))
          throw options.section(lift.scalar)
            .error("",
                   "no field named '" + lift.scalar + "' is advected",
                   "Add it to 'Effects/scalar transport' as a subsection of that name.");
    }

    std::pair<std::string, std::string>
    reason_not_for_particles() const override
    {
      return {"what particles carry does not act back on their flow: all of a fluid "
              "have one density",
              "Remove the section, or compute the scene on a grid: 'Scheme = "
              "simultaneous'."};
    }

    std::string
    summary() const override
    {
      std::string text;
      for (const auto &lift : lifts)
        text += fmt::format("{}{}: {:.4g} ({} - {:.4g})",
                            text.empty() ? "" : "; ",
                            lift.scalar,
                            lift.expansion,
                            lift.scalar,
                            lift.reference);
      return text;
    }

    void
    accelerate(FluidStage<dim> &step) const override
    {
      const auto timed = step.timing.section(this->name);
      for (const auto &lift : lifts)
        {
          auto scalar = step.state.scalars.at(lift.scalar);
          scalar.exchange(1);
          step.timing.memory.hold_briefly(this->name, scalar.memory_consumption());
          for (unsigned int axis = 0; axis < dim; ++axis)
            if (step.gravity[axis] != 0 || step.state.velocity[axis].divided())
              accelerate_along(step, scalar, lift, axis);
        }
    }

    void
    measure(typename Effect<dim>::Scales &scales, const FluidState<dim> &state) const override
    {
      for (const auto &lift : lifts)
        for_each_value(
          state.scalars.at(lift.scalar), [&](const double value, const auto &, const auto &) {
            scales.lift =
              std::max(scales.lift, std::abs(lift.expansion * (value - lift.reference)));
          });
    }

  private:
    struct Lift
    {
      std::string scalar;
      double      expansion = 0;
      double      reference = 0;
    };

    void
    accelerate_along(FluidStage<dim>   &step,
                     const Field<dim>  &scalar,
                     const Lift        &lift,
                     const unsigned int axis) const
    {
      const auto  &grid   = step.model.grid();
      const auto  *open   = step.state.velocity.topology();
      const double factor = -lift.expansion * step.gravity[axis];
      accelerate_faces(
        step,
        axis,
        [&](const auto &face) {
          return factor * (on_face(scalar, grid, axis, face) - lift.reference);
        },
        [&](const unsigned int piece) {
          const double s = mean_of_ends(scalar, *open, axis, piece);
          return acting_on_piece(
            grid, *open, axis, piece, -lift.expansion * (s - lift.reference) * step.gravity);
        });
    }


    /// Linear between the centres of two cells; on openings the value of the cell inside.
    static double
    on_face(const Field<dim>     &scalar,
            const MacGrid<dim>   &grid,
            const unsigned int    axis,
            const GridIndex<dim> &face)
    {
      auto below = moved<dim>(face, axis, -1);
      auto above = face;
      if (grid.at_boundary(axis, face))
        (face[axis] == 0 ? below : above) = face[axis] == 0 ? above : below;
      const double width_below = grid.cell_width(axis, below[axis]);
      const double width_above = grid.cell_width(axis, above[axis]);
      return (scalar(below) * width_above + scalar(above) * width_below) /
             (width_below + width_above);
    }


    /// Mean of the values on both sides of a piece, that along the segment between them if s is
    /// linear, or of the one inside the domain.
    static double
    mean_of_ends(const Field<dim>         &scalar,
                 const FluidTopology<dim> &open,
                 const unsigned int        axis,
                 const int                 piece)
    {
      double sum = 0, n = 0;
      for (const unsigned int end : {0, 1})
        if (open.pieces[axis][piece].components[end] != FluidTopology<dim>::outside)
          {
            sum += value_at(scalar, end_of_piece(open, axis, piece, end));
            n += 1;
          }
      return n > 0 ? sum / n : 0.;
    }

    std::vector<Lift> lifts;
  };


  namespace
  {
    const RegisterForDimensions<Effect, Buoyancy>
      registered_buoyancy("buoyancy", "Lift by an advected field, such as heat or smoke.");
  }
} // namespace undine
