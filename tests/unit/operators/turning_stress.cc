// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/turning_stress.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace undine;

namespace
{
  /// A body, its nodes and their area vectors into it.
  template <int dim>
  struct Body
  {
    Surface<dim>                        surface;
    std::vector<dealii::Point<dim>>     nodes;
    std::vector<dealii::Tensor<1, dim>> areas;
    double                              volume = 0;
  };


  /// The area vectors of nodes, a dim-th of those of their facets each, into the body.
  template <int dim, class Normal>
  void
  measure(Body<dim> &body, const Normal &normal)
  {
    body.areas.resize(body.nodes.size());
    for (const auto &facet : body.surface.facets())
      for (const unsigned int node : facet)
        body.areas[node] -= normal(facet) / dim;
    for (unsigned int node = 0; node < body.nodes.size(); ++node)
      body.volume -= body.nodes[node] * body.areas[node] / dim;
  }


  Body<2>
  disc(const unsigned int n)
  {
    std::vector<Surface<2>::Facet> facets;
    std::vector<dealii::Point<2>>  nodes;
    for (unsigned int k = 0; k < n; ++k)
      {
        const double angle = 2 * M_PI * k / n;
        nodes.emplace_back(3 + .2 * std::cos(angle), 1 + .2 * std::sin(angle));
        facets.push_back({k, (k + 1) % n});
      }
    Body<2> result{Surface<2>(n, facets, std::vector<unsigned int>(n, 0), {"disc"}), nodes, {}, 0};
    measure(result, [&](const auto &facet) {
      const auto along = result.nodes[facet[1]] - result.nodes[facet[0]];
      return dealii::Tensor<1, 2>({along[1], -along[0]});
    });
    return result;
  }


  Body<3>
  tetrahedron()
  {
    const std::vector<Surface<3>::Facet> facets{{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{0, 3, 2}}};
    const std::vector<dealii::Point<3>>  nodes{{0, 0, 0}, {1, 0, .2}, {.1, 1, 0}, {.3, .2, 1}};
    Body<3> result{Surface<3>(4, facets, {0, 0, 0, 0}, {"body"}), nodes, {}, 0};
    measure(result, [&](const auto &facet) {
      return .5 * cross_product_3d(result.nodes[facet[1]] - result.nodes[facet[0]],
                                   result.nodes[facet[2]] - result.nodes[facet[0]]);
    });
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  forces(const Body<dim> &body, const std::vector<dealii::Tensor<1, dim>> &velocities)
  {
    const TurningStress<dim> stress(body.surface, body.nodes.size(), body.nodes, body.areas, 7);
    std::vector<dealii::Tensor<1, dim>> result(body.nodes.size());
    stress.add_forces(result, velocities);
    return result;
  }


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  random_velocities(const Body<dim> &body, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> value(-1, 1);
    std::vector<dealii::Tensor<1, dim>>    result(body.nodes.size());
    for (auto &velocity : result)
      for (unsigned int d = 0; d < dim; ++d)
        velocity[d] = value(generator);
    return result;
  }


  template <int dim>
  double
  power(const std::vector<dealii::Tensor<1, dim>> &force,
        const std::vector<dealii::Tensor<1, dim>> &velocity)
  {
    double sum = 0;
    for (unsigned int node = 0; node < force.size(); ++node)
      sum += force[node] * velocity[node];
    return sum;
  }


  template <int dim>
  void
  check_resultant_and_symmetry(const Body<dim> &body)
  {
    const auto             u = random_velocities(body, 1), w = random_velocities(body, 2);
    const auto             by_u = forces(body, u), by_w = forces(body, w);
    dealii::Tensor<1, dim> sum;
    for (const auto &force : by_u)
      sum += force;
    CHECK(sum.norm() <= 1e-12 * std::abs(power(by_u, by_u)));
    CHECK(power(by_u, w) == Approx(power(by_w, u)));
  }
} // namespace


TEST_CASE("The stress on turning bodies has its moment and no resultant", "[friction]")
{
  // Moment -2 mu V w: half of that on a disc that turns in an infinite fluid, a third on a ball.
  const auto                        round = disc(50);
  std::vector<dealii::Tensor<1, 2>> turning(round.nodes.size());
  for (unsigned int node = 0; node < turning.size(); ++node)
    turning[node] = dealii::Tensor<1, 2>({-round.nodes[node][1], round.nodes[node][0]});
  const auto by_turning = forces(round, turning);
  CHECK(power(by_turning, turning) == Approx(-2 * 7 * round.volume));
  CHECK(round.volume == Approx(M_PI * .04).epsilon(.01));
  check_resultant_and_symmetry(round);

  const auto                        body = tetrahedron();
  std::vector<dealii::Tensor<1, 3>> spinning(body.nodes.size());
  const dealii::Tensor<1, 3>        spin({.3, -1, .5});
  for (unsigned int node = 0; node < spinning.size(); ++node)
    spinning[node] = cross_product_3d(spin, body.nodes[node]);
  CHECK(power(forces(body, spinning), spinning) ==
        Approx(-2 * 7 * body.volume * spin.norm_square()));
  check_resultant_and_symmetry(body);
}


TEST_CASE("Bodies that are wet in part have no turning stress", "[friction]")
{
  auto body = disc(20);
  body.areas[3] *= .5;
  CHECK(TurningStress<2>(body.surface, body.nodes.size(), body.nodes, body.areas, 7).empty());
}
