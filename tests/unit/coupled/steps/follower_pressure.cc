// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/follower_pressure.h>

#include <coupled/coupled_run.h>

#include <array>

using namespace undine_tests;

namespace
{
  constexpr const char *material =
    "\nset Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = .3";


  /// A ball and a box with quadratic sides in a tank, and pressures all around them.
  template <int dim>
  struct BallAndBox
  {
    using Vector  = typename SolidModel<dim>::Vector;
    using Vectors = typename FollowerPressure<dim>::Vectors;

    BallAndBox()
      : run(steps_of(.1) +
            section("Domain", "set Cells = " + plane_or_space<dim>("8, 8", "8, 8, 8")) +
            section("Fluid", "set Density = 1000") +
            section("Bodies",
                    body("ball",
                         "set Shape = ball\nset Radius = .15\nset Centre = " +
                           plane_or_space<dim>(".3, .3", ".3, .3, .3") + material) +
                      body("box",
                           "set Cells = " + plane_or_space<dim>("2, 1", "2, 1, 1") +
                             "\nset Lower corner = " + plane_or_space<dim>(".5, .6", ".5, .6, .4") +
                             "\nset Upper corner = " + plane_or_space<dim>(".8, .8", ".8, .8, .7") +
                             material)))
      , surface(*run.models.surface)
      , at_rest(surface.positions(run.state.solid, 0))
    {
      for (const auto &place : at_rest)
        pressures.push_back(is_of_ball(place) ? 3e4 : -7e3);
    }

    static bool
    is_of_ball(const dealii::Point<dim> &place)
    {
      return place[0] < .48;
    }

    /// Uniform pressures on the facets at `positions`.
    Vectors
    loads(const std::vector<dealii::Point<dim>> &positions) const
    {
      Vectors     result(positions.size());
      const auto &facets = surface.surface();
      for (unsigned int facet = 0; facet < facets.facets().size(); ++facet)
        for (const unsigned int node : facets.facets()[facet])
          result[node] -= pressures[node] / dim * area_vector(facets, facet, positions);
      return result;
    }

    FollowerPressure<dim>
    following() const
    {
      return {surface, at_rest, loads(at_rest)};
    }

    /// `move(place)` in all nodes of the finite elements.
    template <class Move>
    Vector
    displacement(const Move &move) const
    {
      const auto &solid  = *run.models.solid;
      auto        result = solid.vector();
      for (const auto dof : solid.locally_owned())
        result(dof) = move(solid.rest_position(dof))[solid.axis(dof)];
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    /// Something that neither is rigid nor small.
    Vector
    scattered(const double phase) const
    {
      return displacement([&](const auto &place) {
        dealii::Tensor<1, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = .05 * std::sin(phase + 7 * place[d] + 5 * place[(d + 1) % dim]);
        return result;
      });
    }

    CoupledRun<dim>                 run;
    const ImmersedSurface<dim>     &surface;
    std::vector<dealii::Point<dim>> at_rest;
    std::vector<double>             pressures; ///< of nodes [Pa]
  };


  template <int dim>
  void
  check_levels()
  {
    const BallAndBox<dim> bodies;
    const auto            levels = bodies.following().levels();
    REQUIRE(levels.size() == bodies.pressures.size());
    for (unsigned int node = 0; node < levels.size(); ++node)
      CHECK(levels[node] == Approx(bodies.pressures[node]));
  }


  /// A turn about the first two axes.
  template <int dim>
  dealii::Tensor<1, dim>
  turned(const dealii::Tensor<1, dim> &vector)
  {
    auto result = vector;
    result[0]   = .8 * vector[0] - .6 * vector[1];
    result[1]   = .6 * vector[0] + .8 * vector[1];
    return result;
  }


  template <int dim>
  void
  check_turn()
  {
    const BallAndBox<dim> bodies;
    const auto            following = bodies.following();
    for (const auto &force : following.forces(bodies.run.models.solid->vector()))
      CHECK(force.norm() == 0);
    const auto where_cut = bodies.loads(bodies.at_rest);
    const auto turn      = bodies.displacement([](const auto &place) {
      return turned<dim>(place) - static_cast<const dealii::Tensor<1, dim> &>(place);
    });
    const auto forces    = following.forces(turn);
    for (unsigned int node = 0; node < forces.size(); ++node)
      CHECK((where_cut[node] + forces[node] - turned(where_cut[node])).norm() <=
            1e-12 * std::abs(bodies.pressures[node]));
  }


  /// The moment in the plane of two axes about their centres [N m], of the loads and of what
  /// follows the bodies, after these have turned by a small angle in that plane.
  template <int dim>
  std::array<double, 2>
  moments(const BallAndBox<dim> &bodies,
          const double           angle,
          const unsigned int     a,
          const unsigned int     b)
  {
    const auto turn = [&](const dealii::Tensor<1, dim> &vector) {
      auto result = vector;
      result[a]   = std::cos(angle) * vector[a] - std::sin(angle) * vector[b];
      result[b]   = std::sin(angle) * vector[a] + std::cos(angle) * vector[b];
      return result;
    };
    const auto             following = bodies.following();
    const auto             forces    = following.forces(bodies.displacement([&](const auto &place) {
      const dealii::Tensor<1, dim> arm(place);
      return turn(arm) - arm;
    }));
    const auto             loads     = bodies.loads(bodies.at_rest);
    const dealii::Point<3> of_ball(.3, .3, .3), of_box(.65, .7, .55);
    std::array<double, 2>  result{};
    for (unsigned int node = 0; node < forces.size(); ++node)
      {
        const bool             is_of_ball = bodies.is_of_ball(bodies.at_rest[node]);
        dealii::Tensor<1, dim> arm;
        for (unsigned int d = 0; d < dim; ++d)
          arm[d] = bodies.at_rest[node][d] - (is_of_ball ? of_ball : of_box)[d];
        arm              = turn(arm);
        const auto force = loads[node] + forces[node];
        result[is_of_ball ? 0 : 1] += arm[a] * force[b] - arm[b] * force[a];
      }
    return result;
  }


  /// Forces that kept their direction would turn a body as soon as it has turned a little, and one
  /// without inertia far.
  template <int dim>
  void
  check_moments()
  {
    BallAndBox<dim> bodies;
    for (unsigned int node = 0; node < bodies.pressures.size(); ++node)
      {
        const auto &place      = bodies.at_rest[node];
        bodies.pressures[node] = 1e4 * (1 + place[0] + 9 * place[0] * place[0] * place[1]);
      }
    constexpr double      angle = 1e-5;
    std::array<double, 2> stiffness{};
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = a + 1; b < dim; ++b)
        for (unsigned int body = 0; body < 2; ++body)
          stiffness[body] +=
            (moments(bodies, angle, a, b)[body] - moments(bodies, -angle, a, b)[body]) /
            (2 * angle);
    for (const double of_body : stiffness) // pressures times volumes are some hundred
      CHECK(std::abs(of_body) <= 1e-4);
  }


  template <int dim>
  void
  check_resultant()
  {
    const BallAndBox<dim>  bodies;
    const auto             following = bodies.following();
    const auto             forces    = following.forces(bodies.scattered(.3));
    dealii::Tensor<1, dim> on_ball, on_box;
    double                 sizes = 0;
    for (unsigned int node = 0; node < forces.size(); ++node)
      {
        (bodies.is_of_ball(bodies.at_rest[node]) ? on_ball : on_box) += forces[node];
        sizes += forces[node].norm();
      }
    CHECK(sizes > 100);
    CHECK(on_ball.norm() <= 1e-12 * sizes);
    CHECK(on_box.norm() <= 1e-12 * sizes);
  }


  template <int dim>
  void
  check_stiffness(const BallAndBox<dim> &bodies, const typename SolidModel<dim>::Vector &here)
  {
    const auto  following = bodies.following();
    const auto &model     = *bodies.run.models.solid;
    const auto  a = bodies.scattered(1.1), b = bodies.scattered(2.7);
    auto        stiffness = model.matrix();
    following.subtract_stiffness(stiffness, 2, here);

    const auto along_a = [&](const double part) {
      auto at = here;
      at.add(part, a);
      auto result = model.vector();
      bodies.surface.add_to_bodies(result, following.forces(at));
      return result;
    };
    auto change = along_a(.5); // forces are quadratic functions: this difference is the derivative
    change.add(-1., along_a(-.5));
    auto product = model.vector();
    stiffness.vmult(product, a);
    change.add(.5, product);
    CHECK(change.l2_norm() <= 1e-10 * product.l2_norm());

    auto of_b = model.vector();
    stiffness.vmult(of_b, b);
    CHECK(of_b * a == Approx(product * b));
  }


  template <int dim>
  void
  check_stiffnesses()
  {
    const BallAndBox<dim> bodies;
    check_stiffness(bodies, bodies.scattered(.3));
    check_stiffness(bodies, // a ball whose facets have no area
                    bodies.displacement([&](const auto &place) {
                      return bodies.is_of_ball(place) ? bodies.at_rest[0] - place
                                                      : dealii::Tensor<1, dim>();
                    }));
  }
} // namespace


TEST_CASE("The level of pressure is that of each closed part of the surface", "[coupled][mpi]")
{
  check_levels<2>();
  check_levels<3>();
}


TEST_CASE("A level of pressure turns with the bodies", "[coupled][mpi]")
{
  check_turn<2>();
  check_turn<3>();
}


TEST_CASE("Pressure that follows bodies neither turns them on nor back", "[coupled][mpi]")
{
  check_moments<2>();
  check_moments<3>();
}


TEST_CASE("Levels of pressure that follow bodies have no resultant", "[coupled][mpi]")
{
  check_resultant<2>();
  check_resultant<3>();
}


TEST_CASE("Forces of a level of pressure have a symmetric derivative", "[coupled][mpi]")
{
  check_stiffnesses<2>();
  check_stiffnesses<3>();
}
