// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/advice.h>
#include <undine/solid/material/material.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double earth = 9.81; // [m/s^2]


    /// The numbers of a run, and the rules by which they speak for or against an effect.
    template <int dim>
    class Rules
    {
    public:
      Rules(const Models<dim> &models, const Extremes &largest)
        : models(models)
        , largest(largest)
        , gravity(models.requests_of_effects().gravity.norm())
      {
      }

      Advice
      advice()
      {
        if (models.fluid && largest.speed > 0)
          judge_flow();
        if (models.solid)
          judge_bodies();
        if (models.fluid && models.solid)
          judge_coupling();
        return result;
      }

    private:
      bool
      is_on(const std::string &name) const
      {
        return std::any_of(models.effects.begin(), models.effects.end(), [&](const auto &effect) {
          return effect->name == name;
        });
      }

      double
      add(const std::string &name, const double value, const std::string &meaning)
      {
        result.numbers.push_back({name, value, meaning});
        return value;
      }

      /// Remark on an effect that is on and could be left out: the number that was added last says
      /// so by this rule.
      void
      call_idle(const std::string &effect, const std::string &rule)
      {
        const auto &number = result.numbers.back();
        result.remarks.push_back({effect, true, number.name, number.value, rule});
      }

      /// The same of an effect that is off and would matter.
      void
      call_missing(const std::string &effect, const std::string &rule)
      {
        const auto &number = result.numbers.back();
        result.remarks.push_back({effect, false, number.name, number.value, rule});
      }

      double
      narrowest_cell() const
      {
        const auto &grid  = models.fluid->grid();
        double      width = std::numeric_limits<double>::infinity();
        for (unsigned int axis = 0; axis < dim; ++axis)
          for (int cell = 0; cell < grid.cells_along()[axis]; ++cell)
            width = std::min(width, grid.cell_width(axis, cell));
        return width;
      }

      void
      judge_flow()
      {
        const double U = largest.speed, L = largest.length, density = models.fluid->density();
        const bool   advects = is_on("convection");
        if (largest.viscosity > 0)
          {
            const double reynolds =
              add("Reynolds number", density * U * L / largest.viscosity, "rho U L / mu");
            const std::string rule =
              "friction outweighs inertia where Re < 0.01, inertia counts where Re > 1";
            if (advects && reynolds < 0.01)
              call_idle("convection", rule);
            if (!advects && reynolds > 1)
              call_missing("convection", rule);
            const double layer = add("friction layer over cell width",
                                     L / std::sqrt(reynolds) / narrowest_cell(),
                                     "L / sqrt(Re) / dx");
            if (layer < 0.1)
              call_idle("viscosity",
                        "layers of friction thinner than a tenth of a cell are not resolved");
          }
        else
          {
            const double way = add("way of the fluid over length", U * largest.time / L, "U T / L");
            const std::string rule =
              "without friction a fluid that moves by a tenth of a length advects its "
              "velocity, by less than a thousandth not";
            if (advects && way < 1e-3)
              call_idle("convection", rule);
            if (!advects && way > 0.1)
              call_missing("convection", rule);
          }
        if (gravity > 0 && is_on("buoyancy"))
          {
            const double richardson =
              add("Richardson number", largest.lift * gravity * L / (U * U), "|beta ds| g L / U^2");
            if (richardson < 1e-3)
              call_idle("buoyancy", "lift does not bend a flow with Ri < 0.001");
          }
        if (gravity > 0)
          {
            const bool weighs = models.solid || models.void_regions || is_on("buoyancy");
            add("Froude number", U / std::sqrt(gravity * L), "U / sqrt(g L)");
            if (!weighs)
              call_idle("gravity",
                        "the weight of a fluid of one density, without bodies in it, is part of "
                        "its pressure");
          }
      }

      void
      judge_bodies()
      {
        bool is_finite = false;
        for (const auto &body : models.solid->bodies())
          is_finite = is_finite || body.material->is_objective();
        add("largest displacement gradient", largest.gradient, "|dd/dX|");
        const std::string rule = "strains and rotations below 0.001 are linear, above 0.05 not";
        if (is_finite && largest.gradient < 1e-3)
          call_idle("finite strain", rule);
        if (!is_finite && largest.gradient > 0.05)
          call_missing("finite strain", rule);
        if (is_on("damping") && largest.damped > 0 && largest.body_energy > 0)
          {
            const double share = add("damped energy over energy of bodies",
                                     largest.damped / largest.body_energy,
                                     "sum |C u . dd| / max (kinetic + elastic)");
            if (share < 1e-3)
              call_idle("damping", "less than a thousandth of the bodies' energy went there");
          }
      }

      void
      judge_coupling()
      {
        const double fluid = models.fluid->density();
        double       ratio = std::numeric_limits<double>::infinity(), modulus = ratio;
        for (const auto &body : models.solid->bodies())
          {
            ratio   = std::min(ratio, body.density / fluid);
            modulus = std::min(modulus, body.material->p_wave_modulus());
          }
        const double U = largest.speed, L = largest.length;
        const double mass = add("mass ratio", ratio, "rho of the lightest body / rho of the fluid");
        if (is_on("gravity") || U == 0)
          judge_weight(mass, U, L);
        else
          {
            const double weight = add("weight over pressure of the flow",
                                      std::abs(mass - 1) * earth * L / (U * U),
                                      "|rho_s/rho_f - 1| g L / U^2 with g = 9.81 m/s^2");
            if (weight > 0.1)
              call_missing(
                "gravity",
                "on Earth the weight of bodies would exceed a tenth of what the flow does");
          }
        add("Cauchy number", fluid * U * U / modulus, "rho U^2 / (lambda + 2 mu)");
        judge_direction(mass, U, L);
      }

      void
      judge_weight(const double mass, const double U, const double L)
      {
        if (gravity == 0 || U == 0)
          return;
        const double weight = add("weight over pressure of the flow",
                                  std::abs(mass - 1) * gravity * L / (U * U),
                                  "|rho_s/rho_f - 1| g L / U^2");
        if (weight < 1e-3)
          call_idle("gravity", "the weight of bodies is below a thousandth of what the flow does");
      }

      void
      judge_direction(const double mass, const double U, const double L)
      {
        const std::string name = "two-way coupling";
        if (models.direction == Direction::body_to_fluid)
          {
            const double pushed = add("mass of fluid over mass of body", 1 / mass, "rho_f / rho_s");
            if (pushed > 0.01)
              call_missing(name, "the fluid that a body pushes weighs more than a hundredth of it");
            return;
          }
        const double      speed   = U > 0 ? largest.body_speed / U : 0;
        const double      motion  = add("motion of bodies",
                                  std::max(largest.displacement / L, speed),
                                  "larger of displacement / L and speed / U");
        const bool        two_way = models.direction == Direction::two_way;
        const std::string rule =
          "the fluid does not notice bodies that move by less than 0.0001 of lengths and "
          "speeds ('Direction = fluid to body' would do), and does above 0.01";
        if (two_way && U > 0 && motion < 1e-4)
          call_idle(name, rule);
        if (!two_way && motion > 0.01)
          call_missing(name, rule);
      }

      const Models<dim> &models;
      const Extremes    &largest;
      const double       gravity; ///< [m/s^2]
      Advice             result;
    };
  } // namespace


  template <int dim>
  Advice
  make_advice(const Models<dim> &models, const Extremes &largest)
  {
    return Rules<dim>(models, largest).advice();
  }


  template Advice
  make_advice(const Models<2> &, const Extremes &);
  template Advice
  make_advice(const Models<3> &, const Extremes &);
} // namespace undine
