// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_potential.h>
#include <undine/surface/nearest_of_edges.h>

#include <contact/contact_scene.h>

using namespace undine_tests;

namespace
{
  using Point = dealii::Point<3>;


  /// Two cubes, the upper one with an edge along x at the least, the lower one with an edge along y
  /// at the top; `gap` between them, nodes are far.
  std::string
  cubes_on_edges(const double gap)
  {
    const std::string keys = "\nset Density = 1\nset Young's modulus = 1\nset Poisson's ratio = "
                             "0\nset Cells = 2, 2, 2\nset Lower corner = -1, -1, -1\nset Upper "
                             "corner = 1, 1, 1\n";
    return "subsection Bodies\nsubsection low" + keys +
           "set Map = (x - z) / 2^.5; y; (x + z) / 2^.5\nend\nsubsection high" + keys +
           fmt::format("set Map = x + .4; (y - z) / 2^.5 + .3; (y + z) / 2^.5 + {:.17g}\n",
                       2 * std::sqrt(2.) + gap) +
           "end\nend\nsubsection Solid numerics\nset Element degree = 1\nend\n";
  }
} // namespace


TEST_CASE("the points of two edges nearest to each other", "[contact]")
{
  // Inside both: the way between them is upright to both.
  const std::array<Point, 4> crossing{
    {Point(0, 0, 0), Point(2, 1, 0), Point(1, -1, .5), Point(.5, 3, 1)}};
  const auto nearest = nearest_of_edges<3>(crossing);
  CHECK(nearest.inside[0]);
  CHECK(nearest.inside[1]);
  CHECK(std::abs(nearest.from * (crossing[1] - crossing[0])) < 1e-14);
  CHECK(std::abs(nearest.from * (crossing[3] - crossing[2])) < 1e-14);
  CHECK(nearest.distance == Approx(nearest.from.norm()));

  // No point of a fine sample is nearer, wherever the second edge is.
  for (const double shift : {-5., -2., -.5, 0., 1., 4.})
    {
      auto x = crossing;
      x[2][0] += shift;
      x[3] += shift * (x[1] - x[0]);
      const double distance = nearest_of_edges<3>(x).distance;
      double       sampled  = 1e9;
      for (unsigned int i = 0; i <= 200; ++i)
        for (unsigned int j = 0; j <= 200; ++j)
          sampled = std::min(
            sampled, (x[0] + i / 200. * (x[1] - x[0]) - x[2] - j / 200. * (x[3] - x[2])).norm());
      CHECK(distance <= sampled * (1 + 1e-14));
      CHECK(distance > sampled - .02);
    }
  // Parallel ones.
  CHECK(nearest_of_edges<3>({{Point(0, 0, 0), Point(1, 0, 0), Point(.5, 0, .3), Point(3, 0, .3)}})
          .distance == Approx(.3));
}


TEST_CASE("edges of a box are sharp, those of a smooth ball ever less", "[contact]")
{
  const auto edges = [](const std::string &text) {
    const Scene<3> scene(text, .1);
    return ContactSurfaces<3>(scene.settings(.1, -10).walls, scene.model, nullptr).sharp_edges();
  };
  const auto of_boxes = edges(two_boxes<3>(.5, .3));
  CHECK(of_boxes.size() == 2 * 12 * 2);
  for (const auto &edge : of_boxes)
    {
      CHECK(edge.length == Approx(.5));
      CHECK(edge.area == Approx(2. / 3 * .0625));
    }
  // Their areas together, as a share of what they would be if all were sharp.
  const auto share = [&](const unsigned int refinements) {
    double sum = 0;
    for (const auto &edge :
         edges("subsection Bodies\nsubsection ball\nset Shape = ball\nset Density = 1\nset Young's "
               "modulus = 1\nset Poisson's ratio = 0\nset Refinements = " +
               std::to_string(refinements) + "\nend\nend\n"))
      sum += edge.area;
    return sum / (4 * M_PI);
  };
  CHECK(share(2) < .3);
  CHECK(share(3) < .27 * share(2));
}


TEST_CASE("blunt edges that cross do not pass each other", "[contact][mpi]")
{
  // Roofs of 20 degrees, one upside down over the other, across it; nodes are far.
  const std::string keys = "\nset Density = 1\nset Young's modulus = 1\nset Poisson's ratio = "
                           "0\nset Cells = 2, 2, 1\n";
  const double      gap  = .02;
  const Scene<3>    scene(
    "subsection Bodies\nsubsection low" + keys +
      "set Lower corner = -1, -1, -1\nset Upper corner = 1, 1, 0\nset Map = x; y; z - "
         ".17632698 * abs(x)\nend\nsubsection high" +
      keys + "set Lower corner = -1, -1, 0\nset Upper corner = 1, 1, 1\n" +
      fmt::format("set Map = x + .4; y + .3; z + .17632698 * abs(y) + {}\n", gap) +
      "end\nend\nsubsection Solid numerics\nset Element degree = 1\nend\n",
    .03);
  const Vector start = scene.model.vector();
  CHECK(scene.contact.energy(start, 0) > 0);
  for (const double length : {.03, 1., 30.})
    {
      Vector fall = start;
      for (const auto dof : scene.model.locally_owned())
        if (scene.model.axis(dof) == 2 && scene.model.rest_position(dof)[2] > 0)
          fall(dof) = -length;
      fall.compress(dealii::VectorOperation::insert);
      const double path = scene.contact.collision_free_fraction({start, 0.}, {fall, 0.}) * length;
      CHECK(path < .8 * gap * (1 + 1e-12));
      CHECK(path > .25 * gap);
    }
}


TEST_CASE("edges that cross push each other and do not pass", "[contact][mpi]")
{
  const double             gap = .04;
  const Scene<3>           scene(cubes_on_edges(gap), .1);
  const ContactSurfaces<3> surfaces(scene.settings(.1, -10).walls, scene.model, nullptr);
  const Vector             start  = scene.model.vector();
  const auto               places = surfaces.positions(start, 0);
  const auto terms = find_contact_terms(surfaces, ActivationDistances<3>(surfaces, .1), {}, places);
  const ContactPotential<3> potential(3);
  REQUIRE(terms.size() == 1);
  CHECK(terms[0].n == 4);
  CHECK(terms[0].distance == Approx(gap));
  CHECK(std::abs(terms[0].direction[2]) == Approx(1));
  CHECK(scene.contact.energy(start, 0) == Approx(potential.energy(terms[0], places)));
  CHECK(potential.energy(terms[0], places) > 0);

  // Down by the gap and further: to a fifth of it.
  for (const double length : {.1, 1., 30.})
    {
      Vector fall = start;
      for (const auto dof : scene.model.locally_owned())
        if (scene.model.axis(dof) == 2 && scene.model.rest_position(dof)[2] > std::sqrt(2.))
          fall(dof) = -length;
      fall.compress(dealii::VectorOperation::insert);
      const double path = scene.contact.collision_free_fraction({start, 0.}, {fall, 0.}) * length;
      CHECK(path < .8 * gap * (1 + 1e-12));
      CHECK(path > .79 * gap);
    }
}
