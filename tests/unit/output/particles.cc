// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/checkpoint.h>
#include <undine/output/fields/particle_patches.h>
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>

#include <catch2/catch.hpp>
#include <message_of.h>

#include <algorithm>

#include "sample_scene.h"

using namespace undine_tests;
using particles::Kind;

namespace
{
  const std::string scene_text =
    "subsection Particles\n set Spacing = 1\nend\n"
    "subsection Domain\n set Lower corner = 0, 0\n set Upper corner = 8, 8\nend\n"
    "subsection Fluid\n set Density = 1000\nend\n"
    "subsection Bodies\n subsection block\n  set Lower corner = 2, 5\n  set Upper corner = 4, 7\n"
    "  set Density = 500\n  set Young's modulus = 1e5\n  set Poisson's ratio = 0.3\n end\nend\n";


  Models<2>
  sample_models(const std::string &more = "", const std::string &region = "3 - y")
  {
    Models<2> models;
    models.particles = std::make_unique<const ParticleModel<2>>(
      options_of(scene_text + "subsection Fluid\n set Region = " + region + "\nend\n" + more),
      models.effects,
      MPI_COMM_SELF);
    return models;
  }


  /// The initial state with other numbers everywhere, and in another order.
  State<2>
  sample_state(const Models<2> &models)
  {
    State<2> state;
    state.particles    = models.particles->initial_state();
    auto      &all     = state.particles;
    const auto reverse = [](auto &values) { std::reverse(values.begin(), values.end()); };
    reverse(all.positions);
    reverse(all.velocities);
    reverse(all.tags);
    reverse(all.identities);
    for (std::size_t k = 0; k < all.positions.size(); ++k)
      {
        all.positions[k][0] += 0.25;
        all.velocities[k][1] = 0.1 * k;
        all.pressures[k]     = 3. + k;
      }
    all.guesses = {1.5, 2.5, -1};
    all.scalars["smoke"].assign(all.positions.size(), 0.5);
    all.scalars["smoke"][3] = -7.25;
    state.clock.step        = 7;
    state.clock.time        = 0.25;
    return state;
  }


  /// Of bodies that have gone through periodic sides, and a quarter of a metre on.
  std::vector<particles::Vector<2, double>>
  points_a_period_ahead(const Models<2> &models)
  {
    auto result = models.particles->setup().reference;
    for (auto &point : result)
      point[0] += 8.25;
    return result;
  }


  Columns
  measured(const Models<2>   &models,
           const State<2>    &state,
           const std::string &kind,
           const std::string &keys)
  {
    const auto options =
      options_of("subsection Probes\n subsection here\n" + keys + "\n end\nend\n")
        .section("Probes")
        .section("here");
    auto probe = Registry<Probe<2>>::instance().make(kind);
    probe->add_options(options);
    probe->start("here", options, models);
    return probe->columns(models, state);
  }
} // namespace


TEST_CASE("particles: a checkpoint read back is what was written")
{
  const TemporaryFolder folder;
  const auto            models      = sample_models();
  auto                  state       = sample_state(models);
  const bool            goes_around = GENERATE(false, true); // through periodic sides
  if (goes_around)
    state.particles.body_points = points_a_period_ahead(models);
  write_checkpoint(folder.path, models, state);
  State<2> other;
  other.particles                  = models.particles->initial_state();
  other.particles.scalars["smoke"] = {};
  read_checkpoint(folder.path, models, other);
  const auto &a = state.particles, &b = other.particles;
  CHECK(other.clock.step == 7);
  CHECK(a.identities == b.identities);
  CHECK(a.pressures == b.pressures);
  CHECK(a.guesses == b.guesses);
  CHECK(a.scalars == b.scalars);
  REQUIRE(a.body_points.size() == b.body_points.size());
  for (std::size_t k = 0; k < a.body_points.size(); ++k)
    CHECK(norm_square(a.body_points[k] - b.body_points[k]) == 0);
  for (std::size_t k = 0; k < a.positions.size(); ++k)
    {
      CHECK(a.tags[k].code == b.tags[k].code);
      for (int axis = 0; axis < 2; ++axis)
        {
          CHECK(a.positions[k][axis] == b.positions[k][axis]);
          CHECK(a.velocities[k][axis] == b.velocities[k][axis]);
        }
    }
}


TEST_CASE("particles: a checkpoint of another scene is refused")
{
  const TemporaryFolder folder;
  const auto            models = sample_models();
  write_checkpoint(folder.path, models, sample_state(models));
  const auto more =
    sample_models("subsection Obstacles\n subsection rock\n  set Lower corner = 5, 3\n"
                  "  set Upper corner = 7, 5\n end\nend\n");
  State<2> other;
  other.particles = more.particles->initial_state();
  CHECK_THAT(message_of([&] { read_checkpoint(folder.path, more, other); }),
             Catch::Matchers::Contains("particles of bodies and walls"));
}


TEST_CASE("particles: pictures have points with their numbers, walls on request")
{
  const auto models = sample_models();
  const auto state  = sample_state(models);
  const auto part   = particle_patches(*models.particles, state.particles);
  CHECK(part.patches.size() == 24 + 4);
  CHECK(part.components.size() == 9);
  for (const auto &patch : part.patches)
    {
      const auto k = place_of_identity(state.particles, int(patch.data(7, 0)));
      CHECK(patch.vertices[0][0] == state.particles.positions[k][0]);
      CHECK(patch.data(1, 0) == Approx(state.particles.velocities[k][1]));
      CHECK(patch.data(4, 0) == Approx(state.particles.pressures[k]));
      const bool of_body = patch.data(5, 0) == 1;
      CHECK(patch.data(6, 0) == (of_body ? 0 : -1));
      CHECK(patch.data(2, 0) == Approx(of_body ? 0.25 : 0.));
      CHECK(patch.data(8, 0) ==
            (of_body ? 0 : state.particles.scalars.at("smoke")[state.particles.identities[k]]));
    }
  const auto with_walls = sample_models("subsection Output\n set Walls = true\nend\n");
  CHECK(particle_patches(*with_walls.particles, state.particles).patches.size() ==
        state.particles.positions.size());
}


TEST_CASE("particles: probes of the body, the wall and the front")
{
  const auto models = sample_models();
  auto       state  = sample_state(models);

  const auto body =
    measured(models, state, "body point", "set Body = block\n set Point = 2.4, 5.6");
  CHECK(body[0].value == Approx(0.25));
  CHECK(body[1].value == Approx(0).margin(1e-12));
  const auto k = place_of_identity(state.particles, 0);
  CHECK(body[3].value == Approx(state.particles.velocities[k][1]));

  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    state.particles.pressures[p] =
      state.particles.tags[p].kind() == Kind::wall ? state.particles.positions[p][0] : 1e9;
  const auto wall = measured(models, state, "wall pressure", "set Point = 4, 0\n set Radius = 1.6");
  CHECK(wall[0].value == Approx(4 + 0.25));

  CHECK(measured(models, state, "front", "set Direction = y")[0].value == Approx(3));
  // A drop that has come off does not count.
  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    if (state.particles.tags[p].kind() == Kind::fluid)
      {
        state.particles.positions[p][1] += 20;
        break;
      }
  CHECK(measured(models, state, "front", "set Direction = y")[0].value == Approx(3));
  CHECK(measured(models, state, "front", "set Direction = -x")[0].value == Approx(0.25));
}


TEST_CASE("particles: displacements go on through periodic sides")
{
  const auto models           = sample_models();
  auto       state            = sample_state(models);
  state.particles.body_points = points_a_period_ahead(models);
  CHECK(measured(models, state, "body point", "set Body = block\n set Point = 2.4, 5.6")[0].value ==
        Approx(8.25));
  for (const auto &patch : particle_patches(*models.particles, state.particles).patches)
    CHECK(patch.data(2, 0) == Approx(patch.data(5, 0) == 1 ? 8.25 : 0.));
}


TEST_CASE("particles: heights and momenta of a block are exact, single particles count little")
{
  const auto models = sample_models();
  auto       state  = sample_state(models);
  const auto height = [&] {
    return measured(models, state, "surface height", "set Point = 4.3, 7")[0].value;
  };
  CHECK(height() == Approx(3));

  // 24 particles of 1000 kg each.
  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    state.particles.velocities[p][1] = -9.81 * 0.3;
  const auto all = measured(models, state, "fluid region", "set Region = 1");
  CHECK(all[0].value == Approx(24e3));
  CHECK(all[1].value == Approx(0).margin(1e-9));
  CHECK(all[2].value == Approx(-24e3 * 9.81 * 0.3));
  CHECK(all[3].value == Approx(24e3 * std::pow(9.81 * 0.3, 2) / 2));
  CHECK(measured(models, state, "fluid region", "set Region = 2 - y")[0].value == Approx(16e3));

  // One that lies on the others leaves the height where it is.
  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    if (state.particles.tags[p].kind() == Kind::fluid && state.particles.positions[p][1] < 1 &&
        std::abs(state.particles.positions[p][0] - 4.75) < 0.1)
      state.particles.positions[p][1] = 3.5;
  CHECK(measured(models, state, "front", "set Direction = y")[0].value == Approx(4));
  CHECK(height() == Approx(3));
}


TEST_CASE("particles: heights and fronts are seen across periodic sides")
{
  // A lower part of the fluid on the right goes on in a higher one on the left.
  const std::string round  = "subsection Domain\n set Periodic sides = left, right\nend\n";
  const auto        models = sample_models(round, "if(x < 2, 3 - y, if(x > 4, 2 - y, -1))");
  State<2>          state;
  state.particles = models.particles->initial_state();
  CHECK(measured(models, state, "front", "set Direction = y")[0].value == Approx(3));
  const auto height = [&](const Models<2> &of, const std::string &place) {
    return measured(of, state, "surface height", "set Radius = 2\n set Point = " + place)[0].value;
  };
  CHECK(height(models, "8, 0") == Approx(height(models, "0, 0")));
  CHECK(height(models, "0, 0") == Approx(2.5).margin(0.35)); // less at the ends of so few particles

  // A level surface is as high beside the sides as elsewhere.
  const auto level = sample_models(round);
  state.particles  = level.particles->initial_state();
  for (const std::string place : {"0.3, 0", "4, 0", "7.9, 0"})
    CHECK(height(level, place) == Approx(3));
}


TEST_CASE("particles: the pressure on a wall is that on the side that is asked for")
{
  // Sheets of two spacings and one, and the corner between the first one and the floor. Particles
  // have pressures that tell where they are.
  const auto models = sample_models(
    "subsection Obstacles\n"
    " subsection thin\n  set Lower corner = 4, 0\n  set Upper corner = 6, 5\n end\n"
    " subsection thinner\n  set Lower corner = 0, 6\n  set Upper corner = 2, 7\n end\nend\n");
  State<2> state;
  state.particles = models.particles->initial_state();
  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    state.particles.pressures[p] =
      100 * state.particles.positions[p][0] + state.particles.positions[p][1];
  const auto pressure = [&](const std::string &place) {
    return measured(models, state, "wall pressure", "set Radius = 1.6\n set Point = " + place)[0]
      .value;
  };
  CHECK(pressure("4, 3") == Approx(450 + 3.));
  CHECK(pressure("6, 3") == Approx(550 + 3.));
  CHECK(pressure("1, 6") == Approx(100 + 6.5));
  CHECK(pressure("1, 7") == Approx(100 + 6.5));
  CHECK(pressure("3, 0") == Approx(300 - 0.5));
}


TEST_CASE("particles: pressures on a body and on an obstacle that moves")
{
  const auto models = sample_models("subsection Obstacles\n subsection gate\n  set Shape = box\n"
                                    "  set Lower corner = 6, 0\n  set Upper corner = 8, 8\n"
                                    "  set Displacement = t; 0\n end\nend\n");
  State<2>   state;
  state.particles = models.particles->initial_state();
  for (std::size_t p = 0; p < state.particles.tags.size(); ++p)
    {
      state.particles.pressures[p] = 100 * (8 - state.particles.positions[p][1]);
      state.particles.positions[p][0] += 0.5; // whatever is measured goes with its particles
    }
  // The face of the gate: the force of water is the pressure in its middle times its height.
  CHECK(measured(models, state, "wall pressure", "set Point = 6, 4\n set Radius = 3.5")[0].value ==
        Approx(400));
  CHECK(measured(models,
                 state,
                 "body pressure",
                 "set Body = block\n set Point = 3, 5\n"
                 " set Radius = 0.8")[0]
          .value == Approx(250));
  CHECK_THAT(message_of([&] {
               measured(models, state, "body pressure", "set Body = rock\n set Point = 3, 5");
             }),
             Catch::Matchers::Contains("Allowed: block"));
  CHECK_THAT(message_of([&] { measured(models, state, "surface height", "set Point = 9, 5"); }),
             Catch::Matchers::Contains("not above the domain"));
}


TEST_CASE("particles: probes that see nothing are refused")
{
  const auto models = sample_models();
  const auto state  = sample_state(models);
  const auto wrong  = [&](const std::string &kind, const std::string &keys) {
    return message_of([&] { measured(models, state, kind, keys); });
  };
  CHECK_THAT(wrong("body point", "set Body = block\n set Point = 7, 7"),
             Catch::Matchers::Contains("farther than a spacing"));
  CHECK_THAT(wrong("body point", "set Body = rock\n set Point = 7, 7"),
             Catch::Matchers::Contains("Allowed: block"));
  CHECK_THAT(wrong("wall pressure", "set Point = 4, 4"), Catch::Matchers::Contains("no wall"));
  CHECK_THAT(wrong("fluid point", "set Point = 4, 4"), Catch::Matchers::Contains("wall pressure"));
}
