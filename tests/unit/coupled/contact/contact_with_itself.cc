// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/contact/contact_course.h>

#include <undine/contact/make_contact.h>

#include <message_of.h>

using namespace undine_tests;

namespace
{
  const std::string only_contact = section("Effects", section("contact", ""));
  /// A flat sheet whose halves fly up and fold it.
  template <int dim>
  std::string
  folding_sheet(const std::string &effects)
  {
    return elements<dim>() + budget +
           section(
             "Bodies",
             body("sheet",
                  plane_or_space<dim>("set Lower corner = -.5, 0\nset Upper corner = .5, .05\n"
                                      "set Cells = 12, 1\nset Initial velocity = 0; 10*abs(x)",
                                      "set Lower corner = -.5, 0, 0\nset Upper corner = .5, "
                                      ".05, .2\nset Cells = 8, 1, 2\nset Initial velocity = 0; "
                                      "10*abs(x); 0") +
                    "\nset Density = 1000\nset Young's modulus = 1e4\nset Poisson's ratio = "
                    ".3\n")) +
           effects;
  }


  /// A ring with a slit at the right, whose ends fly towards each other; its middle is at
  /// (aside, aside).
  template <int dim>
  std::string
  closing_ring(const double aside)
  {
    const std::string radius = "(.2 - .06 * y)", angle = "(6.08 * x + .1)";
    return section(
      "Bodies",
      body(
        "ring",
        plane_or_space<dim>("set Lower corner = 0, 0\nset Upper corner = 1, 1\nset Cells = 16, 1",
                            "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, .1\nset Cells "
                            "= 10, 1, 1") +
          fmt::format("\nset Map = {0} * cos{1} + {2}; {0} * sin{1} + {2}", radius, angle, aside) +
          plane_or_space<dim>("", fmt::format("; z + {}", aside)) +
          fmt::format("\nset Density = 1000\nset Young's modulus = 3e3\nset Poisson's ratio = "
                      ".3\nset Initial velocity = 0; if(x>{0}, if(y>{0}, -1, 1), 0)",
                      aside) +
          plane_or_space<dim>("", "; 0") + "\n"));
  }


  /// Whether the body passes through itself now, found by its edges that cross facets.
  template <int dim>
  std::string
  passage(const CoupledRun<dim> &run)
  {
    const ContactSettings<dim> settings{run.options};
    const auto contact = make_contact<dim>(settings, *run.models.solid, nullptr, nullptr);
    return message_of([&] { contact->check_start(run.state.solid.displacement, 0); });
  }


  template <int dim>
  void
  check_fold(const double dt, const double end)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(steps_of(dt) + folding_sheet<dim>(only_contact));
    const auto      course = observe(run, std::lround(end / dt));
    CHECK(course.most_contacts > 0);
    CHECK(course.least_gap > 0);
    CHECK(course.largest_energy <= course.start * (1 + 1e-9));
    CHECK(course.energy_closure < 1e-9);
    CHECK(passage(run) == "no error");
    for (unsigned int axis = 0; axis < dim; ++axis)
      CHECK(std::abs(run.column(std::string("contact force sheet ") + "xyz"[axis])) < 1e-8);
  }
} // namespace


TEST_CASE("a sheet that folds does not pass through itself and gains no energy", "[contact]")
{
  check_fold<2>(.04, .48);
  check_fold<2>(.02, .48);
  check_fold<2>(.01, .48);
  check_fold<3>(.04, .48);
}


TEST_CASE("without contact that sheet passes through itself", "[contact]")
{
  using Catch::Contains;
  CoupledRun<2> run(steps_of(.02) + folding_sheet<2>(""));
  std::string   message = "no error";
  for (unsigned int n = 0; n < 30 && message == "no error"; ++n)
    {
      run.step();
      message = passage(run);
    }
  CHECK_THAT(message, Contains("'sheet' passes through itself"));
}


TEST_CASE("the ends of a ring that meet do not pass each other in space", "[contact]")
{
  for (const double dt : {.005, .01, .02})
    {
      INFO("steps of " << dt);
      CoupledRun<3> run(steps_of(dt) + elements<3>() + budget + closing_ring<3>(0) + only_contact);
      const auto    course = observe(run, std::lround(.06 / dt));
      CHECK(course.most_contacts > 0);
      CHECK(course.least_gap > 0);
      CHECK(course.largest_energy <= course.start * (1 + 1e-9));
      CHECK(passage(run) == "no error");
    }
}


TEST_CASE("the ends of a ring that meet do not pass each other in a fluid", "[contact]")
{
  for (const double aside : {0., .0137})
    {
      INFO("moved by " << aside);
      CoupledRun<2> run(
        steps_of(.01) + budget + closing_ring<2>(aside) +
        section("Effects", section("contact", "") + convection()) +
        section("Domain",
                "set Lower corner = -.4, -.4\nset Upper corner = .4, .4\nset Cells = 20, 20") +
        section("Fluid",
                "set Density = 100\n" +
                  section("Boundaries", section("top", "set Sides = top\nset Kind = outflow"))));
      const auto   in_all        = [&] { return energy(run) + run.column("Fluid kinetic energy"); };
      const double start         = in_all();
      double       most_contacts = 0;
      for (unsigned int n = 0; n < 8; ++n)
        {
          run.step();
          most_contacts = std::max(most_contacts, run.column("nodes in contact"));
          CHECK(run.column("least gap") > 0);
          CHECK(in_all() <= start * (1 + 1e-9));
        }
      CHECK(most_contacts > 0);
      CHECK(passage(run) == "no error");
    }
}
