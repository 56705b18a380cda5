// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/checkpoint.h>

#include <catch2/catch.hpp>

#include <limits>

#include "sample_scene.h"

using namespace undine_tests;

namespace
{
  template <int dim>
  using Vectors = typename Impulse<dim>::Vectors;


  template <int dim>
  State<dim>
  state_at(const SampleScene<dim> &scene, const unsigned int step)
  {
    auto state       = scene.linear_state(step);
    state.clock.step = step;
    state.clock.time = step / 7.;
    return state;
  }


  std::filesystem::path
  slot(const TemporaryFolder &folder, const unsigned int number)
  {
    return folder.path / "checkpoint" / ("slot_" + std::to_string(number) + ".h5");
  }


  /// Change the last bit of one number, known to the first rank, in a file.
  void
  spoil(const std::filesystem::path &path, const double number)
  {
    on_first_rank(MPI_COMM_WORLD, [&] {
      auto              text = read_file(path);
      const std::string bytes(reinterpret_cast<const char *>(&number), sizeof(number));
      const auto        place = text.find(bytes);
      if (place == std::string::npos)
        throw FileError("the number is not in the file");
      text[place] ^= 1;
      write_file(path, text);
    });
  }


  void
  truncate(const std::filesystem::path &path)
  {
    on_first_rank(MPI_COMM_WORLD, [&] {
      std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
    });
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "checkpoint: read back to the bit", "[checkpoint][mpi]", ((int dim), dim), 2, 3)
{
  TemporaryFolder        folder;
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  const auto             written = state_at(scene, 11);
  write_checkpoint(folder.path, scene.models, written);

  auto read           = scene.zero_state();
  read.clock.end_time = 99; // the scene's, not the checkpoint's
  CHECK(SampleScene<dim>::difference(read, written) > 0.1);
  const auto from = read_checkpoint(folder.path, scene.models, read);
  CHECK(SampleScene<dim>::difference(read, written) == 0);
  CHECK(read.clock.step == 11);
  CHECK(read.clock.time == written.clock.time);
  CHECK(read.clock.end_time == 99);
  CHECK(from.slot == slot(folder, 0));
}


TEST_CASE("checkpoint: what the energy monitor knows is read back, or nothing is known",
          "[checkpoint][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<2> scene(MPI_COMM_WORLD);
  auto                 watched = state_at(scene, 11);
  write_checkpoint(folder.path / "unwatched", scene.models, watched);
  watched.account = EnergyAccount{1. / 3, -2. / 3, 4, 0, 0, 0, 5, 6, -9, 7, 8, true};
  write_checkpoint(folder.path / "watched", scene.models, watched);

  auto read = scene.zero_state();
  read_checkpoint(folder.path / "watched", scene.models, read);
  CHECK(!read.account); // the run that goes on has no monitor
  read         = scene.zero_state();
  read.account = EnergyAccount();
  read_checkpoint(folder.path / "watched", scene.models, read);
  REQUIRE(read.account);
  CHECK(read.account->energy == 1. / 3);
  CHECK(read.account->power == -2. / 3);
  CHECK(read.account->exchange == 4);
  CHECK(read.account->largest == 5);
  CHECK(read.account->created == 6);
  CHECK(read.account->balance == -9);
  CHECK(read.account->excused == 7);
  CHECK(read.account->uncertain == 8);
  CHECK(read.account->known);

  read_checkpoint(folder.path / "unwatched", scene.models, read);
  REQUIRE(read.account);
  CHECK(!read.account->known); // so that the first step is not judged
}


TEMPLATE_TEST_CASE_SIG(
  "checkpoint: impulses are read back, or begin anew", "[checkpoint][mpi]", ((int dim), dim), 2, 3)
{
  TemporaryFolder        folder;
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  auto                   state = state_at(scene, 11);
  write_checkpoint(folder.path / "without", scene.models, state);
  state.impulses = {Impulse<dim>(2), Impulse<dim>()};
  for (unsigned int body = 0; body < 2; ++body)
    for (unsigned int axis = 0; axis < dim; ++axis)
      state.impulses->pressure.sum[body][axis] = (body + 1) / (axis + 3.);
  state.impulses->pressure.rates = {Vectors<dim>(2), state.impulses->pressure.sum};
  state.impulses->friction.rates = {Vectors<dim>()};
  write_checkpoint(folder.path / "with", scene.models, state);

  auto read = scene.zero_state();
  read_checkpoint(folder.path / "with", scene.models, read);
  CHECK(!read.impulses); // the run that goes on does not ask for them
  const Impulses<dim> none{Impulse<dim>(2), Impulse<dim>()};
  read          = scene.zero_state();
  read.impulses = none;
  read_checkpoint(folder.path / "with", scene.models, read);
  REQUIRE(read.impulses);
  CHECK(read.impulses->pressure.sum == state.impulses->pressure.sum);
  CHECK(read.impulses->pressure.rates ==
        std::vector<Vectors<dim>>{state.impulses->pressure.rates.back()});

  read          = scene.zero_state();
  read.impulses = none;
  read_checkpoint(folder.path / "without", scene.models, read);
  REQUIRE(read.impulses);
  CHECK(read.impulses->pressure.sum == Vectors<dim>(2));
  CHECK(read.impulses->pressure.rates.empty());

  read          = scene.zero_state();
  read.impulses = {Impulse<dim>(3), Impulse<dim>()};
  read_checkpoint(folder.path / "with", scene.models, read); // of other bodies
  REQUIRE(read.impulses);
  CHECK(read.impulses->pressure.sum == Vectors<dim>(3));
}


TEMPLATE_TEST_CASE_SIG("checkpoint: any number of ranks reads what any other wrote",
                       "[checkpoint][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  TemporaryFolder        folder;
  const SampleScene<dim> together(MPI_COMM_WORLD), alone(MPI_COMM_SELF);
  write_checkpoint(folder.path / "together", together.models, state_at(together, 3));
  auto read_alone = alone.zero_state();
  read_checkpoint(folder.path / "together", alone.models, read_alone);
  CHECK(SampleScene<dim>::difference(read_alone, state_at(alone, 3)) == 0);

  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    write_checkpoint(folder.path / "alone", alone.models, state_at(alone, 4));
  MPI_Barrier(MPI_COMM_WORLD);
  auto read_together = together.zero_state();
  read_checkpoint(folder.path / "alone", together.models, read_together);
  CHECK(SampleScene<dim>::difference(read_together, state_at(together, 4)) == 0);
}


TEST_CASE("checkpoint: slots alternate, a damaged one is skipped", "[checkpoint][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<2> scene(MPI_COMM_WORLD);
  for (const unsigned int step : {10, 20, 30})
    write_checkpoint(folder.path, scene.models, state_at(scene, step));
  auto state = scene.zero_state();
  CHECK(read_checkpoint(folder.path, scene.models, state).slot == slot(folder, 0));
  CHECK(state.clock.step == 30);

  SECTION("cut short")
  {
    truncate(slot(folder, 0));
  }
  SECTION("one bit changed")
  {
    const auto &pressure = state.fluid.pressure;
    spoil(slot(folder, 0), pressure(pressure.owned().lower));
  }
  SECTION("empty")
  {
    on_first_rank(MPI_COMM_WORLD, [&] { write_file(slot(folder, 0), ""); });
  }
  auto       fallen_back = scene.zero_state();
  const auto from        = read_checkpoint(folder.path, scene.models, fallen_back);
  CHECK(from.slot == slot(folder, 1));
  REQUIRE(from.skipped.size() == 1);
  CHECK(from.skipped[0].find("slot_0.h5") != std::string::npos);
  CHECK(fallen_back.clock.step == 20);
  CHECK(SampleScene<2>::difference(fallen_back, state_at(scene, 20)) == 0);

  truncate(slot(folder, 1));
  truncate(slot(folder, 0));
  auto untouched = state_at(scene, 5);
  CHECK_THROWS_AS(read_checkpoint(folder.path, scene.models, untouched), FileError);
  CHECK(SampleScene<2>::difference(untouched, state_at(scene, 5)) == 0);

  // A run that goes on replaces what cannot be read.
  write_checkpoint(folder.path, scene.models, state_at(scene, 40));
  read_checkpoint(folder.path, scene.models, untouched);
  CHECK(untouched.clock.step == 40);
}


TEST_CASE("checkpoint: nothing there, or of another scene, is said", "[checkpoint][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<2> scene(MPI_COMM_WORLD);
  auto                 state = scene.zero_state();
  CHECK_THROWS_WITH(read_checkpoint(folder.path, scene.models, state),
                    Catch::Contains("no checkpoint") && Catch::Contains(folder.path.string()));

  write_checkpoint(folder.path, scene.models, state_at(scene, 1));
  state.fluid.scalars.emplace("dye", Field<2>(scene.models.fluid->grid().cells()));
  CHECK_THROWS_WITH(read_checkpoint(folder.path, scene.models, state), Catch::Contains("dye"));

  const SampleScene<3> spatial(MPI_COMM_WORLD);
  auto                 other = spatial.zero_state();
  CHECK_THROWS_WITH(read_checkpoint(folder.path, spatial.models, other),
                    Catch::Contains("dimensions"));
}


TEST_CASE("checkpoint: a state that is not finite never replaces a good one", "[checkpoint][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<2> scene(MPI_COMM_WORLD);
  write_checkpoint(folder.path, scene.models, state_at(scene, 1));
  write_checkpoint(folder.path, scene.models, state_at(scene, 2));
  auto bad = state_at(scene, 3);
  if (bad.fluid.pressure.owned().contains({{0, 0}}))
    bad.fluid.pressure({{0, 0}}) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(write_checkpoint(folder.path, scene.models, bad),
                    Catch::Contains("fluid/pressure"));
  auto state = scene.zero_state();
  read_checkpoint(folder.path, scene.models, state);
  CHECK(state.clock.step == 2);
}


TEST_CASE("checkpoint: a full disk is an error and leaves the last one", "[checkpoint][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<3> scene(MPI_COMM_WORLD);
  write_checkpoint(folder.path, scene.models, state_at(scene, 1));
  {
    const FileSizeLimit limit(4096);
    CHECK_THROWS_AS(write_checkpoint(folder.path, scene.models, state_at(scene, 2)), FileError);
  }
  auto state = scene.zero_state();
  read_checkpoint(folder.path, scene.models, state);
  CHECK(state.clock.step == 1);
  CHECK(SampleScene<3>::difference(state, state_at(scene, 1)) == 0);
}
