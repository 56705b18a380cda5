// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_step_limit_h
#define undine_base_core_step_limit_h

#include <limits>

namespace undine
{
  /// How long the next step may be, after steps that had to be cut. A length that has served
  /// for a number of steps is doubled. That number is one at first, twice as many after each time
  /// that doubling it was too much, and half as many for each doubled one that serves as well: what
  /// is hard for a while is not tried again and again.
  class StepLimit
  {
  public:
    /// Of the next step [s].
    double longest = std::numeric_limits<double>::infinity();
    /// Steps that a length must serve for before it is doubled.
    unsigned int patience = 1;
    /// Steps that the present length has served for.
    unsigned int served = 0;
    /// Is the length twice one that has served, and has not served long enough itself?
    bool is_doubled = false;

    /// A step of `dt` [s] has been accepted at the first attempt.
    void
    accept(double dt);

    /// A step has been accepted after longer ones had failed, with the length `dt` [s].
    void
    accept_cut(double dt);
  };
} // namespace undine

#endif
