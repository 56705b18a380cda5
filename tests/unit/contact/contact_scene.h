// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_contact_contact_scene_h
#define undine_tests_contact_contact_scene_h

#include <undine/contact/body_contact.h>

#include <catch2/catch.hpp>
#include <solid/solid_scene.h>

#include <cmath>

namespace undine_tests
{
  /// Two boxes, the second to the right of the first and shifted aside, so that nodes do not meet.
  template <int dim>
  std::string
  two_boxes(const double gap, const double aside, const unsigned int degree = 1)
  {
    const std::string keys = "\nset Density = 1\nset Young's modulus = 1\nset Poisson's ratio = 0\n"
                             "set Cells = " +
                             plane_or_space<dim>("2, 2", "2, 2, 2") + "\n";
    const auto corners = [&](const double x, const double y) {
      return fmt::format(plane_or_space<dim>("set Lower corner = {0}, {1}\nset Upper corner = "
                                             "{2}, {3}",
                                             "set Lower corner = {0}, {1}, {1}\nset Upper corner "
                                             "= {2}, {3}, {3}"),
                         x,
                         y,
                         x + 1,
                         y + 1);
    };
    return "subsection Bodies\nsubsection one\n" + corners(0, 0) + keys +
           "end\nsubsection other\n" + corners(1 + gap, aside) + keys +
           fmt::format("end\nend\nsubsection Solid numerics\nset Element degree = {}\nend\n",
                       degree);
  }


  /// Contact of the bodies of a text with each other and with the plane x = wall.
  template <int dim>
  struct Scene
  {
    Scene(const std::string &text, const double activation_distance, const double wall = -10)
      : options(read_scene_text(text))
      , model(options, MPI_COMM_WORLD)
      , contact(settings(activation_distance, wall), model, nullptr, nullptr)
    {
    }

    ContactSettings<dim>
    settings(const double activation_distance, const double wall) const
    {
      ContactSettings<dim> result{options};
      result.activation_distance = activation_distance;
      result.stiffness           = 3;
      result.walls.push_back({"wall",
                              wall * dealii::Point<dim>::unit_vector(0),
                              dealii::Tensor<1, dim>(dealii::Point<dim>::unit_vector(0))});
      return result;
    }

    /// The same function of place for any distribution.
    Vector
    field(const double size, const double phase) const
    {
      Vector result = model.vector();
      for (const auto dof : model.locally_owned())
        {
          const auto &x = model.rest_position(dof);
          result(dof)   = size * std::sin(3 * x[0] + 5 * x[dim - 1] + 7 * model.axis(dof) + phase);
        }
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    /// A way of the second body, the first one stands still.
    Vector
    shift(const dealii::Tensor<1, dim> &path) const
    {
      Vector result = model.vector();
      for (const auto dof : model.locally_owned())
        result(dof) = model.rest_position(dof)[0] > 1 ? path[model.axis(dof)] : 0;
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    const Options          options;
    const SolidModel<dim>  model;
    const BodyContact<dim> contact;
  };


  /// At the displacement `place` forces are the derivative of the energy along `change`, to
  /// `tolerance`, and the stiffness is that of the forces.
  template <int dim>
  void
  check_derivatives_along(const Scene<dim> &scene,
                          const Vector     &place,
                          const Vector     &change,
                          const double      tolerance)
  {
    const auto at = [&](const double path) {
      Vector result = place;
      result.add(path, change);
      return result;
    };
    const double step   = 3e-7;
    const Vector forces = scene.contact.forces(place, 0);
    REQUIRE(forces.size() > 0);
    CHECK((scene.contact.energy(at(step), 0) - scene.contact.energy(at(-step), 0)) / (2 * step) ==
          Approx(-(forces * change)).epsilon(tolerance));

    auto matrix = scene.model.matrix();
    scene.contact.add_stiffness(matrix, 2, place, 0, Tangent::exact);
    Vector by_matrix = scene.model.vector();
    matrix.vmult(by_matrix, change);
    Vector by_difference = scene.contact.forces(at(step), 0);
    by_difference.add(-1., scene.contact.forces(at(-step), 0));
    by_difference *= -2 / (2 * step);
    by_difference.add(-1., by_matrix);
    CHECK(by_difference.l2_norm() < 1e-6 * by_matrix.l2_norm());
  }
} // namespace undine_tests

#endif
