// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_scene_history_h
#define undine_tests_scene_history_h

#include <undine/driver/certificate.h>

#include <optional>
#include <string>

namespace undine
{
  /// The reports of a run with a fluid and a body, made up, for a certificate.
  class History
  {
  public:
    /// What happens in a step of 1 s.
    struct Step
    {
      double       fluid = 1, body = 0;       ///< energies [J]
      double       velocity = 0, force = 0;   ///< of the body, along x [m/s], [N]
      double       work = 0, work_at_end = 0; ///< put in, and by the force at the end [J]
      double       power          = 0;        ///< put in, at the end [W]
      double       size_of_powers = 0;        ///< [W]; less than that of `power`: the latter
      unsigned int cuts           = 0;
      double       force_on_sides = 0; ///< [N]
    };

    explicit History(const bool has_account = true, const Certificate::Scope &scope = {})
      : certificate(scope)
      , has_account(has_account)
    {
    }

    void
    add(const Step &step)
    {
      Report report;
      report.dt   = 1;
      report.cuts = step.cuts;
      place += step.velocity;
      report.columns = {{"Fluid kinetic energy", "J", step.fluid},
                        {"solid kinetic energy", "J", step.body / 2},
                        {"solid elastic energy", "J", step.body / 2},
                        {"max speed plate", "m/s", step.velocity},
                        {"centre of mass plate x", "m", place},
                        {"centre of mass plate y", "m", 0.5},
                        {"pressure force plate x", "N", step.force},
                        {"pressure force plate y", "N", 0.},
                        {"Pressure force on other sides, x", "N", 0.},
                        {"Pressure force on other sides, y", "N", step.force_on_sides}};
      if (has_account)
        {
          auto &account    = report.account.emplace();
          account.energy   = step.fluid + step.body;
          account.power    = step.power;
          account.exchange = std::max(std::abs(step.power), step.size_of_powers);
          account.add_work(step.work, step.work_at_end);
          account.known = true;
        }
      certificate.observe(++time, report);
    }

    std::string
    verdict() const
    {
      return certificate.verdict("");
    }

    std::string
    text() const
    {
      return certificate.text(time, "");
    }

    Certificate certificate;
    double      time = 0;
    std::string drawn; ///< what may tell why a verdict is wrong

  private:
    const bool has_account;
    double     place = 1;
  };
} // namespace undine

#endif
