// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>

#include "executors.h"

#include <undine/particles/setup/disorder.h>

#include <functional>

using namespace particle_tests;

// Full domains with inflows, and openings through which fluid comes and goes under a pressure.

namespace
{
  constexpr int layers = 3;


  /// Fluid between the origin and `size` [spacings], a little out of order, periodic in all
  /// directions but `axis`, with layers of a material behind the lower and the upper end. Where
  /// `in_body` says so there is a body that is held.
  template <int dim>
  ParticleScene<dim>
  channel(const std::array<int, dim>                    &size,
          const int                                      axis,
          const int                                      lower_material,
          const int                                      upper_material,
          const Point<dim>                              &inflow,
          const std::function<bool(const Point<dim> &)> &in_body = {})
  {
    const double       l0 = .01;
    ParticleScene<dim> scene(l0);
    if (in_body)
      {
        scene.add_body({});
        scene.for_each_point(cube<dim>(0), size, [&](const Point<dim> &x) {
          if (in_body(x))
            scene.add(x, Kind::solid, 1, Point<dim>::zero());
        });
        std::fill(scene.setup.clamped.begin(), scene.setup.clamped.end(), all_directions<dim>);
      }
    auto lower = cube<dim>(0), upper = size;
    for (int d = 0; d < dim; ++d)
      {
        scene.setup.periodic[d] = d != axis;
        scene.setup.lower[d]    = d == axis ? -(layers + 2) * l0 : 0.;
        scene.setup.upper[d]    = (size[d] + (d == axis ? layers + 2 : 0)) * l0;
      }
    lower[axis] -= layers;
    upper[axis] += layers;
    scene.for_each_point(lower, upper, [&](const Point<dim> &x) {
      const double behind       = std::max(-x[axis], x[axis] - size[axis] * l0);
      const int    material     = x[axis] < 0 ? lower_material : upper_material;
      const bool   has_pressure = behind < l0 || material == opening_material;
      if (in_body && in_body(x))
        return;
      if (behind < 0)
        scene.add(x, Kind::fluid, 0, Point<dim>::zero());
      else
        scene.add(x,
                  has_pressure ? Kind::wall : Kind::dummy,
                  material,
                  material == inflow_material ? inflow : Point<dim>::zero());
    });
    for (const int end : {0, 1})
      {
        const int material = end == 0 ? lower_material : upper_material;
        if (material == 0)
          continue;
        OpenSide side;
        side.axis       = axis;
        side.plane      = end * size[axis] * l0;
        side.inward     = 1 - 2 * end;
        side.is_inflow  = material == inflow_material;
        side.is_opening = material == opening_material;
        side.depth      = layers * l0;
        scene.setup.open_sides.push_back(side);
      }
    scene.setup.is_full                  = true;
    scene.setup.numerics.faces_tolerance = 1e-3;
    disorder(scene.setup, scene.state);
    return scene;
  }


  template <int dim>
  double
  n_fluid(const ParticleState<dim> &state)
  {
    return std::count_if(state.tags.begin(), state.tags.end(), [](const Tag tag) {
      return tag.kind() == Kind::fluid;
    });
  }


  /// Component of the mean velocity of the fluid along an axis, and the largest difference from it.
  template <int dim>
  std::array<double, 2>
  motion_along(const ParticleState<dim> &state, const int axis)
  {
    double sum = 0, deviation = 0;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      sum += state.tags[i].kind() == Kind::fluid ? state.velocities[i][axis] : 0.;
    const double mean = sum / n_fluid(state);
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (state.tags[i].kind() == Kind::fluid)
          deviation =
            std::max(deviation, std::abs(state.velocities[i][d] - (d == axis ? mean : 0.)));
    return {{mean, deviation}};
  }


  template <int dim>
  constexpr std::array<int, dim> size_of_channel = [] {
    std::array<int, dim> size{};
    for (int d = 0; d < dim; ++d)
      size[d] = d == 0 ? (dim == 2 ? 24 : 12) : (dim == 2 ? 12 : 8);
    return size;
  }();
} // namespace


TEMPLATE_TEST_CASE_SIG("What flows into a full domain leaves it through an opening",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  const double speed = .5, length = size_of_channel<dim>[0] * .01;
  auto         scene =
    channel<dim>(size_of_channel<dim>, 0, inflow_material, opening_material, along<dim>(0, speed));
  scene.setup.numerics.largest_sub_step = .2 * .01 / speed;
  const double n_start                  = n_fluid(scene.state);
  const auto   engine                   = scene.engine();
  const int    frames                   = 20; // the fluid starts at once, and all of it is replaced
  for (int frame = 0; frame < frames; ++frame)
    engine->advance(1.2 * length / speed / frames);
  const auto state = state_of(*engine);
  CHECK(n_fluid(state) == Approx(n_start).epsilon(.5 / size_of_channel<dim>[0]));
  const auto motion = motion_along(state, 0);
  CHECK(motion[0] == Approx(speed).epsilon(.01));
  CHECK(motion[1] < .1 * speed);
}


TEST_CASE("A thin body much heavier than the fluid stands in a stream", "[particles]")
{
  const double             speed = .5, l0 = .01;
  const std::array<int, 2> size{{64, 64}};
  auto                     scene = channel<2>(
    size, 0, inflow_material, opening_material, along<2>(0, speed), [&](const Point<2> &x) {
      return std::abs(x[0] - 32 * l0) < l0 && x[1] < 40 * l0;
    });
  scene.setup.fluid_density             = 1;
  scene.setup.numerics.largest_sub_step = .2 * l0 / speed;
  const auto engine                     = scene.engine();
  for (int frame = 0; frame < 4; ++frame)
    engine->advance(.4 * l0 / speed);
  // The edges of a plate in a gap accelerate the fluid, but neither they nor the stream run away.
  const auto motion = motion_along(state_of(*engine), 0);
  CHECK(motion[0] == Approx(speed).epsilon(.05));
  CHECK(motion[1] < 8 * speed);
}


TEMPLATE_TEST_CASE_SIG("Fluid between two openings goes where the pressure is lower",
                       "[particles]",
                       ((int dim), dim),
                       2,
                       3)
{
  // Pressures are those of the layers, on the average half a spacing behind the openings.
  const double length = (size_of_channel<dim>[0] + 1) * .01, pressure = 25;
  const auto   axis = GENERATE(0, dim - 1);
  auto         size = size_of_channel<dim>;
  std::swap(size[0], size[axis]);
  auto scene = channel<dim>(size, axis, opening_material, opening_material, Point<dim>::zero());
  scene.setup.open_sides[1].pressure = pressure;
  const double n_start               = n_fluid(scene.state);
  const auto   engine                = scene.engine();
  const double time = .2, per_frame = .02;
  for (int frame = 0; frame < 10; ++frame)
    engine->advance(per_frame);
  const auto state = state_of(*engine);
  CHECK(motion_along(state, axis)[0] ==
        Approx(-pressure / 1000 / length * time).epsilon(.5 / size_of_channel<dim>[0]));
  CHECK(n_fluid(state) == Approx(n_start).epsilon(.5 / size_of_channel<dim>[0]));
}


TEMPLATE_TEST_CASE_SIG(
  "Water under an opening at the top is at rest", "[particles]", ((int dim), dim), 2, 3)
{
  const int up   = dim - 1;
  auto      size = size_of_channel<dim>;
  std::swap(size[0], size[up]);
  auto scene                = channel<dim>(size, up, 0, opening_material, Point<dim>::zero());
  scene.setup.gravity       = along<dim>(up, -9.81);
  scene.setup.depth         = size[up] * .01;
  scene.setup.top_potential = 9.81 * scene.setup.depth;
  const auto engine         = scene.engine(Precision::single_precision);
  for (int frame = 0; frame < 10; ++frame)
    engine->advance(.02);
  const auto motion = motion_along(state_of(*engine), up);
  CHECK(std::abs(motion[0]) + motion[1] < 1e-4 * std::sqrt(9.81 * scene.setup.depth));
}
