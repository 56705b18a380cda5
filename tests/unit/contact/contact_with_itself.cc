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
    const Vector     place = closed_to(scene, .2, .02, .002), change = scene.field(1, 1);
    const auto       at = [&](const double path) {
      Vector result = place;
      result.add(path, change);
      return result;
    };
    const double step   = 1e-6;
    const Vector forces = scene.contact.forces(place, 0);
    REQUIRE(forces.size() > 0);
    REQUIRE(scene.contact.energy(place, 0) > 1e-4);
    CHECK((scene.contact.energy(at(step), 0) - scene.contact.energy(at(-step), 0)) / (2 * step) ==
          Approx(-(forces * change)).epsilon(1e-6));

    auto matrix = scene.model.matrix();
    scene.contact.add_stiffness(matrix, 2, place, 0);
    Vector by_matrix = scene.model.vector();
    matrix.vmult(by_matrix, change);
    Vector by_difference = scene.contact.forces(at(step), 0);
    by_difference.add(-1., scene.contact.forces(at(-step), 0));
    by_difference *= -2 / (2 * step);
    by_difference.add(-1., by_matrix);
    CHECK(by_difference.l2_norm() < 1e-6 * by_matrix.l2_norm());
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
