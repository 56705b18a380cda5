// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/fluid_geometry.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A unit box of fluid around a block whose lower sides lie `off` [m] below planes of the grid,
  /// its upper ones as far above, and which all ranks cut.
  template <int dim>
  CoupledRun<dim>
  around_block(const double off)
  {
    return CoupledRun<dim>(
      steps_of(.1) + section("Domain", "set Cells = " + plane_or_space<dim>("8, 8", "8, 8, 8")) +
      section("Fluid", "set Density = 1000") +
      section("Obstacles",
              section("block",
                      fmt::format(plane_or_space<dim>("set Lower corner = {0}, {0}\nset Upper "
                                                      "corner = {1}, {1}",
                                                      "set Lower corner = {0}, {0}, {0}\n"
                                                      "set Upper corner = {1}, {1}, {1}"),
                                  .25 - off,
                                  .75 + off))));
  }


  /// The sum of the volumes that move with the faces normal to an axis, of all ranks [m^dim].
  template <int dim>
  double
  volume_with_faces(const FluidGeometry<dim> &geometry,
                    const MacGrid<dim>       &grid,
                    const unsigned int        axis)
  {
    const auto &open  = *geometry.bodies().topology;
    const auto &faces = open.faces[axis];
    double      sum   = 0;
    for_each(grid.faces(axis)->owned(), [&](const GridIndex<dim> &face) {
      if (faces.kind(face) == SubLattice<dim>::Kind::whole)
        sum += grid.face_area(axis, face) * grid.dual_width(axis, face[axis]);
      for (int k = faces.first(face); k < faces.last(face); ++k)
        sum += open.pieces[axis][k].volume;
    });
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }


  template <int dim>
  void
  check(const double off)
  {
    INFO(dim << "D, " << off);
    const auto         run = around_block<dim>(off);
    FluidGeometry<dim> geometry(run.models);
    const auto         places = run.models.surface->positions(run.state.solid, 0);
    geometry.place(places, places, std::vector<dealii::Tensor<1, dim>>(places.size()));
    for (unsigned int axis = 0; axis < dim; ++axis)
      CHECK(volume_with_faces(geometry, run.models.fluid->grid(), axis) ==
            Approx(1 - std::pow(.5 + 2 * off, dim)).epsilon(1e-12));
  }
} // namespace


TEST_CASE("All of the fluid moves with faces, next to planes and ranks, too", "[obstacles][mpi]")
{
  for (const double off : {-1e-4, 0., 1e-4, .03})
    {
      check<2>(off);
      check<3>(off);
    }
}
