// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_impulses_h
#define undine_coupled_state_impulses_h

#include <undine/base/core/stage.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// What a kind of force of the fluid on bodies and obstacles has done since the start of the run:
  /// over a stage (T10) the impulse is that by which the force has moved the fluid,
  ///
  ///     sum_j l_j F_j + g F                                                             [N s] (B4)
  ///
  /// with the weights of (B1). All vectors are [bodies, then obstacles], in 2D per metre of depth.
  template <int dim>
  class Impulse
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// Of so many bodies and obstacles.
    explicit Impulse(const unsigned int n = 0)
      : sum(n)
    {
    }

    /// A stage has ended with `forces`, of which `kept` is the rate that later stages go on with
    /// [N]. Where nothing is known of the time at which a stage begins, as in a run that was
    /// resumed from one without impulses, forces have been what they are at its end.
    void
    add(const Stage &stage, const Vectors &forces, const Vectors &kept);

    Vectors              sum;   ///< [N s]
    std::vector<Vectors> rates; ///< at the begin of the step and the ends of its stages [N]
  };


  /// The impulses of pressure and friction. Of no bodies where there is no friction.
  template <int dim>
  struct Impulses
  {
    Impulse<dim> pressure, friction;
  };
} // namespace undine

#endif
