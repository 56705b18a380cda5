// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_energy_growth_h
#define undine_driver_energy_growth_h

#include <undine/driver/growth.h>

#include <deque>
#include <optional>

namespace undine
{
  /// Does energy grow that nobody has put in? Rules (V1) to (V3) of doc/hard_cases.md.
  class EnergyGrowth
  {
  public:
    /// The energy at the end of a step, and what was put in during the step.
    struct Step
    {
      double time         = 0; ///< at the end of the step [s]
      double energy       = 0; ///< kinetic, elastic and of contact [J]
      double input        = 0; ///< by forces and powers that are the means of both ends [J]
      double input_at_end = 0; ///< by those at the end [J]
      double exchange     = 0; ///< sum of the sizes of works and powers [J]
      double least        = 0; ///< less than this is rounding [J]
      bool   input_known  = true;
    };

    void
    observe(const Step &step);

    /// Energy that nobody has put in, unless it has been lost again. Without `where` and `mode`.
    const std::optional<Growth> &
    growth() const
    {
      return created;
    }

    /// Energy that has grown like a power of a number, where it is not known whether it was put in.
    const std::optional<Growth> &
    unexplained() const
    {
      return of_unknown_origin;
    }

    /// What has grown and was lost again.
    const std::optional<Growth> &
    past() const
    {
      return lost_again;
    }

    /// Over how many steps the last growth was found, 0: in the last step there was none.
    unsigned int
    steps_of_growth() const
    {
      return window_of_growth;
    }

  private:
    /// A moment, and sums up to it.
    struct Moment
    {
      double       time, energy, input, input_at_end, exchange;
      bool         input_known;
      unsigned int step;

      /// What nobody has put in.
      double
      of_itself() const
      {
        return energy - input;
      }
    };

    double
    put_in_since(const Moment &begin) const;
    bool
    is_created(const Moment &begin, double least) const;
    double
    largest_before() const;
    bool
    is_unexplained(unsigned int window, double least) const;
    void
    note(std::optional<Growth> &growth, const Moment &begin);
    void
    forget_what_was_lost(std::optional<Growth> &growth);
    const Moment &
    before(unsigned int steps) const
    {
      return moments[moments.size() - 1 - steps];
    }

    std::deque<Moment>    moments; ///< the last ones
    std::optional<Moment> least;   ///< that had the least energy of itself
    std::optional<Growth> created, of_unknown_origin, lost_again;
    double                peak             = 0; ///< of the energy since it grows [J]
    unsigned int          window_of_growth = 0;
  };
} // namespace undine

#endif
