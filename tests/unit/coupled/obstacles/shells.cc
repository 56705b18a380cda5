// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

#include <filesystem>

using namespace undine_tests;

namespace
{
  constexpr unsigned int n_segments   = 48;
  constexpr double       shell_radius = .21;

  // Thicker than the shell's facets differ from arcs.
  template <int dim>
  constexpr double shell_thickness = dim == 2 ? 2e-3 : 1e-2;

  // All of the shell's inner side is nearer, all of the outer one farther from the centre.
  template <int dim>
  constexpr double middle = dim == 2 ? .2111 : .2134;

  /// A file of Gmsh that lives as long as this.
  class MeshFile
  {
  public:
    MeshFile()
      : name(
          (std::filesystem::temp_directory_path() / fmt::format("shell_{}.msh", getpid())).string())
    {
    }

    ~MeshFile()
    {
      std::remove(name.c_str());
    }

    template <int dim>
    void
    write(const std::vector<dealii::Point<dim>>        &nodes,
          const std::vector<std::vector<unsigned int>> &cells) const
    {
      std::ofstream out(name);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << nodes.size() << '\n';
      for (unsigned int n = 0; n < nodes.size(); ++n)
        out << fmt::format("{} {:.17g} {:.17g} {:.17g}\n",
                           n + 1,
                           nodes[n][0],
                           nodes[n][1],
                           dim == 3 ? nodes[n][dim - 1] : 0.);
      out << "$EndNodes\n$Elements\n" << cells.size() << '\n';
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          out << c + 1 << (dim == 2 ? " 3" : " 5") << " 2 1 1";
          for (const unsigned int node : cells[c])
            out << ' ' << node + 1;
          out << '\n';
        }
      out << "$EndElements\n";
    }

    const std::string name;
  };


  /// A thin ring about the origin.
  void
  write_shell(const MeshFile &file, std::integral_constant<int, 2>)
  {
    std::vector<dealii::Point<2>>          nodes;
    std::vector<std::vector<unsigned int>> cells;
    for (unsigned int k = 0; k < n_segments; ++k)
      {
        const double angle = 2 * M_PI * (k + .3) / n_segments;
        for (const double r : {shell_radius, shell_radius + shell_thickness<2>})
          nodes.emplace_back(r * std::cos(angle), r * std::sin(angle));
        const unsigned int next = (k + 1) % n_segments;
        cells.push_back({2 * k, 2 * k + 1, 2 * next + 1, 2 * next});
      }
    file.write(nodes, cells);
  }


  /// A hollow cube about the origin, bulged to a sphere.
  void
  write_shell(const MeshFile &file, std::integral_constant<int, 3>)
  {
    constexpr int                          n = 6;
    std::map<std::array<int, 4>, unsigned> numbers;
    std::vector<dealii::Point<3>>          nodes;
    std::vector<std::vector<unsigned int>> cells;
    const auto node = [&](const std::array<int, 3> &at, const int layer) {
      const auto found =
        numbers.emplace(std::array<int, 4>{{at[0], at[1], at[2], layer}}, nodes.size());
      if (found.second)
        {
          dealii::Point<3> x;
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = std::tan(M_PI / 4 * (2. * at[d] / n - 1));
          nodes.emplace_back((shell_radius + layer * shell_thickness<3>) / x.norm() * x);
        }
      return found.first->second;
    };
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (const int end : {0, n})
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            {
              const unsigned int        a = (axis + 1) % 3, b = (axis + 2) % 3;
              std::vector<unsigned int> cell;
              for (const int layer : {0, 1})
                for (const auto &corner : {std::array<int, 2>{{0, 0}},
                                           std::array<int, 2>{{1, 0}},
                                           std::array<int, 2>{{1, 1}},
                                           std::array<int, 2>{{0, 1}}})
                  {
                    std::array<int, 3> at{};
                    at[axis] = end;
                    at[a]    = i + corner[end == 0 ? 1 : 0];
                    at[b]    = j + corner[end == 0 ? 0 : 1];
                    cell.push_back(node(at, layer));
                  }
              cells.push_back(cell);
            }
    file.write(nodes, cells);
  }


  template <int dim>
  dealii::Point<dim>
  centre_at(const double time, const double speed)
  {
    dealii::Point<dim> centre;
    for (unsigned int d = 0; d < dim; ++d)
      centre[d] = .5 + .01 * d;
    centre[0] += speed * time;
    return centre;
  }


  /// Fluid of the speed of the shell and smoke in it; a stream of other fluid outside.
  template <int dim>
  ObstacleRun<dim>
  shell_in_stream(const std::string &file, const double shell_speed, const std::string &method)
  {
    const std::string inside =
      fmt::format(plane_or_space<dim>("(x-.5)^2 + (y-.51)^2 < {0}^2",
                                      "(x-.5)^2 + (y-.51)^2 + (z-.52)^2 < {0}^2"),
                  middle<dim>);
    const std::string map  = plane_or_space<dim>("x+.5; y+.51", "x+.5; y+.51; z+.52");
    const std::string zero = plane_or_space<dim>("; 0", "; 0; 0");
    return ObstacleRun<dim>(
      section("Domain",
              plane_or_space<dim>("set Upper corner = 1.5, 1\nset Cells = 39, 26",
                                  "set Upper corner = 1.5, 1, 1\nset Cells = 24, 16, 16")) +
        section("Fluid",
                "set Density = 1\nset Initial velocity = " +
                  fmt::format("if({}, {}, 1){}\n", inside, shell_speed, zero) +
                  section("Pressure solver", "set Divergence tolerance = 1e-13") +
                  section("Boundaries",
                          boundary("in", "left", "inflow", "set Velocity = 1" + zero) +
                            boundary("out", "right", "outflow"))),
      obstacle(
        "shell",
        "gmsh",
        "set File = " + file + "\nset Map = " + map +
          "\nset Refinements = 0\nset Displacement = " + fmt::format("{}*t{}", shell_speed, zero)),
      convection_by(method) +
        section(
          "scalar transport",
          (method == "flux" ? "set Form = flux\n" : "set Method = " + method + "\n") +
            section("smoke", "set Initial value = if(" + inside + ", 1, 0)") +
            section("clean", "set Initial value = if(" + inside + ", 0, 1)\nset Inflow value = 1")),
      .02);
  }


  template <int dim>
  void
  check_shell(const double shell_speed, const std::string &method)
  {
    MeshFile file;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      write_shell(file, std::integral_constant<int, dim>());
    MPI_Barrier(MPI_COMM_WORLD);
    auto run = shell_in_stream<dim>(
      dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, file.name), shell_speed, method);
    const auto is_inside = [&](const dealii::Point<dim> &place) {
      return place.distance(centre_at<dim>(run.state.clock.time - run.dt, shell_speed)) <
             middle<dim>;
    };
    double most_disturbed = 0;
    for (unsigned int n = 0; n < 15; ++n)
      {
        run.step();
        REQUIRE(run.column("Flagged cells") == 0);
        const double disturbed = largest_on_faces(
          run.state.fluid.velocity,
          [&](const double value, const auto &place, const unsigned int axis) {
            return is_inside(place) ? std::abs(value - (axis == 0 ? shell_speed : 0)) : 0.;
          });
        most_disturbed = std::max(most_disturbed, disturbed);
        for (const bool smoke : {true, false})
          REQUIRE(largest_in_cells(run.state.fluid.scalars.at(smoke ? "smoke" : "clean"),
                                   [&](const double value, const auto &place) {
                                     return std::abs(value - (is_inside(place) == smoke ? 1 : 0));
                                   }) <= 1e-14);
      }
    // Every velocity in the shell is a flux that the shell did not stop.
    INFO(fmt::format("velocity in the shell {:.1e}", most_disturbed));
    // In flux form to the tolerance of its linear system.
    CHECK(most_disturbed <= (method == "flux" ? 1e-10 : shell_speed == 0 ? 1e-15 : 1e-12));
    CHECK(run.column("Fluid largest speed") > 1.05);
  }
} // namespace


namespace
{
  /// Neither the fluid inside nor that outside, in a domain without outlet, can yield.
  template <int dim>
  void
  check_turning_shell(const double angular_speed, const std::string &method)
  {
    MeshFile file;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      write_shell(file, std::integral_constant<int, dim>());
    MPI_Barrier(MPI_COMM_WORLD);
    ObstacleRun<dim> run(
      section("Domain",
              plane_or_space<dim>("set Lower corner = -.5, -.5\nset Upper corner = .5, .5\nset "
                                  "Cells = 21, 21",
                                  "set Lower corner = -.5, -.5, -.5\nset Upper corner = .5, .5, "
                                  ".5\nset Cells = 11, 11, 11")) +
        section("Fluid", "set Density = 1"),
      obstacle("shell",
               "gmsh",
               "set File = " + dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, file.name) +
                 "\nset Refinements = 0\nset Displacement = " +
                 fmt::format("(cos({0}*t)-1)*x - sin({0}*t)*y; sin({0}*t)*x + (cos({0}*t)-1)*y{1}",
                             angular_speed,
                             plane_or_space<dim>("", "; 0"))),
      convection_by(method),
      .05);
    for (unsigned int n = 0; n < 3; ++n)
      run.step();
    CHECK(run.column("Fluid divergence") <= 1e-10);
    CHECK(run.column("Fluid largest speed") < angular_speed);
  }
} // namespace


TEST_CASE("A closed shell turns in a closed domain", "[coupled][mpi]")
{
  for (const std::string method : {"cubic", "flux"})
    {
      check_turning_shell<2>(1, method);
      check_turning_shell<2>(9, method);
      check_turning_shell<3>(3, method);
    }
}


TEST_CASE("Nothing passes through a closed thin shell", "[coupled][mpi]")
{
  SECTION("2D, fixed")
  {
    for (const std::string method : {"semi-Lagrangian", "MacCormack", "cubic", "flux"})
      check_shell<2>(0, method);
  }
  SECTION("2D, moving against the stream")
  {
    for (const std::string method : {"cubic", "flux"})
      check_shell<2>(-.2, method);
  }
  SECTION("2D, moving with the stream")
  {
    for (const std::string method : {"cubic", "flux"})
      check_shell<2>(.7, method);
  }
  SECTION("3D, fixed")
  {
    for (const std::string method : {"cubic", "flux"})
      check_shell<3>(0, method);
  }
  SECTION("3D, moving")
  {
    for (const std::string method : {"cubic", "flux"})
      check_shell<3>(.7, method);
  }
}
