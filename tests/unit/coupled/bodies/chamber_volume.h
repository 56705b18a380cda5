// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_chamber_volume_h
#define undine_tests_chamber_volume_h

#include <undine/coupled/immersed/measure_region.h>

#include <coupled/coupled_run.h>

namespace undine_tests
{
  /// What has flown into the chamber around a place, and what it holds more than at first.
  template <int dim>
  class ChamberRecord
  {
  public:
    ChamberRecord(const CoupledRun<dim> &run, const dealii::Point<dim> &place)
      : run(run)
      , place(place)
      , first(measure().volume)
    {
    }

    /// After every step.
    void
    note_step()
    {
      inflow += run.report.dt * measure().inflow;
    }

    /// [m^dim]
    double
    error() const
    {
      return measure().volume - first - inflow;
    }

    const CoupledRun<dim>   &run;
    const dealii::Point<dim> place;
    const double             first;
    double                   inflow = 0;

  private:
    RegionMeasures
    measure() const
    {
      return measure_region(run.models, run.state, place);
    }
  };
} // namespace undine_tests

#endif
