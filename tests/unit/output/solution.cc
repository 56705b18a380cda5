// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/patches.h>
#include <undine/output/fields/solution_parts.h>
#include <undine/output/files/hdf5_reader.h>
#include <undine/output/output.h>
#include <undine/output/probes/probe.h>

#include <boost/property_tree/xml_parser.hpp>
#include <catch2/catch.hpp>

#include <algorithm>
#include <set>

#include "sample_scene.h"

using namespace undine_tests;

namespace
{
  namespace fs = std::filesystem;
  using boost::property_tree::ptree;

  ptree
  read_xml(const fs::path &path)
  {
    ptree tree;
    boost::property_tree::read_xml(path.string(), tree);
    return tree;
  }


  /// A registered output, run for the initial state and four steps, of which two are due.
  template <int dim>
  void
  run_output(const SampleScene<dim> &scene,
             const std::string      &name,
             const fs::path         &folder,
             const std::string      &options = "")
  {
    const std::vector<std::unique_ptr<Probe<dim>>> probes;
    TimingTree                                     timing;
    auto output = Registry<Output<dim>>::instance().make(name);
    output->add_options(options_of(options).section("Output"));
    auto state                   = scene.linear_state();
    state.clock.end_time         = 1;
    state.clock.landing_interval = 0.5;
    ResultFolder results(MPI_COMM_WORLD, folder);
    results.begin();
    output->start({MPI_COMM_WORLD, results, scene.models, probes, timing}, state);
    while (true)
      {
        if (output->due(state.clock))
          output->write(state, Report());
        if (state.clock.ended())
          return;
        state.clock.advance(0.25);
      }
  }


  template <class Number>
  Number
  sum_over_ranks(const Number number)
  {
    return dealii::Utilities::MPI::sum(number, MPI_COMM_WORLD);
  }


  /// All of an HDF5 array with two directions.
  template <class Value>
  std::vector<Value>
  read_all(const HDF5Reader &file, const std::string &name)
  {
    const auto size = file.size(name);
    return file.read<Value>(name, {size, {0, 0}, size});
  }


  /// The distinct numbers of one component in the patches of all ranks.
  template <int dim>
  std::set<double>
  numbers_in_patches(const Patches<dim> &part, const unsigned int component)
  {
    std::vector<double> mine;
    for (const auto &patch : part.patches)
      for (unsigned int point = 0; point < patch.data.n_cols(); ++point)
        mine.push_back(patch.data(component, point));
    std::set<double> all;
    for (const auto &numbers : dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      all.insert(numbers.begin(), numbers.end());
    return all;
  }


  /// The distinct numbers of one column of an array.
  std::set<double>
  numbers_in_file(const HDF5Reader &file, const std::string &name, const unsigned int column)
  {
    const auto       n_columns = file.size(name)[1];
    const auto       values    = read_all<double>(file, name);
    std::set<double> result;
    for (std::size_t i = column; i < values.size(); i += n_columns)
      result.insert(values[i]);
    return result;
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  nodes_in_file(const HDF5Reader &file)
  {
    const auto                      numbers = read_all<double>(file, "nodes");
    std::vector<dealii::Point<dim>> nodes(numbers.size() / dim);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      nodes[i / dim][i % dim] = numbers[i];
    return nodes;
  }


  /// Of the boxes that the cells of a file are.
  template <int dim>
  double
  volume_in_file(const HDF5Reader &file)
  {
    constexpr unsigned int n_vertices = 1u << dim;
    const auto             nodes      = nodes_in_file<dim>(file);
    const auto             cells      = read_all<unsigned int>(file, "cells");
    double                 volume     = 0;
    for (std::size_t first = 0; first < cells.size(); first += n_vertices)
      {
        double product = 1;
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            std::set<double> places;
            for (unsigned int v = 0; v < n_vertices; ++v)
              places.insert(nodes.at(cells[first + v])[axis]);
            product *= *places.rbegin() - *places.begin();
          }
        volume += product;
      }
    return volume;
  }


  template <int dim>
  bool
  is_inside(const dealii::Point<dim> &place)
  {
    bool inside = true;
    for (unsigned int axis = 0; axis < dim; ++axis)
      inside = inside && place[axis] > 1e-6 && place[axis] < 1 - 1e-6;
    return inside;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "HDF5: what is read back is what was written", "[solution][mpi]", ((int dim), dim), 2, 3)
{
  TemporaryFolder        folder;
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  for (const auto &part : solution_parts(scene.models, scene.linear_state()))
    {
      const auto path = folder.path / (part.name + ".h5");
      write_hdf5(MPI_COMM_WORLD, path, part.name, part, 0.5);
      const HDF5Reader file(path, MPI_COMM_WORLD);
      for (unsigned int c = 0; c < part.components.size(); ++c)
        {
          auto column = 0u;
          auto name   = part.components[c];
          for (const auto &range : part.vectors)
            if (std::get<0>(range) <= c && c <= std::get<1>(range))
              {
                column = c - std::get<0>(range);
                name   = std::get<2>(range);
              }
          CHECK(numbers_in_file(file, name, column) == numbers_in_patches(part, c));
        }

      // Linear fields are exact wherever no wall bends them: numbers are at the right places.
      const auto nodes     = nodes_in_file<dim>(file);
      const auto velocity  = read_all<double>(file, "velocity");
      bool       all_equal = true;
      for (std::size_t n = 0; n < nodes.size(); ++n)
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (part.name == "bodies" || is_inside(nodes[n]))
            all_equal = all_equal && velocity[3 * n + axis] ==
                                       Approx(linear_velocity(nodes[n])[axis]).margin(1e-5);
      CHECK(all_equal);
      CHECK(volume_in_file<dim>(file) == Approx(1).epsilon(1e-5));
    }
}


TEMPLATE_TEST_CASE_SIG("the fluid in corners: exact for linear fields, up to the boundary",
                       "[solution][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  const auto             part = solution_parts(scene.models, scene.linear_state())[1];
  REQUIRE(part.name == "fluid");
  std::uint64_t n_cells = 0;
  for (const auto &patch : part.patches)
    n_cells += dealii::Utilities::pow(patch.n_subdivisions, dim);
  CHECK(sum_over_ranks(n_cells) == scene.models.fluid->grid().n_cells());

  double vorticity = 0; // of the linear velocity
  for (unsigned int a = 0; a < dim; ++a)
    for (unsigned int b = 0; b < a; ++b)
      {
        const auto unit = [](const unsigned int axis) {
          return dealii::Point<dim>(dealii::Point<dim>::unit_vector(axis));
        };
        const auto slope = [&](const unsigned int component, const unsigned int axis) {
          return (linear_velocity(unit(axis)) - linear_velocity(dealii::Point<dim>()))[component];
        };
        vorticity += std::pow(slope(a, b) - slope(b, a), 2);
      }
  double error = 0;
  for (const auto &patch : part.patches)
    for (unsigned int point = 0; point < patch.data.n_cols(); ++point)
      {
        dealii::Point<dim> place;
        for (unsigned int axis = 0; axis < dim; ++axis)
          place[axis] = patch.data(patch.data.n_rows() - dim + axis, point);
        error = std::max(error, std::abs(patch.data(dim, point) - linear_scalar(place)));
        if (is_inside(place))
          error = std::max(error, std::abs(patch.data(dim + 1, point) - std::sqrt(vorticity)));
      }
  CHECK(dealii::Utilities::MPI::max(error, MPI_COMM_WORLD) < 1e-5);
}


TEMPLATE_TEST_CASE_SIG("vtu: valid files with all cells, listed with both parts",
                       "[solution][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  TemporaryFolder        folder;
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  run_output(scene,
             "vtu",
             folder.path,
             "subsection Output\n subsection vtu\n set Bodies = deformed\n end\nend\n");
  std::vector<std::string> parts;
  std::vector<double>      times;
  const auto               pvd = read_xml(folder.path / "solution.pvd");
  for (const auto &entry : pvd.get_child("VTKFile.Collection"))
    if (entry.first == "DataSet")
      {
        const auto attributes = entry.second.get_child("<xmlattr>");
        parts.push_back(attributes.get<std::string>("name"));
        times.push_back(attributes.get<double>("timestep"));
        const auto vtu   = read_xml(folder.path / attributes.get<std::string>("file"));
        int        cells = 0;
        for (const auto &piece : vtu.get_child("VTKFile.UnstructuredGrid"))
          if (piece.first == "Piece")
            cells += piece.second.get<int>("<xmlattr>.NumberOfCells");
        // Quadratic elements are drawn as 2^dim cells.
        CHECK(cells == dealii::Utilities::pow(parts.back() == "bodies" ? 2 * 3 : 5, dim));
      }
  CHECK(parts == std::vector<std::string>{"bodies", "fluid", "bodies", "fluid", "bodies", "fluid"});
  CHECK(times == std::vector<double>{0, 0, 0.5, 0.5, 1, 1});
}


TEST_CASE("xdmf: every time lists both parts, whose arrays exist", "[solution][mpi]")
{
  TemporaryFolder      folder;
  const SampleScene<3> scene(MPI_COMM_WORLD);
  run_output(scene, "xdmf", folder.path);
  const auto   xdmf    = read_xml(folder.path / "solution.xdmf");
  unsigned int n_times = 0, n_arrays = 0;
  for (const auto &time : xdmf.get_child("Xdmf.Domain.Grid"))
    if (time.first == "Grid")
      {
        CHECK(time.second.get<double>("Time.<xmlattr>.Value") == 0.5 * n_times);
        ++n_times;
        std::vector<std::string> names;
        for (const auto &part : time.second)
          if (part.first == "Grid")
            names.push_back(part.second.get<std::string>("<xmlattr>.Name"));
        CHECK(names == std::vector<std::string>{"bodies", "fluid"});
        for (const auto &part : time.second)
          if (part.first == "Grid")
            for (const auto &attribute : part.second)
              if (attribute.first == "Attribute")
                {
                  auto text = attribute.second.get<std::string>("DataItem");
                  text.erase(std::remove_if(text.begin(), text.end(), ::isspace), text.end());
                  const auto       colon = text.find(':');
                  const HDF5Reader file(folder.path / text.substr(0, colon), MPI_COMM_WORLD);
                  CHECK(file.contains(text.substr(colon + 2)));
                  ++n_arrays;
                }
      }
  CHECK(n_times == 3);
  CHECK(n_arrays == n_times * (5 + 5));
}


TEST_CASE("xdmf: all may belong to one rank", "[solution][mpi]")
{
  const TemporaryFolder folder;
  Patches<2>            patches;
  patches.components = {"height"};
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      dealii::DataOutBase::Patch<2> patch;
      for (unsigned int k = 0; k < 4; ++k)
        patch.vertices[k] = dealii::Point<2>(k % 2, k / 2);
      patch.reference_cell = dealii::ReferenceCells::Quadrilateral;
      patch.data.reinit(1, 4);
      patches.patches.push_back(patch);
    }
  const auto path = folder.path / "one_cell.h5";
  write_hdf5(MPI_COMM_WORLD, path, "one_cell.h5", patches, 0);
  CHECK(HDF5Reader(path, MPI_COMM_WORLD).contains("height"));
  CHECK(fs::file_size(path) < 100000);
}


TEST_CASE("bodies are drawn at rest or where they are", "[solution][mpi]")
{
  const SampleScene<2> scene(MPI_COMM_WORLD);
  const auto           state = scene.linear_state();
  const auto           rest  = body_patches(*scene.models.solid, state.solid, Configuration::rest);
  const auto deformed = body_patches(*scene.models.solid, state.solid, Configuration::deformed);
  REQUIRE(rest.patches.size() == deformed.patches.size());
  for (unsigned int p = 0; p < rest.patches.size(); ++p)
    {
      CHECK(!rest.patches[p].points_are_available);
      const auto &patch = deformed.patches[p];
      REQUIRE(patch.points_are_available);
      // Corner 0 of a patch is its point 0, the last corner its last point.
      for (const auto &[vertex, point] :
           {std::make_pair(0u, 0u), std::make_pair(3u, unsigned(patch.data.n_cols()) - 1)})
        for (unsigned int axis = 0; axis < 2; ++axis)
          CHECK(
            patch.data(patch.data.n_rows() - 2 + axis, point) ==
            Approx(patch.vertices[vertex][axis] + linear_displacement(patch.vertices[vertex])[axis])
              .margin(1e-6));
    }
}


TEST_CASE("von Mises stress of a bar that is pulled is its tension", "[solution]")
{
  const auto bodies =
    read_bodies<3>(options_of("subsection Bodies\n subsection bar\n set Density = 1\n"
                              "  set Material = linear elastic\n  set Young's modulus = 1e6\n"
                              "  set Poisson's ratio = 0.3\n end\nend\n")
                     .section("Bodies"));
  dealii::Tensor<2, 3> H;
  H[0][0] = 1e-6;
  H[1][1] = H[2][2] = -0.3e-6;
  CHECK(von_mises_stress(bodies[0], H) == Approx(1).epsilon(1e-4));
  // A uniform pressure has none.
  H[0][0] = H[1][1] = H[2][2] = 1e-6;
  CHECK(von_mises_stress(bodies[0], H) < 1e-6);
}
