// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/solid/mesh/solid_model.h>

#include <fmt/format.h>

namespace undine
{
  /// Bodies at rest are not computed until the loads on them change (SleepingBodies).
  template <int dim>
  class Sleep : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Speed",
                      settings.speed,
                      "m/s",
                      Allowed::positive(),
                      "A body falls asleep when no node of it has been faster for 'Time'. What "
                      "sleeps is off by less than twice the product of both, if 'Time' is at "
                      "least half the longest period in which the body vibrates.");
      options.require("Time",
                      settings.time,
                      "s",
                      Allowed::positive(),
                      "See 'Speed'. A body wakes when the loads of fluid and contact in the nodes "
                      "of its surface have changed, in sum, by more than its mass times 'Speed' "
                      "over 'Time'.");
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      if (!around.solid)
        throw options.error("",
                            "bodies sleep, but the scene has none on a mesh",
                            "Remove the section or add a subsection to 'Bodies'.");
      if (around.solid->numerics().integrator->coefficients(1.).mass == 0)
        throw options.error("",
                            "bodies that have no inertia do not come to rest",
                            "Remove the section, or choose another 'Time / Integrator' than "
                            "'static'.");
    }

    std::string
    summary() const override
    {
      return fmt::format(
        "bodies slower than {:.4g} m/s for {:.4g} s", settings.speed, settings.time);
    }

    void
    affect(SolidEnvironment<dim> &environment) const override
    {
      environment.sleep_settings = settings;
    }

  private:
    SleepSettings settings;
  };


  namespace
  {
    const RegisterForDimensions<Effect, Sleep>
      registered_sleep("sleep", "Bodies at rest are skipped until the loads on them change.");
  }
} // namespace undine
