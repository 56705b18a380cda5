// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>
#include <message_of.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  channel()
  {
    return stream_to_the_right<dim>(plane_or_space<dim>("16, 12", "10, 8, 7"), 2, 1);
  }


  template <int dim>
  std::string
  flush_box(const std::string &lower,
            const std::string &upper,
            const std::string &displacement = "0; 0")
  {
    return obstacle("box",
                    "box",
                    "set Lower corner = " + lower + plane_or_space<dim>("", ", 0") +
                      "\nset Upper corner = " + upper + plane_or_space<dim>("", ", .6") +
                      "\nset Displacement = " + displacement + plane_or_space<dim>("", "; 0"));
  }


  struct FlushResult
  {
    double force, speed, divergence;
  };


  template <int dim>
  FlushResult
  run_stream(const std::string &obstacles)
  {
    ObstacleRun<dim> run(channel<dim>(), obstacles, convection(), .02);
    for (unsigned int n = 0; n < 3; ++n)
      run.step();
    CHECK(run.column("Flagged cells") == 0);
    return {run.column("pressure force box x"),
            run.column("Fluid largest speed"),
            run.column("Fluid divergence")};
  }


  template <int dim>
  void
  check_steps()
  {
    const auto check = [](const FlushResult &flush, const FlushResult &beyond) {
      CHECK(flush.force == Approx(beyond.force).epsilon(1e-5));
      CHECK(flush.speed == Approx(beyond.speed).epsilon(1e-5));
      CHECK(flush.divergence <= 1e-10);
    };
    check(run_stream<dim>(flush_box<dim>(".31, 0", ".72, .3")),
          run_stream<dim>(flush_box<dim>(".31, -.5", ".72, .3")));
    check(run_stream<dim>(flush_box<dim>(".31, .64", ".72, 1")),
          run_stream<dim>(flush_box<dim>(".31, .64", ".72, 1.2")));
    // What covers a part of the inflow keeps that part from flowing in.
    check(run_stream<dim>(flush_box<dim>("0, 0", ".37, .3")),
          run_stream<dim>(flush_box<dim>("-1, -1", ".37, .3")));
  }


  template <int dim>
  void
  check_motion(const std::string &lower, const std::string &upper, const std::string &displacement)
  {
    INFO(dim << "D, " << displacement);
    ObstacleRun<dim> run(
      channel<dim>(), flush_box<dim>(lower, upper, displacement), convection(), .02);
    for (unsigned int n = 0; n < 4; ++n)
      {
        run.step();
        CHECK(run.column("Fluid divergence") <= 1e-10);
        CHECK(run.column("Fluid largest speed") < 10);
      }
  }


  /// Pressure's and friction's forces on a box with sides in planes of the grid, moved outwards by
  /// `fatter` and along all axes by `shift` [m], in a stream without inertia.
  template <int dim>
  std::array<dealii::Tensor<1, dim>, 2>
  forces_on_flush_box(const double fatter, const double shift, const unsigned int n_steps = 3)
  {
    const auto corner = [&](const std::array<double, 3> &place, const double move) {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += fmt::format("{}{:.17g}", d == 0 ? "" : ", ", place[d] + move + shift);
      return text;
    };
    ObstacleRun<dim> run(stream_to_the_right<dim>(plane_or_space<dim>("16, 12", "8, 8, 6"), 2, 1),
                         obstacle("box",
                                  "box",
                                  "set Lower corner = " + corner({{.25, .25, 1. / 3}}, -fatter) +
                                    "\nset Upper corner = " + corner({{.5, .75, 2. / 3}}, fatter)),
                         viscosity(.1),
                         .02);
    for (unsigned int n = 0; n < n_steps; ++n)
      run.step();
    return {{run.column_vector("pressure force box"), run.column_vector("viscous force box")}};
  }


  template <int dim>
  void
  check_hair()
  {
    const auto   flush = forces_on_flush_box<dim>(0, 0);
    const double hair  = 1e-6;
    for (const double fatter : {-hair, 0., hair})
      for (const double shift : {-hair, 0., hair})
        {
          const auto off = forces_on_flush_box<dim>(fatter, shift);
          for (unsigned int kind = 0; kind < 2; ++kind)
            {
              INFO(dim << "D, kind " << kind << ": " << flush[kind] << " and " << off[kind]);
              CHECK((off[kind] - flush[kind]).norm() <= 1e-4 * flush[kind].norm());
              // The stream is the same above and below.
              CHECK(std::abs(flush[kind][1]) <= 1e-6 * flush[kind].norm());
            }
        }
  }


  /// Off by a hundredth of a cell, with fluid between the sides and the planes, once the stream
  /// hardly changes any more.
  template <int dim>
  void
  check_leaving()
  {
    const auto flush = forces_on_flush_box<dim>(0, 0, 50),
               off   = forces_on_flush_box<dim>(0, 5e-4, 50);
    const auto force = flush[0] + flush[1], change = off[0] + off[1] - force;
    INFO(dim << "D: " << force << ", " << change);
    CHECK(change.norm() <= .035 * force.norm());
  }


  /// That along the stream on a box two or five cells wide of which sides, edges and corners go
  /// through a cell.
  template <int dim>
  double
  force_on_passing_box(const double shift)
  {
    const auto corner = [&](const double x, const double y) {
      const auto others = fmt::format(", {:.17g}", y + shift);
      return fmt::format("{:.17g}{}", x + shift, others) + (dim == 2 ? "" : others);
    };
    ObstacleRun<dim> run(
      section("Domain",
              plane_or_space<dim>("set Upper corner = 2, 1", "set Upper corner = 2, 1, 1")) +
        stream_to_the_right<dim>(plane_or_space<dim>("32, 16", "16, 8, 8"), 1, 1),
      obstacle("box",
               "box",
               "set Lower corner = " + corner(.55, .28) +
                 "\nset Upper corner = " + corner(.85, .65)),
      viscosity(.1),
      .03);
    for (unsigned int n = 0; n < 20; ++n)
      run.step();
    return run.column("pressure force box x") + run.column("viscous force box x");
  }


  template <int dim>
  void
  check_passing()
  {
    constexpr int n_places = 12;
    const double  width    = 1. / (dim == 2 ? 16 : 8);
    double        least = std::numeric_limits<double>::max(), most = 0;
    std::string   all;
    for (int k = 0; k < n_places; ++k)
      {
        const double force = force_on_passing_box<dim>(k * width / n_places);
        all += fmt::format(" {:.4f}", force);
        least = std::min(least, force);
        most  = std::max(most, force);
      }
    INFO(dim << "D:" << all);
    CHECK(most - least <= (dim == 2 ? .03 : .07) * most);
  }


  template <int dim>
  void
  check_filled()
  {
    const std::string size = plane_or_space<dim>("2, 2", "2, 2, 2");
    const auto        fill = [&] {
      ObstacleRun<dim>(channel<dim>(),
                       obstacle("box",
                                "box",
                                "set Centre = 0" + plane_or_space<dim>(", 0", ", 0, 0") +
                                  "\nset Size = 4, " + size.substr(3)),
                       convection(),
                       .02);
    };
    CHECK_THAT(message_of(fill), Catch::Contains("fill the domain"));
  }


  /// The cells of the left rank, if there are two, are all in the obstacle.
  template <int dim>
  void
  check_half_filled()
  {
    ObstacleRun<dim> run(
      channel<dim>(),
      obstacle("piston",
               "box",
               plane_or_space<dim>("set Lower corner = -1, -1\nset Upper corner = .65, 2\nset "
                                   "Displacement = .3*t; 0",
                                   "set Lower corner = -1, -1, -1\nset Upper corner = .65, 2, "
                                   "2\nset Displacement = .3*t; 0; 0")),
      convection(),
      .02);
    run.step();
    CHECK(run.column("Flux through out") == Approx(.3));
    CHECK(run.column("Fluid largest speed") == Approx(.3));
  }
} // namespace


TEST_CASE("An obstacle flush with a wall stands in a stream like one that reaches through it",
          "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_steps<2>();
  }
  SECTION("3D")
  {
    check_steps<3>();
  }
}


TEST_CASE("A side in a plane of the grid is felt like one a hair off", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_hair<2>();
  }
  SECTION("3D")
  {
    check_hair<3>();
  }
}


TEST_CASE("The force on a box is continuous as its sides leave planes of the grid",
          "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_leaving<2>();
  }
  SECTION("3D")
  {
    check_leaving<3>();
  }
}


TEST_CASE("The force on a box hardly changes as it goes through a cell askew", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_passing<2>();
  }
  SECTION("3D")
  {
    check_passing<3>();
  }
}


TEST_CASE("An obstacle slides along a wall, leaves it and comes back", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_motion<2>(".31, 0", ".6, .3", ".5*t; 0");
    check_motion<2>(".31, 0", ".6, .3", "0; .5*t");
    check_motion<2>(".31, .04", ".6, .3", "0; -.5*t");
  }
  SECTION("3D")
  {
    check_motion<3>(".31, 0", ".6, .3", ".5*t; .3*t");
  }
}


TEST_CASE("Obstacles that leave no fluid are refused, on a rank alone they may", "[coupled][mpi]")
{
  SECTION("Everywhere, 2D")
  {
    check_filled<2>();
  }
  SECTION("Everywhere, 3D")
  {
    check_filled<3>();
  }
  SECTION("Somewhere")
  {
    check_half_filled<2>();
    check_half_filled<3>();
  }
}
