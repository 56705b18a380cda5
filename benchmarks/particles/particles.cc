// SPDX-License-Identifier: LGPL-2.1-or-later
// Speed of the particle method: see usage().
#include "check_run.h"
#include "dam_break.h"

#include <undine/particles/engine/engine.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace
{
  using namespace undine::particles;

  struct Choice
  {
    std::string      executor  = "device";
    std::vector<int> sizes     = {24, 44, 76};
    DamBreak::Sphere sphere    = DamBreak::Sphere::without;
    double           start     = 0.1;  ///< when timing begins [s]
    double           frame     = 0.01; ///< [s]
    int              frames    = 5;    ///< to time
    bool             phases    = false;
    Precision        precision = Precision::single_precision;
    Numerics         numerics;
  };

  void
  usage()
  {
    std::puts(
      "usage: particles_benchmark [--executor device|host] [--sizes N,N,...] [--sphere]\n"
      "                           [--start SECONDS] [--frame SECONDS] [--frames N] [--phases]\n"
      "                           [--double] [--tolerance X] [--threads N]\n"
      "                           [--pair-force balanced|corrected|minimum|conserving]\n"
      "                           [--preconditioner automatic|jacobi|multigrid] [--help]\n\n"
      "Sub-steps per second of a dam that has been breaking for a while. N: particles along the\n"
      "column's width; 24, 44, 76, 123 and 168 make 45,360, 229,240, 1,052,600, 4,177,818 and\n"
      "10,333,008 particles. Exits with 1 if a run it has timed makes no sense.");
  }

  template <class Value>
  Value
  named(const std::string &name, const std::vector<std::pair<const char *, Value>> &values)
  {
    for (const auto &value : values)
      if (name == value.first)
        return value.second;
    throw undine::InputError("unknown name '" + name + "'");
  }

  std::vector<int>
  numbers(const char *text)
  {
    std::vector<int> result;
    for (char *end = nullptr; *text != 0; text = *end == ',' ? end + 1 : end)
      {
        result.push_back(static_cast<int>(std::strtol(text, &end, 10)));
        if (end == text)
          throw undine::InputError("not a list of numbers: " + std::string(text));
      }
    return result;
  }

  Choice
  read(const int argc, char **argv)
  {
    Choice choice;
    for (int k = 1; k < argc; ++k)
      {
        const std::string key  = argv[k];
        const auto        next = [&]() {
          if (k + 1 == argc)
            throw undine::InputError(key + " needs a value");
          return argv[++k];
        };
        if (key == "--executor")
          choice.executor = next();
        else if (key == "--sizes")
          choice.sizes = numbers(next());
        else if (key == "--sphere")
          choice.sphere = DamBreak::Sphere::with;
        else if (key == "--start")
          choice.start = std::atof(next());
        else if (key == "--frame")
          choice.frame = std::atof(next());
        else if (key == "--frames")
          choice.frames = std::atoi(next());
        else if (key == "--phases")
          choice.phases = true;
        else if (key == "--double")
          choice.precision = Precision::double_precision;
        else if (key == "--tolerance")
          choice.numerics.tolerance = std::atof(next());
        else if (key == "--threads")
          choice.numerics.threads = std::atoi(next());
        else if (key == "--pair-force")
          choice.numerics.pair_force = named<PairForce>(next(),
                                                        {{"balanced", PairForce::balanced},
                                                         {"corrected", PairForce::corrected},
                                                         {"minimum", PairForce::minimum},
                                                         {"conserving", PairForce::conserving}});
        else if (key == "--preconditioner")
          choice.numerics.preconditioner =
            named<Numerics::Preconditioner>(next(),
                                            {{"automatic", Numerics::Preconditioner::automatic},
                                             {"jacobi", Numerics::Preconditioner::jacobi},
                                             {"multigrid", Numerics::Preconditioner::multigrid}});
        else if (key == "--help")
          {
            usage();
            std::exit(EXIT_SUCCESS);
          }
        else
          throw undine::InputError("unknown option " + key + "; --help lists those there are");
      }
    return choice;
  }


  void
  print_iterations(const char *name, const SolverRecord &record, const unsigned int steps)
  {
    std::printf("  %s: %.1f iterations a step, at most %u, %u not converged, worst residual %.1e\n",
                name,
                static_cast<double>(record.iterations) / steps,
                record.most_iterations,
                record.not_converged,
                record.worst_residual);
  }

  void
  add(SolverRecord &to, const SolverRecord &from)
  {
    to.iterations += from.iterations;
    to.most_iterations = std::max(to.most_iterations, from.most_iterations);
    to.not_converged += from.not_converged;
    to.worst_residual = std::max(to.worst_residual, from.worst_residual);
  }


  /// False if the result makes no sense.
  bool
  measure(const Choice &choice, const int n)
  {
    DamBreak dam(n, choice.sphere);
    dam.setup.numerics = choice.numerics;
    auto factory       = undine::Registry<EngineFactory<3>>::instance().make(choice.executor);
    auto engine        = factory->make(choice.precision, 0);
    engine->load(dam.setup, dam.start);
    double time = 0;
    for (; time < choice.start - choice.frame / 2; time += choice.frame)
      engine->advance(choice.frame);
    const double energy_before = energy_of(engine->balance());
    if (choice.phases)
      engine->time_phases();
    StepControl sum;
    const auto  begin = std::chrono::steady_clock::now();
    for (int frame = 0; frame < choice.frames; ++frame, time += choice.frame)
      {
        const auto control = engine->advance(choice.frame);
        sum.sub_steps += control.sub_steps;
        sum.elastic_steps_total += control.elastic_steps_total;
        add(sum.pressure, control.pressure);
        add(sum.faces, control.faces);
      }
    const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf(
      "%zu particles on %s: %.1f steps/s, %.3f ms a step, %u steps, %.2f s per simulated s\n",
      dam.start.tags.size(),
      engine->describe().c_str(),
      sum.sub_steps / seconds,
      1e3 * seconds / sum.sub_steps,
      sum.sub_steps,
      seconds / (choice.frames * choice.frame));
    print_iterations("pressure", sum.pressure, sum.sub_steps);
    print_iterations("virtual faces", sum.faces, sum.sub_steps);
    if (choice.sphere == DamBreak::Sphere::with)
      std::printf("  elastic steps: %.1f a step\n",
                  static_cast<double>(sum.elastic_steps_total) / sum.sub_steps);
    if (choice.phases)
      for (const auto &phase : engine->seconds())
        std::printf("  %-20s %8.4f ms\n", phase.first.c_str(), 1e3 * phase.second / sum.sub_steps);
    const Throughput memory = engine->throughput();
    std::printf("  product with the matrix: %.0f GB/s, %.0f %% of the %.0f GB/s of a copy\n",
                memory.product / 1e9,
                100 * memory.product / memory.copy,
                memory.copy / 1e9);
    const bool good = is_plausible(dam, *engine, {time, energy_before, sum.pressure.not_converged});
    std::fflush(stdout);
    return good;
  }
} // namespace


int
main(const int argc, char **argv)
{
  try
    {
      const Choice choice = read(argc, argv);
      bool         good   = true;
      for (const int n : choice.sizes)
        good &= measure(choice, n);
      return good ? 0 : 1;
    }
  catch (const undine::Error &error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      return error.exit_code();
    }
}
