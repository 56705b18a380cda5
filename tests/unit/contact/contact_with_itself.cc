// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/contact_scene.h>
#include <message_of.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// A strip bent to a ring about the origin, whose ends are two faces with an angle of `slit`
  /// between them at rest, of inner radius 1 and outer radius 1 + thickness.
  template <int dim>
  std::string
  slit_ring(const double slit, const double thickness, const unsigned int degree = 1)
  {
    const std::string radius = fmt::format("(1 + {:.17g} * (1 - y))", thickness);
    const std::string angle  = fmt::format("({:.17g} * x + {:.17g})", 2 * M_PI - slit, slit / 2);
    return "subsection Bodies\nsubsection ring\nset Density = 1\nset Young's modulus = 1\nset "
           "Poisson's ratio = 0\n" +
           plane_or_space<dim>(
             "set Lower corner = 0, 0\nset Upper corner = 1, 1\nset Cells = 12, 2",
             "set Lower corner = 0, 0, 0\nset Upper corner = 1, 1, 0.6\nset "
             "Cells = 12, 2, 2") +
           fmt::format("\nset Map = {0} * cos{1}; {0} * sin{1}", radius, angle) +
           plane_or_space<dim>("", "; z") +
           fmt::format("\nend\nend\nsubsection Solid numerics\nset Element degree = {}\nend\n",
                       degree);
  }


  /// The displacement that turns each cross-section about the origin, so that the slit's angle
  /// becomes `slit`, plus a small one that varies.
  template <int dim>
  Vector
  closed_to(const Scene<dim> &scene,
            const double      slit_at_rest,
            const double      slit,
            const double      size)
  {
    Vector result = scene.field(size, 0);
    for (const auto dof : scene.model.locally_owned())
      {
        const auto                 &x     = scene.model.rest_position(dof);
        const double                angle = std::atan2(-x[1], -x[0]); // from the middle of the ring
        const double                turned = angle * (2 * M_PI - slit) / (2 * M_PI - slit_at_rest);
        const double                radius = std::hypot(x[0], x[1]);
        const std::array<double, 2> place{{-radius * std::cos(turned), -radius * std::sin(turned)}};
        if (const unsigned int axis = scene.model.axis(dof); axis < 2)
          result(dof) += place.at(axis) - x[axis];
      }
    result.compress(dealii::VectorOperation::add);
    return result;
  }


  template <int dim>
  void
  check_derivatives(const unsigned int degree)
  {
    INFO(dim << "D, degree " << degree);
    const Scene<dim> scene(slit_ring<dim>(.2, .3, degree), .1);
    const Vector     place = closed_to(scene, .2, .06, .004), change = scene.field(1, 1);
    REQUIRE(scene.contact.energy(place, 0) > 1e-4);
    check_derivatives_along(scene, place, change, 1e-6);
  }

  /// A thin sheet becomes thinner by `factor`: its two faces come nearer than the activation
  /// distance.
  template <int dim>
  void
  check_thin_sheet(const double thickness, const double factor)
  {
    INFO(dim << "D, " << thickness << " thick");
    const Scene<dim> scene(
      "subsection Bodies\nsubsection sheet\nset Density = 1\nset Young's modulus = 1\nset "
      "Poisson's ratio = 0\n" +
        plane_or_space<dim>(
          fmt::format("set Lower corner = 0, 0\nset Upper corner = 1, {}\nset Cells = 5, 1",
                      thickness),
          fmt::format(
            "set Lower corner = 0, 0, 0\nset Upper corner = 1, {}, 1\nset Cells = 5, 1, 5",
            thickness)) +
        "\nend\nend\nsubsection Solid numerics\nset Element degree = 1\nend\n",
      .02);
    const Vector start   = scene.model.vector();
    Vector       squeeze = start;
    for (const auto dof : scene.model.locally_owned())
      if (scene.model.axis(dof) == 1)
        squeeze(dof) = (factor - 1) * scene.model.rest_position(dof)[1];
    squeeze.compress(dealii::VectorOperation::insert);
    CHECK(scene.contact.forces(squeeze, 0).size() == 0);
    CHECK(scene.contact.collision_free_fraction({start, 0.}, {squeeze, 0.}) == 1);
  }


  /// Turning the ends of a slit ring towards each other, up to and beyond each other.
  template <int dim>
  void
  check_slit(const double slit, const double activation_distance)
  {
    INFO(dim << "D, slit of " << slit << ", D " << activation_distance);
    const Scene<dim> scene(slit_ring<dim>(slit, .3), activation_distance);
    const Vector     start = scene.model.vector();
    CHECK(scene.contact.forces(start, 0).size() == 0);
    for (const double closed : {.02 * slit, -.5 * slit, -2 * slit})
      {
        const Vector end  = closed_to(scene, slit, closed, 0);
        const double part = scene.contact.collision_free_fraction({start, 0.}, {end, 0.});
        CHECK(part < 1);
        CHECK(part > .1);
        Vector way = end;
        way *= part;
        CHECK(scene.contact.energy(way, 0) > 0);
      }
    // As a rigid body and faster than it is wide.
    Vector flight = start;
    flight.add(37.);
    CHECK(scene.contact.collision_free_fraction({start, 0.}, {flight, 0.}) == 1);
  }
} // namespace


TEST_CASE("contact of a body with itself is that of a potential", "[contact][mpi]")
{
  for (const unsigned int degree : {1, 2})
    {
      check_derivatives<2>(degree);
      check_derivatives<3>(degree);
    }
}


TEST_CASE("the faces of a thin sheet do not meet through it", "[contact]")
{
  for (const double thickness : {.01, .03, .09})
    {
      check_thin_sheet<2>(thickness, .15);
      check_thin_sheet<3>(thickness, .15);
    }
}


TEST_CASE("no way leads through the ends of a slit, however narrow it is", "[contact][mpi]")
{
  for (const double slit : {.2, .05, .005})
    {
      check_slit<2>(slit, .03);
      check_slit<3>(slit, .03);
    }
}


TEST_CASE("a body that touches itself or passes through itself at the start is refused",
          "[contact]")
{
  using Catch::Contains;
  const auto complaint = [](const double slit) {
    const Scene<2> scene(slit_ring<2>(slit, .3), .03);
    return message_of([&] { scene.contact.check_start(scene.model.vector(), 0); });
  };
  CHECK(complaint(.01) == "no error");
  CHECK_THAT(complaint(0), Contains("'ring' touches itself") && Contains("Try: leave a gap"));
  CHECK_THAT(complaint(-.2), Contains("'ring' passes through itself"));
}


TEST_CASE(
  "turned boxes, whose faces lie in a plane to rounding only, do not pass through themselves",
  "[contact]")
{
  // Found among random boxes: of most that are turned edges in a face are parallel to it, or miss
  // its other facets, in spite of rounding.
  const auto complaint = [](const std::string &box) {
    const Scene<3> scene(
      "subsection Bodies\nsubsection box\nset Density = 1\nset Young's modulus = "
      "1\nset Poisson's ratio = 0\n" +
        box + "\nend\nend\n",
      .03);
    return message_of([&] { scene.contact.check_start(scene.model.vector(), 0); });
  };
  CHECK(
    complaint("set Lower corner = 0.6915407906360895, 0.15834836948126502, 0.17885465733282854\n"
              "set Upper corner = 0.8084592093639106, 0.34165163051873504, 0.32114534266717143\n"
              "set Cells = 2, 3, 1\nset Rotation = 16.074439225789938, -38.63455908181142, "
              "36.752439524694665") == "no error");
  CHECK(complaint("set Lower corner = 0.18443937773012575, 0.669445786679693, 0.1451505458260658\n"
                  "set Upper corner = 0.31556062226987425, 0.830554213320307, 0.3548494541739342\n"
                  "set Cells = 3, 3, 2\nset Rotation = -35.934833698371385, 11.56747091209067, "
                  "-30.112880420607713") == "no error");
  CHECK(complaint("set Lower corner = 0.6539958988124763, 0.6857125469514724, 0.6808402401098097\n"
                  "set Upper corner = 0.8460041011875237, 0.8142874530485276, 0.8191597598901903\n"
                  "set Cells = 2, 1, 3\nset Rotation = -22.313378533096593, -17.284253300913406, "
                  "11.728120736762541") == "no error");
}


TEST_CASE("a body that ends on a wall keeps off it elsewhere", "[contact]")
{
  // The box's left face is held at the plane x = 0, and the box pressed against that.
  const auto terms_at_wall = [](const double wall, const double squeezed) {
    const Scene<2> scene(
      "subsection Bodies\nsubsection box\nset Density = 1\nset Young's modulus = 1\nset Poisson's "
      "ratio = 0\nset Lower corner = 0, 0\nset Upper corner = 1, 1\nset Cells = 4, 4\nsubsection "
      "Boundaries\nsubsection foot\nset Kind = clamp\nset Sides = left\nend\nend\nend\nend\n"
      "subsection Solid numerics\nset Element degree = 1\nend\n",
      .4);
    const ContactSurfaces<2> surfaces(scene.settings(.4, wall).walls, scene.model, nullptr);
    auto                     places = surfaces.rest();
    for (auto &place : places)
      place[0] *= squeezed;
    unsigned int found = 0;
    for (const auto &term :
         find_contact_terms(surfaces, ActivationDistances<2>(surfaces, .4), {}, places))
      if (term.wall != term.no_wall)
        {
          ++found;
          CHECK(term.distance > 0);
          CHECK(term.activation_distance <= .5 * surfaces.rest_gap(term.nodes[0], 0));
        }
    return found;
  };
  CHECK(terms_at_wall(0, 1) == 0);
  CHECK(terms_at_wall(0, .3) == 11);   // all but the held ones
  CHECK(terms_at_wall(.01, .3) == 11); // what is behind the wall is held
  CHECK(terms_at_wall(.26, .6) == 0);  // some of that may slide through it
}
