// SPDX-License-Identifier: LGPL-2.1-or-later
// Sizes by the parameter file alone, against those of what is built from it; and estimates.
#include <undine/scene/estimate.h>
#include <undine/scene/scene.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

using namespace undine;

namespace
{
  namespace fs = std::filesystem;

  Options
  read(const fs::path &scene, const std::vector<std::string> &settings = {})
  {
    ParameterFile file(scene.string());
    for (const auto &setting : settings)
      file.set(setting);
    return Options(file);
  }

  fs::path
  scene(const std::string &name)
  {
    return fs::path(UNDINE_SOURCE_DIR) / "prm" / (name + ".prm");
  }

  /// Is `a` between `b` over and `b` times the factor?
  bool
  is_within(const double a, const double b, const double factor)
  {
    return a <= b * factor && a >= b / factor;
  }

  template <int dim>
  void
  compare(const Options &options)
  {
    const auto size  = measure_scene<dim>(options);
    const auto scene = read_scene<dim>(options, MPI_COMM_WORLD);
    if (const auto &fluid = scene.models.fluid)
      CHECK(size.grid.cells == fluid->grid().n_cells());
    else
      CHECK(size.grid.cells == 0);
    if (const auto &solid = scene.models.solid)
      {
        CHECK(size.solid.elements == solid->triangulation().n_global_active_cells());
        CHECK(size.solid.unknowns == solid->dof_handler().n_dofs());
      }
    else
      CHECK(size.solid.elements == 0);
    if (const auto &particles = scene.models.particles)
      {
        const auto state = particles->initial_state();
        const auto setup = particles->setup();
        CHECK(
          is_within(size.particles.all() - size.particles.waiting, state.positions.size(), 1.3));
        if (!setup.reference.empty())
          CHECK(is_within(size.particles.solid, setup.reference.size(), 1.2));
      }
    else
      CHECK(size.particles.all() == 0);
  }

  /// Core seconds of whole runs of the scenes in prm/ and prm/hard, as tests/scenes/costs.csv has
  /// them.
  std::map<std::string, double>
  recorded_costs()
  {
    std::map<std::string, double> result;
    std::ifstream                 table(fs::path(UNDINE_SOURCE_DIR) / "tests/scenes/costs.csv");
    for (std::string line; std::getline(table, line);)
      if (line[0] != '#' && line.rfind("scene,", 0) != 0)
        {
          const auto comma              = line.find(',');
          result[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
        }
    return result;
  }


  /// Of a grid of n cells along each edge.
  Estimate
  of_grid(const std::string &name, const unsigned int n, const unsigned int n_ranks = 1)
  {
    const auto options = read(scene(name));
    const auto cells   = std::to_string(n);
    if (read_dimension(options) == 2)
      return estimate(measure_scene<2>(read(scene(name), {"Domain/Cells=" + cells + "," + cells})),
                      n_ranks);
    return estimate(
      measure_scene<3>(read(scene(name), {"Domain/Cells=" + cells + "," + cells + "," + cells})),
      n_ranks);
  }
} // namespace


TEST_CASE("sizes by the parameter file are those of what is built")
{
  unsigned int n_scenes = 0;
  for (const auto &entry : fs::directory_iterator(fs::path(UNDINE_SOURCE_DIR) / "prm"))
    {
      if (entry.path().extension() != ".prm")
        continue;
      CAPTURE(entry.path().filename().string());
      const auto options = read(entry.path());
      if (read_dimension(options) == 2)
        compare<2>(options);
      else
        compare<3>(options);
      ++n_scenes;
    }
  CHECK(n_scenes > 30);
}


TEMPLATE_TEST_CASE_SIG("shapes say how large their meshes are", "", ((int dim), dim), 2, 3)
{
  for (const auto &name : Registry<BodyShape<dim>>::instance().names())
    {
      if (name == "gmsh")
        continue; // which is read from a file, and counted
      CAPTURE(name);
      const auto    shape = Registry<BodyShape<dim>>::instance().make(name);
      ParameterFile file;
      file.set(name == "box" ? dim < 3 ? "Cells=5, 2" : "Cells=5, 2, 3" : "Radius=0.7");
      shape->add_options(Options(file));
      dealii::Triangulation<dim> mesh;
      shape->make_mesh(mesh);
      const auto said = shape->size(), counted = shape->BodyShape<dim>::size();
      CHECK(said.cells == mesh.n_active_cells());
      CHECK(said.parts == counted.parts);
      CHECK(said.faces == counted.faces);
      CHECK(said.is_curved == counted.is_curved);
      CHECK(said.slices == Approx(counted.slices).epsilon(0.2));
      CHECK(said.volume == Approx(counted.volume).epsilon(0.03));
      CHECK(said.area == Approx(counted.area).epsilon(0.03));
    }
}


TEST_CASE("sizes beyond all memory are measured all the same")
{
  const auto grid = measure_scene<3>(read(scene("plume"), {"Domain/Cells=1e5, 1e5, 1e5"}));
  CHECK(grid.grid.cells == 1e15);
  const auto bodies = measure_scene<3>(
    read(scene("cantilever"), {"Bodies/beam/Cells=4e4, 4e4, 4e4", "Bodies/beam/Refinements=12"}));
  CHECK(bodies.solid.elements == Approx(std::pow(4e4 * 4096, 3)));
  CHECK(estimate(bodies, 1).memory > 1e27);
}


TEST_CASE("planes and gradings count as they are")
{
  const auto options = read(scene("plume"), {"Domain/Planes x=0, 0.1, 0.3, 1"});
  CHECK(measure_scene<3>(options).grid.cells == 3 * 64 * 32);
}


TEST_CASE("estimates grow with what there is to compute")
{
  for (const std::string name : {"plume", "ball_in_stream", "cavity", "taylor_green"})
    {
      CAPTURE(name);
      const auto   coarse = of_grid(name, 500), fine = of_grid(name, 1000);
      const auto   on_two = of_grid(name, 500, 2);
      const double cells  = read_dimension(read(scene(name))) == 2 ? 4 : 8;
      // Surfaces in the fluid grow more slowly, ranks have the program each.
      CHECK(fine.growth_of_rank(1) <= 1.0001 * cells * coarse.growth_of_rank(1));
      CHECK(fine.growth_of_rank(1) >= 0.8 * cells * coarse.growth_of_rank(1));
      CHECK(fine.seconds == Approx(cells * coarse.seconds).epsilon(0.2));
      CHECK(on_two.growth_of_rank(2) == Approx(coarse.growth_of_rank(1) / 2).epsilon(0.1));
      CHECK(on_two.seconds < coarse.seconds);
      CHECK(on_two.seconds > coarse.seconds / 2);
      CHECK(fine.checkpoint == Approx(cells * coarse.checkpoint));
    }
}


TEST_CASE("most scenes take within the factor that is promised what is estimated")
{
  unsigned int n_scenes = 0, n_within = 0;
  for (const auto &[name, core_seconds] : recorded_costs())
    {
      CAPTURE(name);
      const auto file    = fs::exists(scene(name)) ? scene(name) : scene("hard/" + name);
      const auto options = read(file);
      const auto size =
        read_dimension(options) == 2 ? measure_scene<2>(options) : measure_scene<3>(options);
      // Runs that a failed step ends soon, and particles: other laws.
      if (size.particles.all() > 0 || name == "jet_two_sheets_split_2d")
        continue;
      const auto   expected = estimate(size, 1);
      const double factor   = core_seconds / (expected.seconds * size.steps);
      ++n_scenes;
      n_within += is_within(factor, 1, expected.uncertainty_of_seconds);
      CHECK(is_within(factor, 1, 3 * expected.uncertainty_of_seconds));
    }
  CHECK(n_scenes > 60);
  CHECK(n_within >= 0.9 * n_scenes);
}


TEST_CASE("two fields and a second stage cost more")
{
  const auto two  = measure_scene<3>(read(scene("plume")));
  auto       none = two;
  none.grid.advected -= 2;
  none.grid.scalars -= 2;
  CHECK(two.grid.scalars == 2);
  CHECK(two.grid.advected == 3 + 2);
  CHECK(estimate(two, 1).memory > estimate(none, 1).memory);
  CHECK(estimate(two, 1).seconds > 1.05 * estimate(none, 1).seconds);
  const auto one_stage = measure_scene<3>(read(scene("plume"), {"Time/Integrator=theta"}));
  CHECK(two.stages == 2);
  CHECK(one_stage.stages == 1);
  CHECK(estimate(one_stage, 1).seconds < 0.6 * estimate(two, 1).seconds);
}


TEST_CASE("particles: half the spacing, four times as many and more than twice the sub-steps")
{
  const auto coarse =
    measure_scene<2>(read(scene("dam_break_particles"), {"Particles/Spacing=0.146/40"})).particles;
  const auto fine =
    measure_scene<2>(read(scene("dam_break_particles"), {"Particles/Spacing=0.146/80"})).particles;
  CHECK(fine.fluid == Approx(4 * coarse.fluid).epsilon(0.05));
  CHECK(fine.walls == Approx(2 * coarse.walls).epsilon(0.1));
  CHECK(fine.sub_steps >= 1.9 * coarse.sub_steps);
}
