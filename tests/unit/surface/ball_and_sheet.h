// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_surface_ball_and_sheet_h
#define undine_tests_surface_ball_and_sheet_h

#include <undine/fluid/visibility/body_vicinity.h>
#include <undine/surface/surface_queries.h>

#include <operators/immersed.h>
#include <surface/balls.h>

namespace undine_tests
{
  /// A ball that has moved by less than a cell, a thin sheet at rest, and a speck that leaves all
  /// faces of its cell whole, in cells of uneven sizes.
  template <int dim>
  class BallAndSheet
  {
  public:
    explicit BallAndSheet(const std::array<bool, dim> &periodic)
      : bodies(both())
      , before(planes(), bodies.surface(), bodies.nodes, periodic)
      , after(planes(), bodies.surface(), places_after(), periodic)
      , queries(after.grid,
                {&after.surface,
                 bodies.nodes,
                 after.positions,
                 std::vector<dealii::Tensor<1, dim>>(bodies.nodes.size())})
      , width(all_directions<dim>(3))
      , vicinity(after.grid, before.parts.open, after.parts.open, &queries, width)
    {
    }

    const MacGrid<dim> &
    grid() const
    {
      return after.grid;
    }

    /// A place in one of the cells of this rank, or within the layers around them.
    dealii::Point<dim>
    known_place(Random &random, const int layers) const
    {
      const auto         known = grid().cells()->with_ghosts(rank(), all_directions<dim>(layers));
      dealii::Point<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto &faces = grid().faces(d)->row(d);
          const int   first = grid().periodic(d) ? known.lower[d] : std::max(0, known.lower[d]);
          const int   last =
            grid().periodic(d) ? known.upper[d] : std::min(known.upper[d], grid().cells_along()[d]);
          result[d] = random.between(faces.position(first), faces.position(last));
        }
      return result;
    }

    /// A place within a cell or so of the speck; perhaps not one that is known.
    static dealii::Point<dim>
    place_at_speck(Random &random)
    {
      return all_equal<dim>(speck) + random_point<dim>(random, .6);
    }

    unsigned int
    rank() const
    {
      return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    }

    Bodies<dim>         bodies;
    Immersed<dim>       before, after;
    SurfaceQueries<dim> queries;
    GridIndex<dim>      width;
    BodyVicinity<dim>   vicinity;

  private:
    static constexpr double radius = 1.3, speck = 7.14;

    static typename MacGrid<dim>::Planes
    planes()
    {
      typename MacGrid<dim>::Planes result;
      for (auto &of_axis : result)
        for (int i = 0; i <= 16; ++i)
          of_axis.push_back(.5 * i + .2 * std::sin(2 * M_PI * i / 16));
      return result;
    }

    static Bodies<dim>
    both()
    {
      Random random(7);
      auto   result = ball<dim>(2, radius).shift(all_equal<dim>(2.6) - dealii::Point<dim>());
      auto   half   = all_equal<dim>(.9);
      half[dim - 1] = 1e-6;
      std::array<int, dim> cells;
      cells.fill(4);
      cells[dim - 1] = 1;
      result.append(box<dim>(-half, half, cells)
                      .rotate(random)
                      .shift(all_equal<dim>(5.7) - dealii::Point<dim>()));
      result.append(ball<dim>(1, .15).shift(all_equal<dim>(speck) - dealii::Point<dim>()));
      return result;
    }

    std::vector<dealii::Point<dim>>
    places_after() const
    {
      auto result = bodies.nodes;
      for (auto &x : result)
        if (x.distance(all_equal<dim>(2.6)) < 1.01 * radius)
          x += all_equal<dim>(.31) - dealii::Point<dim>();
      return result;
    }
  };


  template <int dim>
  std::array<bool, dim>
  periodic_axes(const bool periodic)
  {
    std::array<bool, dim> result{};
    result[0] = periodic;
    return result;
  }
} // namespace undine_tests

#endif
