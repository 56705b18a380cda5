// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_contact_course_h
#define undine_tests_contact_course_h

#include <coupled/coupled_run.h>

#include <undine/solid/step/solid_columns.h>

#include <algorithm>
#include <string>

namespace undine_tests
{
  /// A ball of radius .1 at `centre`, waves in which go at about 5 m/s.
  template <int dim>
  std::string
  ball(const std::string &name,
       const std::string &centre,
       const std::string &velocity,
       const double       modulus     = 2e4,
       const unsigned int refinements = 1)
  {
    return body(
      name,
      "set Shape = ball\nset Radius = .1\nset Centre = " + centre +
        "\nset Initial velocity = " + velocity +
        fmt::format("\nset Density = 1000\nset Young's modulus = {}\nset Poisson's ratio = "
                    ".3\nset Refinements = {}\n",
                    modulus,
                    refinements));
  }


  /// Quadratic elements in 2D, linear ones in 3D, which are cheaper.
  template <int dim>
  std::string
  elements()
  {
    return section("Solid numerics", "set Element degree = " + plane_or_space<dim>("2", "1"));
  }


  template <int dim>
  std::string
  floor_at_zero(const std::string &more = "")
  {
    return section(
      "Effects",
      section("contact",
              section("Walls",
                      section("floor",
                              plane_or_space<dim>("set Point = 0, 0\nset Normal = 0, 2",
                                                  "set Point = 0, 0, 0\nset Normal = 0, 2, 0")))) +
        more);
  }


  template <int dim>
  double
  energy(const CoupledRun<dim> &run)
  {
    return run.column("solid kinetic energy") + run.column("solid elastic energy") +
           run.column("contact energy") + run.column("solid load potential");
  }


  /// What a run did.
  struct Course
  {
    double       start          = 0;
    double       largest_energy = 0;
    double       last_energy    = 0;
    double       least_gap      = 1;
    unsigned int most_contacts  = 0;

    /// Of the budget, while there is contact. Between bodies its momentum sums up to nothing, so
    /// that there is nothing to compare with. @{
    double energy_closure   = 0;
    double momentum_closure = 0;
    /// @}
  };


  template <int dim>
  Course
  observe(CoupledRun<dim> &run, const unsigned int n_steps)
  {
    Course course;
    course.start = course.largest_energy = energy(run);
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        run.step();
        course.last_energy    = energy(run);
        course.largest_energy = std::max(course.largest_energy, course.last_energy);
        course.least_gap      = std::min(course.least_gap, run.column("least gap"));
        course.most_contacts =
          std::max(course.most_contacts, unsigned(run.column("nodes in contact")));
        if (run.column("nodes in contact") > 0)
          {
            course.energy_closure = std::max(course.energy_closure, run.column("energy closure"));
            course.momentum_closure =
              std::max(course.momentum_closure, run.column("momentum closure"));
          }
      }
    return course;
  }


  /// Two balls that hit each other off their centres.
  template <int dim>
  void
  check_collision(const double dt, const unsigned int n_steps, const unsigned int refinements = 1)
  {
    INFO(dim << "D, steps of " << dt);
    CoupledRun<dim> run(steps_of(dt) + elements<dim>() + section("Output", "set Budget = true") +
                        section("Bodies",
                                ball<dim>("fast",
                                          plane_or_space<dim>("-.15, 0", "-.15, 0, 0"),
                                          plane_or_space<dim>("1; 0", "1; 0; 0"),
                                          2e4,
                                          refinements) +
                                  ball<dim>("slow",
                                            plane_or_space<dim>(".1, .05", ".1, .05, .03"),
                                            plane_or_space<dim>("-.2; 0", "-.2; 0; 0"),
                                            4e4,
                                            refinements)) +
                        section("Effects", section("contact", "")));
    dealii::Tensor<1, dim> before;
    for (unsigned int axis = 0; axis < dim; ++axis)
      before[axis] = run.column(std::string("solid momentum ") + "xyz"[axis]);
    const auto course = observe(run, n_steps);
    CHECK(course.most_contacts > 0);
    CHECK(course.least_gap > 0);
    CHECK(course.largest_energy <= course.start * (1 + 1e-9));
    for (unsigned int axis = 0; axis < dim; ++axis)
      CHECK(std::abs(run.column(std::string("solid momentum ") + "xyz"[axis]) - before[axis]) <
            1e-10 * before.norm());
    CHECK(course.energy_closure < 1e-9);
    // They part: the centres go away from each other.
    CHECK(run.column("centre of mass slow x") - run.column("centre of mass fast x") > .19);
    CHECK(run.column("nodes in contact") == 0);
  }
} // namespace undine_tests

#endif
