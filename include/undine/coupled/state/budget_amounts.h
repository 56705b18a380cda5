// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_budget_amounts_h
#define undine_coupled_state_budget_amounts_h

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace undine
{
  /// What energy and momentum of fluid and bodies come from and go to.
  enum class BudgetTerm
  {
    // fluid
    transport, ///< by the flow, and to the new topology of the fluid
    forces,
    diffusion,
    boundary_values, ///< velocities given on inflows and walls
    sides,           ///< where the velocity is given
    openings,        ///< where the pressure is given
                     // surfaces
    obstacles,
    interface, ///< what bodies get less what the fluid gives
    fluid_at_rest,
    friction, ///< what bodies get; the fluid gives it by diffusion
              // bodies
    loads,
    supports,
    damping,
    contact,    ///< in energy the integrator's: work and gain of the potential
    integrator, ///< of fluid and bodies
    sleep,      ///< taken from bodies that fall asleep
    number
  };


  /// Amounts of energy and momentum, of every term and every effect; or their rates [J/s, N].
  template <int dim>
  struct BudgetAmounts
  {
    struct Amount
    {
      double                 energy = 0; ///< [J]
      dealii::Tensor<1, dim> momentum;   ///< [kg m/s]

      void
      add(const double factor, const Amount &other)
      {
        energy += factor * other.energy;
        momentum += factor * other.momentum;
      }
    };

    Amount &
    operator[](const BudgetTerm term)
    {
      return terms[static_cast<std::size_t>(term)];
    }

    /// this += factor * other; both of equally many effects.
    void
    add(const double factor, const BudgetAmounts &other)
    {
      for (std::size_t term = 0; term < terms.size(); ++term)
        terms[term].add(factor, other.terms[term]);
      for (std::size_t effect = 0; effect < by_effect.size(); ++effect)
        by_effect[effect] += factor * other.by_effect[effect];
    }

    std::array<Amount, static_cast<std::size_t>(BudgetTerm::number)> terms;

    std::vector<double> by_effect; ///< energy [J]
    bool                known = false;
  };
} // namespace undine

#endif
