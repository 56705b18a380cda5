// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

#include <message_of.h>

using namespace undine_tests;

namespace
{
  constexpr double drift_speed = 1e-3; // V [m/s]
  constexpr double rest        = 0.25; // T [s]

  std::string
  sleep(const double slow = drift_speed, const double time = rest)
  {
    return section("sleep", fmt::format("set Speed = {}\nset Time = {}", slow, time));
  }


  /// A post of 0.5 m on the ground at x that vibrates with a period of 0.49 s; its top starts with
  /// `top_speed` [m/s].
  template <int dim>
  std::string
  post(const std::string &name,
       const double       x,
       const double       top_speed,
       const std::string &more = "")
  {
    const std::string corners =
      fmt::format(plane_or_space<dim>(
                    "set Lower corner = {}, -.05\nset Upper corner = {}, .45\nset Cells = 1, 4",
                    "set Lower corner = {}, -.05, .4\nset Upper corner = {}, .45, .6\n"
                    "set Cells = 1, 3, 1"),
                  x,
                  x + .1);
    return body(name,
                corners +
                  "\nset Density = 1000\nset Young's modulus = 1e6\n"
                  "set Poisson's ratio = .3\nset Initial velocity = " +
                  fmt::format(plane_or_space<dim>("{} * (y + .05); 0", "{} * (y + .05); 0; 0"),
                              2 * top_speed),
                clamp("foot", "1", "set Sides = bottom") + more);
  }


  /// One that vibrates, three that hardly do.
  template <int dim>
  std::string
  four_posts()
  {
    return section("Bodies",
                   post<dim>("a", .1, 0.3) + post<dim>("b", .3, 8e-4) + post<dim>("c", .5, 8e-4) +
                     post<dim>("d", .7, 0));
  }


  /// Not to the bit what another number of ranks makes of it.
  template <int dim>
  double
  largest_difference(const CoupledRun<dim> &one, const CoupledRun<dim> &other)
  {
    auto difference = one.state.solid.displacement;
    difference -= other.state.solid.displacement;
    return difference.linfty_norm();
  }


  /// No worse than where all bodies are awake.
  template <int dim>
  void
  check_closures(const CoupledRun<dim> &run, const CoupledRun<dim> &awake)
  {
    for (const auto &name : {"energy closure", "momentum closure"})
      CHECK(run.column(name) < 1e-8 + 10 * awake.column(name));
  }


  template <int dim>
  unsigned int
  n_asleep(const CoupledRun<dim> &run)
  {
    unsigned int count = 0;
    for (const bool asleep : run.state.sleep.asleep)
      count += asleep;
    return count;
  }


  /// A channel, open on the right, in which fluid of density 10 rests until the left side pushes.
  template <int dim>
  std::string
  channel(const std::string &inflow, const double density = 10)
  {
    const std::string velocity = inflow + plane_or_space<dim>("; 0", "; 0; 0");
    return section("Domain", plane_or_space<dim>("set Cells = 12, 12", "set Cells = 8, 8, 6")) +
           section("Fluid",
                   fmt::format("set Density = {}\n", density) +
                     section("Pressure solver", "set Divergence tolerance = 1e-12") +
                     section("Boundaries",
                             boundary("in", "left", "inflow", "set Velocity = " + velocity) +
                               boundary("out", "right", "outflow")));
  }


  template <int dim>
  std::string
  two_posts()
  {
    return section("Bodies", post<dim>("b", .2, 2e-4) + post<dim>("a", .6, 0.01));
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "bodies that sleep are off by less than V T", "[sleep][mpi]", ((int dim), dim), 2, 3)
{
  const std::string scene = steps_of(.02) + budget + four_posts<dim>();
  CoupledRun<dim>   run(scene + section("Effects", sleep())), awake(scene);
  double            largest = 0, taken = 0;
  for (unsigned int n = 0; n < 40; ++n)
    {
      run.step();
      awake.step();
      largest = std::max(largest, largest_difference(run, awake));
      CHECK(run.column("energy closure") < 1e-9);
      CHECK(run.column("momentum closure") < 1e-9);
      taken += run.column("energy by sleep");
    }
  CHECK(n_asleep(run) == 3);
  CHECK(run.column("asleep a") == 0);
  CHECK(run.column("asleep b") == 1);
  CHECK(run.column("max speed b") == 0);
  CHECK(largest < drift_speed * rest);
  CHECK(largest > 1e-3 * drift_speed * rest);
  // The largest energy with which two of these posts may fall asleep.
  const double mass = std::stod(plane_or_space<dim>("50", "10"));
  CHECK(taken < 0);
  CHECK(-taken < 2 * mass * drift_speed * drift_speed / 2);
}


TEST_CASE("what is awake does not notice what sleeps", "[sleep][mpi]")
{
  const std::string scene = steps_of(.02) + budget;
  CoupledRun<2>     run(scene + four_posts<2>() + section("Effects", sleep()));
  CoupledRun<2>     alone(scene + section("Bodies", post<2>("a", .1, 0.3)));
  for (unsigned int n = 0; n < 40; ++n)
    {
      run.step();
      alone.step();
    }
  CHECK(n_asleep(run) == 3);
  CHECK(run.report.newton_iterations == alone.report.newton_iterations);
  CHECK(run.column("centre of mass a x") ==
        Approx(alone.column("centre of mass a x")).epsilon(1e-8));
  CHECK(run.column("reaction a/foot x") == Approx(alone.column("reaction a/foot x")).epsilon(1e-6));
}


TEST_CASE("where all sleep nothing is computed, and statistics go on", "[sleep][mpi]")
{
  const auto    posts = section("Bodies", post<2>("a", .1, 8e-4) + post<2>("b", .3, 0));
  const auto    down  = section("gravity", "set Acceleration = 0, -1e-5");
  CoupledRun<2> run(steps_of(.02) + budget + posts + section("Effects", sleep() + down));
  const auto    first = run.report.columns;
  while (n_asleep(run) < 2)
    run.step();
  const double energy = run.column("solid elastic energy");
  const auto   calls  = run.timing.work_of("assemble forces").calls;
  run.step();
  run.step();
  CHECK(run.timing.work_of("assemble forces").calls == calls);
  REQUIRE(run.report.columns.size() == first.size());
  for (unsigned int c = 0; c < first.size(); ++c)
    CHECK(run.report.columns[c].name == first[c].name);
  CHECK(run.column("solid kinetic energy") == 0);
  CHECK(run.column("solid elastic energy") == Approx(energy).epsilon(1e-6));
  CHECK(run.column("energy closure") < 1e-9);
}


template <int dim>
void
check_waking_by_fluid()
{
  const std::string coupling =
    GENERATE(as<std::string>(), "", "set Scheme = time_splitting\n", "fluid to body");
  const bool        one_way = coupling == "fluid to body";
  const std::string scene =
    (one_way ? section("Coupling", "set Direction = fluid to body") : coupling) + steps_of(.05) +
    budget + two_posts<dim>() + channel<dim>("2 * max(0, t - 1)");
  INFO(dim << "D, " << coupling);
  // Loads change by what the first post does, too.
  constexpr double slow = 2e-3;
  CoupledRun<dim>  run(scene + section("Effects", convection() + sleep(slow)));
  CoupledRun<dim>  awake(scene + section("Effects", convection()));
  double           largest = 0;
  for (unsigned int n = 0; n < 19; ++n)
    {
      run.step();
      awake.step();
      largest = std::max(largest, largest_difference(run, awake));
      check_closures(run, awake);
    }
  CHECK(run.column("asleep b") == 1);
  CHECK(largest < 2 * slow * rest);
  bool   woke = false;
  double path = 0;
  // Later the flow past the posts makes much of small differences.
  for (unsigned int n = 0; n < 18; ++n)
    {
      run.step();
      awake.step();
      woke |= run.column("asleep b") == 0;
      check_closures(run, awake);
      path = awake.column("centre of mass b x") - .25;
      CHECK(std::abs(run.column("centre of mass b x") - .25 - path) < 2 * slow * rest);
    }
  CHECK(woke);
  CHECK(path > 2 * slow * rest);
}


TEST_CASE("a fluid that begins to flow wakes bodies", "[sleep][mpi]")
{
  check_waking_by_fluid<2>();
}


TEST_CASE("a fluid that begins to flow wakes bodies in space", "[sleep]")
{
  check_waking_by_fluid<3>();
}


TEST_CASE("bodies that the fluid does not move sleep on in a stream", "[sleep]")
{
  CoupledRun<2> run(section("Coupling", "set Direction = body to fluid") + steps_of(.05) +
                    section("Bodies", post<2>("a", .45, 0)) + channel<2>("t") +
                    section("Effects", convection() + sleep(1e-2)));
  bool          slept = false;
  for (unsigned int n = 0; n < 20; ++n)
    {
      run.step();
      CHECK((!slept || run.column("asleep a") == 1));
      slept |= run.column("asleep a") == 1;
    }
  CHECK(slept);
  CHECK(run.column("pressure force a x") > 1e-2);
}


TEST_CASE("what a stream gains while bodies are awake is not created when they sleep again",
          "[sleep]")
{
  // The fluid moves bodies and not the other way round, of which there is no energy account.
  CoupledRun<2> run(
    section("Coupling", "set Direction = fluid to body") + steps_of(.05) +
    section("Bodies", post<2>("a", .45, 0)) +
    channel<2>("if(t<.8, .01, if(t<1.6, .01 + 5*(t-.8), 4.01))") +
    section("Effects",
            convection() + sleep(1e-2) + section("damping", "set Stiffness coefficient = .05")));
  unsigned int awake        = 0;
  bool         asleep_again = false;
  for (unsigned int n = 0; n < 60; ++n)
    {
      run.step();
      CHECK(run.report.cuts == 0);
      CHECK(run.report.warnings.empty());
      const bool sleeps = run.column("asleep a") == 1;
      awake += n > 10 && !sleeps;
      asleep_again |= awake > 0 && sleeps;
    }
  CHECK(awake > 0);
  CHECK(asleep_again);
}


TEST_CASE("fluid flows on where all bodies sleep", "[sleep][mpi]")
{
  const std::string friction =
    GENERATE(as<std::string>(), "", section("viscosity", "set Dynamic viscosity = .05"));
  const auto scene =
    steps_of(.05) + budget + section("Bodies", post<2>("a", .45, 0)) + channel<2>("1e-3", 1);
  CoupledRun<2> run(scene + section("Effects", convection() + friction + sleep(1e-2)));
  CoupledRun<2> awake(scene + section("Effects", convection() + friction));
  const auto    n_columns = run.report.columns.size();
  for (unsigned int n = 0; n < 12; ++n)
    {
      run.step();
      awake.step();
      check_closures(run, awake);
      if (n >= 6) // all asleep: nothing but the projection
        CHECK(run.column("energy closure") < 1e-9);
    }
  CHECK(run.column("asleep a") == 1);
  CHECK(run.report.newton_iterations == 0);
  CHECK(run.report.columns.size() == n_columns);
  CHECK(run.column("Fluid kinetic energy") ==
        Approx(awake.column("Fluid kinetic energy")).epsilon(1e-2));
}


template <int dim>
void
check_waking_by_contact()
{
  const auto ball = [](const std::string &name, const double x, const double velocity) {
    const std::string zeros = plane_or_space<dim>(", 0", ", 0, 0");
    return body(name,
                fmt::format("set Shape = ball\nset Radius = .1\nset Centre = {}{}\n"
                            "set Initial velocity = {}{}\nset Density = 1000\n"
                            "set Young's modulus = 2e4\nset Poisson's ratio = .3\n"
                            "set Refinements = 1\n",
                            x,
                            zeros,
                            velocity,
                            plane_or_space<dim>("; 0", "; 0; 0")));
  };
  const std::string scene =
    steps_of(.01) + budget +
    section("Solid numerics", "set Element degree = " + plane_or_space<dim>("2", "1")) +
    section("Bodies", ball("fast", -.2, 1) + ball("target", .1, 0));
  CoupledRun<dim> run(scene + section("Effects", section("contact", "") + sleep(1e-3, .03)));
  CoupledRun<dim> awake(scene + section("Effects", section("contact", "")));
  const double    momentum = awake.column("solid momentum x");
  for (unsigned int n = 0; n < 35; ++n)
    {
      run.step();
      awake.step();
      if (n == 6)
        CHECK(run.column("asleep target") == 1);
      if (run.column("nodes in contact") > 0)
        CHECK(run.column("energy closure") < 1e-9);
      CHECK(run.column("solid momentum x") == Approx(momentum).epsilon(1e-3));
    }
  CHECK(run.column("asleep target") == 0);
  CHECK(run.column("nodes in contact") == 0);
  CHECK(awake.column("max speed target") > .5);
  CHECK(run.column("centre of mass target x") ==
        Approx(awake.column("centre of mass target x")).epsilon(1e-3));
}


TEST_CASE("a body that sleeps wakes where a run goes on with another load, and else sleeps on",
          "[sleep][mpi]")
{
  const auto bar = [](const std::string &load) {
    return steps_of(.02) +
           section("Bodies",
                   body("bar",
                        "set Upper corner = 1, .2\nset Cells = 4, 1\nset Density = 1000\n"
                        "set Young's modulus = 1e6\nset Poisson's ratio = .3\nset Load = 0; " +
                          load + "\n" + section("Boundaries", boundary("wall", "left", "clamp")))) +
           section("Effects", sleep(1e-3, .1) + section("damping", "set Mass coefficient = 20"));
  };
  CoupledRun<2> run(bar("-1e3"));
  for (unsigned int n = 0; n < 200 && n_asleep(run) == 0; ++n)
    run.step();
  REQUIRE(n_asleep(run) == 1);
  run.step();
  const double way = run.column("centre of mass bar y");
  for (const std::string load : {"-1e3", "-2e3", "1e3"})
    {
      INFO(load);
      CoupledRun<2> resumed(bar(load));
      resumed.state = run.state;
      for (unsigned int n = 0; n < 20; ++n)
        resumed.step();
      CHECK(n_asleep(resumed) == (load == "-1e3" ? 1 : 0));
      CHECK((std::abs(resumed.column("centre of mass bar y") - way) > 1e-3) == (load != "-1e3"));
    }
}


TEST_CASE("what is awake flies on after contact as if nobody slept", "[sleep][mpi]")
{
  const auto ball = [](const std::string &name, const std::string &centre, const double velocity) {
    return body(name,
                fmt::format("set Shape = ball\nset Radius = .1\nset Centre = {}\n"
                            "set Initial velocity = {}; 0\nset Density = 1000\n"
                            "set Young's modulus = 2e4\nset Poisson's ratio = .3\n"
                            "set Refinements = 1\n",
                            centre,
                            velocity));
  };
  const std::string scene =
    section("Time",
            "set Step = .01\nset Integrator = generalised_alpha\n"
            "set Spectral radius = 0") +
    section("Bodies",
            ball("fast", "-.2, 0", 1) + ball("target", ".1, 0", 0) + ball("asleep", "0, 2", 0));
  CoupledRun<2> run(scene + section("Effects", section("contact", "") + sleep(1e-3, .03)));
  CoupledRun<2> awake(scene + section("Effects", section("contact", "")));
  for (unsigned int n = 0; n < 50; ++n)
    {
      run.step();
      awake.step();
    }
  CHECK(run.column("asleep asleep") == 1);
  CHECK(awake.column("max speed target") > .5);
  for (const std::string name : {"fast", "target"})
    CHECK(run.column("centre of mass " + name + " x") ==
          Approx(awake.column("centre of mass " + name + " x")).epsilon(1e-3));
}


TEST_CASE("contact wakes a body", "[sleep][mpi]")
{
  check_waking_by_contact<2>();
}


TEST_CASE("contact wakes a body in space", "[sleep]")
{
  check_waking_by_contact<3>();
}


TEST_CASE("a load that changes in time keeps its body awake", "[sleep]")
{
  const auto push =
    section("push", "set Kind = traction\nset Sides = right\nset Traction = t < 1 ? 0 : 1e3; 0");
  CoupledRun<2> run(steps_of(.05) +
                    section("Bodies", post<2>("a", .1, 0) + post<2>("b", .3, 0, push)) +
                    section("Effects", sleep()));
  for (unsigned int n = 0; n < 30; ++n)
    run.step();
  CHECK(run.column("asleep a") == 1);
  CHECK(run.column("asleep b") == 0);
  CHECK(run.column("max speed b") > 0.01);
}


TEST_CASE("a body on its support sleeps, and the support holds it", "[sleep][mpi]")
{
  const auto down = section("gravity", "set Acceleration = 0, -10");
  const auto drag = section("damping", "set Mass coefficient = 30");
  // The post swings several times in a step at first, which the monitor takes for energy from
  // nowhere; here it is of no interest.
  const auto    unwatched = section("Time", "set Energy monitor = off");
  CoupledRun<2> run(steps_of(.05) + unwatched + section("Bodies", post<2>("a", .1, 0)) +
                    section("Effects", down + drag + sleep(1e-3)));
  for (unsigned int n = 0; n < 60; ++n)
    run.step();
  CHECK(run.column("asleep a") == 1);
  CHECK(run.column("reaction a/foot y") == Approx(1000 * .05 * 10).epsilon(1e-3));
}


TEST_CASE("steps by a tolerance sleep too", "[sleep][mpi]")
{
  const auto    steps = section("Time", "set Step = .05\nset Tolerance = .1");
  CoupledRun<2> run(steps + four_posts<2>() + section("Effects", sleep()));
  for (unsigned int n = 0; n < 1000 && run.state.clock.time < 1; ++n)
    run.step();
  CHECK(n_asleep(run) == 3);
  CHECK(run.column("asleep a") == 0);
}


TEST_CASE("bodies at a region that they close wake where nothing else gives way", "[sleep][mpi]")
{
  // Fluid enters, and nothing but the wall on the right can move.
  const auto domain =
    section("Domain", "set Cells = 12, 12") +
    section("Fluid",
            "set Density = 1\n" +
              section("Boundaries",
                      boundary("in", "left", "inflow", "set Velocity = 1e-2 * max(0, t - 1); 0") +
                        boundary("out", "right", "outflow")));
  const auto wall =
    body("wall",
         "set Lower corner = .7, -.1\nset Upper corner = .8, 1.1\nset Cells = 1, 8\n"
         "set Density = 100\nset Young's modulus = 1e4\nset Poisson's ratio = .3",
         clamp("ends", "abs(y - .5) - .55"));
  CoupledRun<2> run(steps_of(.05) + domain + section("Bodies", wall) +
                    section("Effects", sleep(1e-3)));
  for (unsigned int n = 0; n < 18; ++n)
    run.step();
  CHECK(run.column("asleep wall") == 1);
  for (unsigned int n = 0; n < 6; ++n)
    run.step();
  CHECK(run.column("asleep wall") == 0);
  CHECK(run.column("max speed wall") > 0);
}
