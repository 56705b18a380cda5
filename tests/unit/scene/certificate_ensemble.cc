// SPDX-License-Identifier: LGPL-2.1-or-later
// Verdicts on runs that are drawn at random, of kinds that are known to grow and known to be good.
#include <scene/history.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace undine;

namespace
{
  class Draw
  {
  public:
    explicit Draw(const unsigned int seed)
      : generator(seed)
    {
    }

    double
    operator()(const double lower, const double upper)
    {
      return std::uniform_real_distribution<double>(lower, upper)(generator);
    }

    /// As likely from 1 to 2 as from 2 to 4.
    double
    size(const double lower, const double upper)
    {
      return std::exp((*this)(std::log(lower), std::log(upper)));
    }

    bool
    yes()
    {
      return (*this)(0, 1) < 0.5;
    }

  private:
    std::mt19937 generator;
  };


  /// An energy that multiplies by 1.01 to 1.5 a step, with ripples and noise, beside energy that is
  /// put in and lost.
  History
  growing_energy(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double factor = 1 + draw.size(0.01, 0.5), period = draw(3, 40), ripple = draw(0, 0.2),
                 noise = draw(0, 0.05), size = draw.size(1e-6, 1e6), power = draw(0, 0.05) * size;
    const bool in_body = draw.yes();
    const int  n_steps = 103 + int(draw(0, 150));
    for (int n = 0; n < n_steps; ++n)
      {
        const double energy = size * std::pow(factor, n) *
                              (1 + ripple * std::sin(2 * M_PI / period * n)) *
                              (1 + noise * draw(-1, 1));
        History::Step step;
        step.fluid                         = 0;
        (in_body ? step.body : step.fluid) = energy;
        step.velocity                      = std::sqrt(energy) * std::sin(2 * M_PI / period * n);
        step.force                         = energy;
        step.size_of_powers                = power;
        run.add(step);
      }
    return run;
  }


  /// A body or the force on it swings with a period of 2 to 3.8 steps, its amplitude multiplies by
  /// 1.005 to 1.2 a step. The fluid has far more energy.
  History
  growing_swing(Draw &draw)
  {
    History      run;
    const double factor = 1 + draw.size(0.005, 0.2), noise = draw(0, 0.1), mean = draw(0, 1),
                 period = draw.yes() ? 2 : draw(2, 3.8), phase = draw(0, 1),
                 amplitude = draw.size(0.03, 0.3), energy = draw.size(1, 1e6);
    const bool in_force = draw.yes();
    const int  n_steps  = 110 + int(draw(0, 100));
    run.drawn           = fmt::format(
      "factor {:.4f}, period {:.4f}, noise {:.3f}, amplitude {:.3f}, mean {:.2f}, {} steps",
      factor,
      period,
      noise,
      amplitude,
      mean,
      n_steps);
    for (int n = 0; n < n_steps; ++n)
      {
        const double swing =
          amplitude *
          (std::pow(factor, n) * std::cos(2 * M_PI / period * n + phase) + noise * draw(-1, 1));
        const double slow = mean * std::sin(0.05 * n);
        run.add({energy, 1e-3, in_force ? slow : slow + swing, in_force ? slow + swing : slow});
      }
    return run;
  }


  /// A jet that spins up: the energy grows like a power of time up to a limit, by work of which the
  /// account knows the powers at the ends of steps, with an error; forces are noisy.
  History
  spin_up(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double exponent = draw(1, 4), end = draw(20, 300), noise = draw(0, 0.1),
                 error = draw(-0.05, 0.05), loss = draw(0, 2), size = draw.size(1e-3, 1e3);
    for (int n = 1; n < 250; ++n)
      {
        const double  load   = std::pow(std::min(n / end, 1.), exponent);
        const double  energy = size * load;
        const double  rate   = n < end ? size * exponent / n * load : 0;
        History::Step step;
        step.fluid          = energy;
        step.velocity       = 0.1 * std::sqrt(load) * (1 + noise * draw(-1, 1));
        step.force          = load * (1 + noise * draw(-1, 1));
        step.power          = (rate + loss * energy / end) * (1 + error);
        step.size_of_powers = 2 * step.power;
        run.add(step);
      }
    return run;
  }


  /// An impulsive start: all decays, what jumps from step to step, too.
  History
  start_with_a_jump(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double slow = draw.size(0.001, 0.1), fast = draw.size(0.02, 1),
                 jump = draw.size(0.1, 100), noise = draw(0, 0.05),
                 period = draw.yes() ? 2 : draw(2, 6);
    for (int n = 0; n < 200; ++n)
      {
        const double amplitude = jump * std::exp(-fast * n);
        const double swing     = amplitude * std::cos(2 * M_PI / period * n);
        const double decay     = std::exp(-slow * n);
        run.add({10 * decay,
                 decay + amplitude * amplitude / (1 + jump * jump),
                 decay + swing + 0.1 * noise * draw(-1, 1),
                 decay + 2 * swing + noise * draw(-1, 1)});
      }
    return run;
  }


  /// A flag that begins to swing with a period of 8 to 60 steps, fed by a flow that works all the
  /// time.
  History
  limit_cycle(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double period = draw(8, 60), rate = draw.size(0.005, 0.1), flow = draw.size(3, 100),
                 noise = draw(0, 0.03), seed = draw.size(1e-6, 1e-2);
    for (int n = 0; n < 400; ++n)
      {
        const double  amplitude = std::tanh(seed * std::exp(std::min(rate * n, 50.)));
        const double  angle     = 2 * M_PI / period * n;
        History::Step step;
        step.body     = amplitude * amplitude;
        step.fluid    = flow - 0.5 * step.body * (1 + 0.2 * std::sin(2 * angle));
        step.velocity = amplitude * (std::sin(angle) + noise * draw(-1, 1));
        step.force =
          amplitude * (std::cos(angle) + 0.2 * std::cos(3 * angle)) + noise * draw(-1, 1);
        step.power          = 0;
        step.size_of_powers = flow / 10;
        run.add(step);
      }
    return run;
  }


  /// A load is switched on: a damped oscillation about the new rest, fed by its work.
  History
  load_switched_on(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double period = draw(6, 80), damping = draw(0, 0.3), size = draw.size(1e-3, 1e3);
    const int    begin = int(draw(0, 50));
    double       last  = 0;
    for (int n = 0; n < 250; ++n)
      {
        const double  t = std::max(0, n - begin), omega = 2 * M_PI / period;
        const double  decay    = std::exp(-damping * omega * t);
        const double  way      = 1 - decay * std::cos(omega * t);
        const double  velocity = omega * decay * std::sin(omega * t);
        History::Step step;
        step.fluid    = 0;
        step.body     = size / 2 * (way * way + std::pow(decay * std::sin(omega * t), 2));
        step.velocity = velocity;
        step.force    = n >= begin ? 1 : 0;
        step.work = step.work_at_end = size * (way - last);
        last                         = way;
        run.add(step);
      }
    return run;
  }


  /// A body falls, bounces and loses energy each time.
  History
  falling_body(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double weight = draw.size(1e-3, 10), restitution = draw(0.2, 0.95), height = draw(5, 50);
    double       place = height, velocity = 0;
    for (int n = 0; n < 250; ++n)
      {
        const double before = place;
        if (place > 0 || velocity != 0)
          velocity -= 0.05;
        place += velocity;
        const bool hits = place < 0;
        if (hits)
          {
            place    = 0;
            velocity = velocity < -0.2 ? -restitution * velocity : 0; // or it comes to rest
          }
        History::Step step;
        step.fluid = 0;
        // The energy belongs to the place, so that weight does just what it says.
        step.body     = weight * std::pow(velocity, 2) / 2 / 0.05;
        step.velocity = velocity;
        step.force    = hits ? 100 : 0;
        step.work = step.work_at_end = weight * (before - place);
        run.add(step);
      }
    return run;
  }


  /// All is steady but for noise, or for a swing from step to step that comes and goes a little.
  History
  bounded(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double noise = draw(0, 0.5), period = draw.yes() ? 2 : draw(2, 6), swing = draw(0, 0.5),
                 beat = draw(20, 500), depth = draw(0, 0.1), size = draw.size(1e-6, 1e6);
    for (int n = 0; n < 300; ++n)
      {
        const double more =
          swing * (1 + depth * std::sin(2 * M_PI / beat * n)) * std::cos(2 * M_PI / period * n);
        const double velocity = 1 + more + noise * draw(-1, 1);
        run.add({10 * size * (1 + 0.1 * noise * draw(-1, 1)),
                 size * velocity * velocity,
                 velocity,
                 1 + more + noise * draw(-1, 1),
                 0,
                 0,
                 0,
                 20 * size});
      }
    return run;
  }


  /// A stiff mode with a period of little more than two steps, in which a load has set it off: its
  /// samples swell and fade.
  History
  stiff_mode(Draw &draw, const bool has_account)
  {
    History      run(has_account);
    const double period = 2 + draw.size(5e-3, 0.2), phase = draw(0, 2 * M_PI), swing = draw(0, 1),
                 noise = draw.size(1e-6, 1e-1) * swing, damping = draw.yes() ? 0 : draw(0, 0.01);
    run.drawn =
      fmt::format("period {:.4f}, phase {:.2f}, swing {:.2f}, noise {:.3f}, damping {:.4f}",
                  period,
                  phase,
                  swing,
                  noise / swing,
                  damping);
    for (int n = 0; n < 400; ++n)
      {
        const double more =
          swing * std::exp(-damping * n) * std::cos(2 * M_PI / period * n + phase) +
          noise * draw(-1, 1);
        run.add({1, 0.1, 0.3 + more, 1 + more});
      }
    return run;
  }
} // namespace


TEST_CASE("of 300 runs that grow none is called stable")
{
  Draw         draw(314159);
  unsigned int n_growing = 0;
  for (int n = 0; n < 100; ++n)
    {
      const auto known = growing_energy(draw, true), unknown = growing_energy(draw, false),
                 swing = growing_swing(draw);
      INFO(n << ": " << known.text() << "\n"
             << unknown.text() << "\n"
             << swing.drawn << ": " << swing.text());
      CHECK(known.verdict() == "growing");
      CHECK(unknown.verdict() != "stable");
      CHECK(swing.verdict() != "stable");
      n_growing += (known.verdict() != "stable") + (unknown.verdict() != "stable") +
                   (swing.verdict() != "stable");
    }
  CHECK(n_growing == 300);
}


TEST_CASE("of 700 good runs none is called growing")
{
  using Kind = History (*)(Draw &, bool);
  const std::vector<std::pair<std::string, Kind>> kinds{{"spin-up", spin_up},
                                                        {"start with a jump", start_with_a_jump},
                                                        {"limit cycle", limit_cycle},
                                                        {"load switched on", load_switched_on},
                                                        {"falling body", falling_body},
                                                        {"bounded", bounded},
                                                        {"stiff mode", stiff_mode}};
  Draw                                            draw(271828);
  unsigned int                                    n_good = 0, n_stable = 0;
  for (const auto &[name, kind] : kinds)
    for (int n = 0; n < 100; ++n)
      {
        const bool has_account = n < 60;
        const auto run         = kind(draw, has_account);
        INFO(name << ", " << n << ": " << run.drawn << ": " << run.text());
        CHECK(run.verdict() != "growing");
        if (has_account && name != "stiff mode")
          CHECK(run.verdict() == "stable");
        n_good += run.verdict() != "growing";
        n_stable += run.verdict() == "stable";
      }
  CHECK(n_good == 700);
  WARN(n_stable << " of 700 are stable, the others undecided");
}
