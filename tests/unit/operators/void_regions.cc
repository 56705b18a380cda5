// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/void_regions.h>
#include <undine/surface/immersed_surface.h>
#include <undine/surface/surface_queries.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <fluid/fluid_scene.h>
#include <operators/immersed.h>

using namespace undine_tests;
using Catch::Matchers::Contains;

namespace
{
  /// A unit box with plates across it; everything that a step does to find what is void.
  struct Plates
  {
    Plates(const std::string &obstacles,
           const std::string &voids,
           const std::string &boundaries = "")
      : scene(read_scene_text(section("Domain", "set Cells = 8, 8") +
                              section("Fluid",
                                      "set Density = 1\n" + section("Void regions", voids) +
                                        section("Boundaries", boundaries)) +
                              section("Obstacles", obstacles)))
      , model(scene, MPI_COMM_WORLD)
      , surface(scene, nullptr, model.grid())
      , void_regions(scene, model.grid(), model.boundaries())
      , cut(block_of_rank(model.grid()))
    {
    }

    void
    find(const double time)
    {
      const auto              positions = surface.positions({}, time);
      const SurfaceQueries<2> queries(
        model.grid(), {&surface.surface(), positions, positions, surface.velocities({}, time, 1)});
      cut_block(cut, work, {surface.surface(), positions}, model.grid().cells()->blocks());
      const auto all = make_cut_topology(model.grid(), cut);
      voids          = void_regions.find(cut, all, queries, voids);
      parts          = make_cut_topology(model.grid(), cut, voids);
    }

    double
    open_volume() const
    {
      double      sum   = 0;
      const auto &cells = parts.open->cells;
      for_each(model.grid().cells()->owned(), [&](const GridIndex<2> &cell) {
        if (cells.kind(cell) == SubLattice<2>::Kind::whole)
          sum += model.grid().cell_volume(cell);
        for (int k = cells.first(cell); k < cells.last(cell); ++k)
          sum += cells.all()[k].measure;
      });
      return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
    }

    Options            scene;
    FluidModel<2>      model;
    ImmersedSurface<2> surface;
    VoidRegions<2>     void_regions;
    CutCells<2>        cut;
    CutWorkspace<2>    work;
    VoidMask           voids;
    CutTopology<2>     parts;
  };


  std::string
  plate(const std::string &name,
        const double       lower,
        const double       upper,
        const std::string &more = "")
  {
    return section(
      name,
      fmt::format("set Lower corner = -1, {}\nset Upper corner = 2, {}\n", lower, upper) + more);
  }


  std::string
  seed(const std::string &name, const std::string &where, const std::string &pressure = "0")
  {
    return section(name, "set Seed = " + where + "\nset Pressure = " + pressure);
  }


  const std::string gap = "set Displacement = if(t < 0.5, 0, 1.2); 0";


  std::string
  complaint(const std::string &obstacles,
            const std::string &voids,
            const std::string &boundaries = "",
            const double       time       = 0)
  {
    return message_of([&] {
      Plates plates(obstacles, voids, boundaries);
      plates.find(0);
      if (time > 0)
        plates.find(time);
    });
  }


  template <int dim>
  void
  compare_regions(const std::string &name)
  {
    for (int number = 0; number < 5; ++number)
      {
        INFO(dim << "D " << name << ' ' << number);
        Random                     random(number);
        auto                       bodies    = bodies_of_kind<dim>(name, random);
        const auto                 stretched = make_planes(bodies, Grid::graded, random);
        const Immersed<dim>        immersed(stretched.planes, bodies.surface(), bodies.nodes);
        const PressureNumbers<dim> numbers(immersed.grid, immersed.parts.open);
        const FluidRegions<dim>    regions(immersed.grid, numbers);

        std::vector<double> volumes(regions.size(), 0.);
        Field<dim>          field(immersed.grid.cells(), immersed.parts.open);
        std::size_t         next  = 0;
        const auto         &cells = immersed.open().cells;
        for_each(field.owned(), [&](const GridIndex<dim> &cell) {
          if (cells.kind(cell) == SubLattice<dim>::Kind::whole)
            volumes[regions.of_pressures()[next++]] += immersed.grid.cell_volume(cell);
        });
        for (unsigned int k = 0; k < cells.all().size(); ++k)
          if (cells.owns(k))
            volumes[regions.of_pressures()[next++]] += cells.all()[k].measure;
        dealii::Utilities::MPI::sum(volumes, MPI_COMM_WORLD, volumes);
        std::sort(volumes.begin(), volumes.end());
        const auto exact =
          fluid_regions(cut_all<dim>(stretched.planes, bodies.surface(), bodies.nodes), 0);
        REQUIRE(volumes.size() == exact.size());
        for (unsigned int k = 0; k < exact.size(); ++k)
          CHECK(volumes[k] == Approx(exact[k]).epsilon(1e-12));
      }
  }
} // namespace


TEST_CASE("Shells enclose regions of their own", "[interface][mpi]")
{
  for (const auto &name : {"shells", "nested bodies", "parallel sheets", "ball"})
    {
      compare_regions<2>(name);
      compare_regions<3>(name);
    }
}


TEST_CASE("Behind a plate there is nothing but pressure", "[interface][mpi]")
{
  for (const double thickness : {.1, 1e-6, .125})
    for (const double lower : {.55, .5})
      {
        INFO(thickness << " from " << lower);
        Plates plates(plate("plate", lower, lower + thickness),
                      seed("air", ".3, " + std::to_string(lower + thickness + .1), "7 + t"));
        plates.find(0);
        CHECK(plates.open_volume() == Approx(lower).epsilon(1e-13));

        // No component, piece or open cell is left above.
        const auto &open = *plates.parts.open;
        for (const auto &component : open.cells.all())
          CHECK(component.place[1] <= lower);
        for (unsigned int axis = 0; axis < 2; ++axis)
          {
            for (unsigned int k = 0; k < open.pieces[axis].size(); ++k)
              {
                CHECK(open.faces[axis].all()[k].place[1] <= lower);
                if (open.faces[axis].owns(k))
                  for (const int c : open.pieces[axis][k].components)
                    CHECK(c < static_cast<int>(open.cells.all().size()));
              }
            const auto &faces = *plates.model.grid().faces(axis);
            for_each(faces.owned(), [&](const GridIndex<2> &face) {
              if (faces.point(face)[1] > lower + thickness + .125)
                CHECK((open.faces[axis].kind(face) == SubLattice<2>::Kind::closed ||
                       open.faces[axis].first(face) == open.faces[axis].last(face)));
            });
          }

        // The air's pressure acts on the plate's upper side, whose length in the domain is 1.
        const auto           &surface = plates.surface.surface();
        const BoundaryFlux<2> flux(plates.cut, surface);
        dealii::Tensor<1, 2>  force;
        for (const auto &nodal :
             nodal_forces(flux, plates.void_regions.pressures(plates.voids, 2), MPI_COMM_WORLD))
          force += nodal;
        CHECK(force[0] == Approx(0).margin(1e-13));
        CHECK(force[1] == Approx(-9).epsilon(1e-13));
      }
}


TEST_CASE("Void regions follow bodies that move", "[interface][mpi]")
{
  Plates plates(plate("plate", .5, .55, "set Displacement = 0; -t") + plate("floor", -1, .11),
                seed("air", ".3, .6"));
  for (const double time : {0., .03, .1, .2, .3})
    {
      plates.find(time);
      CHECK(plates.open_volume() == Approx(.5 - time - .11).epsilon(1e-12));
    }
}


TEST_CASE("Void regions that join fluid are errors", "[interface][mpi]")
{
  const std::string outflow =
    boundary("out", "top", "outflow") + boundary("in", "bottom", "inflow", "set Velocity = 0; 0");
  CHECK(complaint(plate("plate", .5, .6), seed("air", ".3, .8")) == "no error");
  CHECK_THAT(complaint("", seed("air", ".3, .8")),
             Contains("'air'") && Contains("no fluid left") && Contains("reach through it"));
  CHECK_THAT(complaint(plate("plate", .5, .6), seed("air", ".3, .8"), outflow),
             Contains("'air'") && Contains("boundary 'out'"));
  CHECK_THAT(complaint(plate("plate", .5, .6), seed("air", ".3, .1"), outflow),
             Contains("'air'") && Contains("boundary 'in'"));
  CHECK_THAT(complaint(plate("plate", .5, .6), seed("air", ".3, .1") + seed("gas", ".3, .2")),
             Contains("'air'") && Contains("'gas'"));
  CHECK_THAT(complaint(plate("plate", .5, .6), seed("air", ".3, .55")), Contains("lies in a body"));
  CHECK_THAT(complaint(plate("plate", .5, .6), seed("air", "3, .55")),
             Contains("Fluid/Void regions/air") && Contains("outside the domain"));
  // A plate moves aside: now the void holds cells that were fluid.
  const auto two_plates = plate("low", .2, .3) + plate("plate", .5, .6, gap);
  CHECK(complaint(two_plates, seed("air", ".3, .8"), "", .4) == "no error");
  CHECK_THAT(complaint(two_plates, seed("air", ".3, .8"), "", .6),
             Contains("'air'") && Contains("has joined the fluid"));
}
