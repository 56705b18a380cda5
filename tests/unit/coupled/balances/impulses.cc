// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/solid/time/time_integrator.h>

#include <coupled/coupled_run.h>

#include <array>

using namespace undine_tests;

namespace
{
  const std::string steps   = steps_of(1. / 40);
  const std::string outputs = section("Output", "set Budget = true\nset Impulses = true");


  template <int dim>
  std::string
  around()
  {
    return boundary("around", every_side<dim>(), "periodic");
  }


  /// A ball that is moved, and besides what `bodies` says, in a viscous fluid in a box that repeats
  /// itself: surfaces alone exchange momentum with it.
  template <int dim>
  std::string
  box(const std::string &form,
      const std::string &bodies,
      const std::string &boundaries = around<dim>())
  {
    return section("Domain", plane_or_space<dim>("set Cells = 16, 16", "set Cells = 10, 10, 10")) +
           section("Fluid",
                   "set Density = 1\nset Initial velocity = " +
                     plane_or_space<dim>("sin(2*pi*y); .3", "sin(2*pi*y); .3; .1") + "\n" +
                     section("Pressure solver", "set Divergence tolerance = 1e-13") +
                     section("Boundaries", boundaries)) +
           section("Obstacles",
                   obstacle("ball",
                            "ball",
                            plane_or_space<dim>(
                              "set Centre = .703, .511\nset Radius = .15\nset Refinements = 3\n"
                              "set Displacement = .05*(1-cos(6*t)); 0",
                              "set Centre = .703, .511, .497\nset Radius = .2\n"
                              "set Refinements = 2\nset Displacement = .05*(1-cos(6*t)); 0; 0"))) +
           (bodies.empty() ? ""
                           : section("Bodies", bodies) +
                               section("Solid numerics", "set Newton tolerance = 1e-12")) +
           section("Effects", form + section("viscosity", "set Dynamic viscosity = .02"));
  }


  template <int dim>
  std::string
  block(const std::string &name = "block", const std::string &left = ".2", const double density = 2)
  {
    return body(name,
                plane_or_space<dim>("set Lower corner = " + left +
                                      ", .41\nset Upper corner = .4, .63\nset Cells = 2, 2",
                                    "set Lower corner = " + left +
                                      ", .41, .42\nset Upper corner = .4, .63, .63\n"
                                      "set Cells = 1, 1, 1") +
                  fmt::format("\nset Density = {}\nset Young's modulus = 1e4\nset Poisson's "
                              "ratio = .3",
                              density));
  }


  /// What surfaces have given, and what fluid and bodies have got, each from its own source.
  template <int dim>
  struct Account
  {
    explicit Account(const std::string &scene)
      : run(scene)
      , start_of_fluid(linear_momentum(*run.models.fluid, run.state.fluid.velocity))
    {
      if (run.models.solid)
        start_of_bodies = vector("solid momentum");
    }

    dealii::Tensor<1, dim>
    vector(const std::string &name) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] = run.column(name + " " + "xyz"[axis]);
      return result;
    }

    dealii::Tensor<1, dim>
    impulse(const std::string &name) const
    {
      return vector("pressure impulse " + name) + vector("viscous impulse " + name);
    }

    void
    step()
    {
      run.step();
      transported += vector("momentum by transport");
      diffused += vector("momentum by diffusion");
      through_sides += vector("momentum by sides") + vector("momentum by openings");
      if (run.models.solid)
        by_integrator += vector("momentum by integrator");
    }

    dealii::Tensor<1, dim>
    gain_of_fluid() const
    {
      return linear_momentum(*run.models.fluid, run.state.fluid.velocity) - start_of_fluid;
    }

    dealii::Tensor<1, dim>
    impulses(const std::string &kind) const
    {
      dealii::Tensor<1, dim> sum;
      for (const auto &name : run.models.surface->surface().body_names())
        sum += vector(kind + " impulse " + name);
      return sum;
    }

    /// What the fluid has got without being given it, or the other way round [N s]. @{
    double
    missing() const
    {
      return (gain_of_fluid() + impulses("pressure") + impulses("viscous")).norm();
    }

    double
    missing_of_pressure() const
    {
      return (gain_of_fluid() - transported - diffused - through_sides + impulses("pressure"))
        .norm();
    }

    double
    missing_of_friction() const
    {
      return (diffused + impulses("viscous")).norm();
    }
    /// @}

    /// The same of the only body.
    double
    missing_in_body(const std::string &name) const
    {
      return (start_of_bodies + by_integrator + impulse(name) - vector("solid momentum")).norm();
    }

    CoupledRun<dim>              run;
    const dealii::Tensor<1, dim> start_of_fluid;
    dealii::Tensor<1, dim> start_of_bodies, transported, diffused, through_sides, by_integrator;
  };


  /// Fluxes carry momentum in the implicit step of friction, and lose little of it where surfaces
  /// move. Along paths what is lost is the transport's.
  template <int dim>
  void
  check_fluid(const Account<dim> &account, const std::string &name, const std::string &form)
  {
    const double size = account.impulse(name).norm();
    CHECK(size > 1e-3);
    CHECK(account.missing_of_pressure() < 1e-8 * size);
    if (form == flux_form())
      CHECK(account.missing() < 4e-3 * size);
    else
      CHECK(account.missing_of_friction() < 1e-8 * size);
  }


  template <int dim>
  void
  check_obstacle(const std::string &more, const std::string &form)
  {
    Account<dim> account(steps + outputs + box<dim>(form, "") + more);
    for (unsigned int n = 0; n < 5; ++n)
      account.step();
    check_fluid(account, "ball", form);
  }


  template <int dim>
  void
  check_body(const std::string &more, const std::string &form, const double density = 2)
  {
    Account<dim> account(steps + outputs + box<dim>(form, block<dim>("block", ".2", density)) +
                         more);
    for (unsigned int n = 0; n < 5; ++n)
      account.step();
    check_fluid(account, "block", form);
    CHECK(account.missing_in_body("block") < 1e-8 * account.impulse("block").norm());
  }


  /// Refuses long steps.
  template <int dim>
  class Impatient : public Effect<dim>
  {
  public:
    explicit Impatient(const double longest)
      : longest(longest)
    {
    }

    void
    add_options(const Options &) override
    {
    }

    std::string
    summary() const override
    {
      return "";
    }

    /// After the first stage, if there are several.
    void
    accelerate(FluidStage<dim> &fluid) const override
    {
      if (fluid.stage.is_last && fluid.dt > longest)
        throw SolveError("the step is too long");
    }

  private:
    double longest;
  };
} // namespace


TEST_CASE("The fluid loses the impulses of its forces on an obstacle, with every integrator",
          "[coupled][mpi]")
{
  for (const auto &name : Registry<TimeIntegrator>::instance().names())
    if (name != "static")
      {
        INFO(name);
        const auto integrator = section("Time", "set Integrator = " + name);
        check_obstacle<2>(integrator, flux_form());
        check_obstacle<2>(integrator, convection());
      }
  check_obstacle<3>("", flux_form());
}


TEST_CASE("The fluid loses the impulses of its forces on bodies, which get them", "[coupled][mpi]")
{
  for (const auto &name : Registry<TimeIntegrator>::instance().names())
    if (name != "static")
      {
        INFO(name);
        const auto integrator = section("Time", "set Integrator = " + name);
        // That one averages forces, and leaves .7 % of the impulses on light bodies to later steps.
        const double density = name == "generalised_alpha" ? 20 : 2;
        check_body<2>(integrator, flux_form(), density);
        check_body<2>(integrator, convection(), density);
      }
  check_body<3>("", flux_form());
}


TEST_CASE("The fluid loses the impulses of its forces where it is solved for in turn with bodies",
          "[coupled][mpi]")
{
  Account<2> account("set Scheme = time_splitting\n" + steps + outputs +
                     box<2>(convection(), block<2>(), boundary("top", "top", "outflow")));
  for (unsigned int n = 0; n < 5; ++n)
    account.step();
  CHECK(account.missing_of_pressure() < 1e-8 * account.impulse("block").norm());
}


TEST_CASE("Stages that are solved again give their impulses once", "[coupled]")
{
  Account<2> account(steps + outputs + box<2>(flux_form(), block<2>()) +
                     section("Coupling", "set Friction tolerance = 0"));
  for (unsigned int n = 0; n < 3; ++n)
    {
      account.step();
      CHECK(account.run.column("Stages solved again") > 0);
    }
  check_fluid(account, "block", flux_form());
}


TEST_CASE("Steps that are cut give the impulses of those that take their place", "[coupled]")
{
  const auto    scene = section("Output", "set Impulses = true") + box<2>(flux_form(), "");
  CoupledRun<2> cut(steps + scene), shorter(steps_of(1. / 80) + scene);
  shorter.state = cut.state; // the length of the first step is in it
  cut.models.effects.push_back(std::make_unique<Impatient<2>>(.3 / 80));
  while (cut.state.clock.time < .1 - 1e-9)
    cut.step();
  while (shorter.state.clock.time < .1 - 1e-9)
    shorter.step();
  CHECK(cut.state.clock.step == shorter.state.clock.step);
  for (const auto &name : {"pressure impulse ball x", "viscous impulse ball x"})
    CHECK(cut.column(name) == Approx(shorter.column(name)).epsilon(1e-9));
}


TEST_CASE("Impulses of contact between bodies are no rates that stages go on with", "[coupled]")
{
  Account<2> account(
    steps + outputs +
    box<2>(flux_form(),
           block<2>("fast", ".2") +
             body("slow",
                  "set Lower corner = .415, .4\nset Upper corner = .5, .61\n"
                  "set Cells = 1, 2\nset Density = 200\nset Young's modulus = 1e4\n"
                  "set Poisson's ratio = .3\nset Initial velocity = -1; 0")) +
    section("Effects", section("contact", "")));
  unsigned int n_touched = 0; // steps since the first touch
  for (unsigned int n = 0; n < 30 && n_touched < 4; ++n)
    {
      account.step();
      if (n_touched > 0 || account.run.column("nodes in contact") > 0)
        ++n_touched;
    }
  CHECK(n_touched == 4);
  CHECK(account.missing_of_pressure() < 1e-8 * account.impulse("slow").norm());
}


TEST_CASE("There are no columns of impulses unless they are asked for", "[coupled]")
{
  CoupledRun<2> run(steps + box<2>(flux_form(), ""));
  run.step();
  CHECK(!run.state.impulses);
  for (const auto &column : run.report.columns)
    CHECK(column.name.find("impulse") == std::string::npos);
}
