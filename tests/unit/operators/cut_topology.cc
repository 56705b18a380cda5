// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/dual_volumes.h>

#include <catch2/catch.hpp>
#include <cutting/cut_checks.h>
#include <operators/immersed.h>

using namespace undine_tests;

namespace
{
  /// A component, the same on all ranks: its cell and its number there.
  template <int dim>
  struct Name
  {
    GridIndex<dim> cell;
    int            number;

    bool
    operator==(const Name &other) const
    {
      return cell == other.cell && number == other.number;
    }
  };


  /// Compare what a rank knows with the whole grid, cut at once.
  template <int dim>
  class Comparison
  {
  public:
    explicit Comparison(const Immersed<dim> &immersed, const typename MacGrid<dim>::Planes &planes)
      : immersed(immersed)
      , open(immersed.open())
      , grid(immersed.grid)
      , whole(cut_all<dim>(planes, immersed.surface, immersed.positions))
      , dual(dual_volumes(whole))
    {
      compare_cells();
      for (unsigned int axis = 0; axis < dim; ++axis)
        compare_faces(axis);
    }

    int differences = 0, cells = 0, pieces = 0, periodic_pieces = 0;

  private:
    using Kind = typename SubLattice<dim>::Kind;

    /// Call action(index) for the owned points and one layer around them.
    template <class Action>
    void
    for_each_known(const Lattice<dim> &lattice, const Action &action)
    {
      for_each(lattice.owned().grown(all_directions<dim>(1)), [&](const GridIndex<dim> &index) {
        for (unsigned int d = 0; d < dim; ++d)
          if (!lattice.row(d).periodic() && (index[d] < 0 || index[d] >= lattice.row(d).size()))
            return;
        action(index);
      });
    }

    void
    compare_cells()
    {
      for_each_known(*grid.cells(), [&](const GridIndex<dim> &index) {
        const auto cell  = grid.cells()->wrapped(index);
        const int  slot  = whole.cut_cell(cell);
        const auto kind  = slot >= 0              ? Kind::divided
                           : whole.in_solid(cell) ? Kind::closed
                                                  : Kind::whole;
        const int  first = open.cells.first(index), last = open.cells.last(index);
        const int n = slot >= 0 ? whole.end_component(slot) - whole.cells[slot].first_component : 0;
        differences += open.cells.kind(index) != kind || last - first != n;
        for (int k = first; k < last && n == last - first; ++k)
          {
            ++cells;
            const auto &part  = open.cells.all()[k];
            const auto &exact = whole.components[whole.cells[slot].first_component + k - first];
            differences += !(part.index == index) || part.measure != exact.volume;
            const auto shift = grid.cells()->point(index) - grid.cells()->point(cell);
            differences += part.place.distance(exact.centroid + shift) > 1e-13;
          }
      });
    }

    Name<dim>
    name(const int component) const
    {
      if (component < 0)
        return {{}, component};
      const auto &index = open.cells.all()[component].index;
      return {grid.cells()->wrapped(index), component - open.cells.first(index)};
    }

    Name<dim>
    name_in_whole(const int component) const
    {
      if (component < 0)
        return {{}, component};
      const auto &cell = whole.cells[whole.components[component].cell];
      return {cell.index, component - cell.first_component};
    }

    /// Whether a piece of a face joins, at one of its ends, what it should.
    bool
    joins(const int component, const GridIndex<dim> &cell, const int in_whole) const
    {
      bool known = true;
      for (unsigned int d = 0; d < dim; ++d)
        known = known && cell[d] >= grid.cells()->owned().lower[d] - 1 &&
                cell[d] <= grid.cells()->owned().upper[d];
      return known ? name(component) == name_in_whole(in_whole) : component == open.outside;
    }

    void
    compare_faces(const unsigned int axis)
    {
      const auto &lattice = *grid.faces(axis);
      const auto &faces   = open.faces[axis];
      for_each_known(lattice, [&](const GridIndex<dim> &index) {
        const auto face  = lattice.wrapped(index);
        const int  first = faces.first(index), last = faces.last(index);
        if (grid.periodic(axis) && face[axis] == 0)
          {
            auto opposite  = face;
            opposite[axis] = grid.cells_along()[axis];
            compare_periodic(
              axis, index, whole.cut_face(axis, face), whole.cut_face(axis, opposite));
            return;
          }
        const int slot = whole.cut_face(axis, face);
        const int n    = slot >= 0 ? whole.end_piece(slot) - whole.faces[slot].first_piece : 0;
        differences += (faces.kind(index) == Kind::divided) != (slot >= 0) || last - first != n;
        for (int k = first; k < last && n == last - first; ++k)
          {
            ++pieces;
            const int   p     = whole.faces[slot].first_piece + k - first;
            const auto &exact = whole.pieces[p];
            const auto &piece = open.pieces[axis][k];
            differences += faces.all()[k].measure != exact.area;
            const auto shift = lattice.point(index) - lattice.point(face);
            differences += faces.all()[k].place.distance(exact.centroid + shift) > 1e-13;
            differences += std::abs(piece.volume - dual.volumes[p]) > 1e-14;
            for (const int end : {0, 1})
              differences +=
                !joins(piece.components[end], moved(index, axis, end - 1), exact.components[end]);
          }
      });
    }

    /// `below` and `above`: numbers in whole.faces of the face at the lower and the upper side.
    void
    compare_periodic(const unsigned int    axis,
                     const GridIndex<dim> &index,
                     const int             lower,
                     const int             upper)
    {
      const auto &faces   = open.faces[axis];
      const bool  divided = lower >= 0 || upper >= 0;
      const int   first   = faces.first(index);
      differences += (faces.kind(index) == Kind::divided) != divided;
      differences += faces.last(index) - first != (divided ? 1 : 0);
      if (!divided || faces.last(index) == first)
        return;
      ++periodic_pieces;
      const auto &piece    = open.pieces[axis][first];
      double      volume   = 0;
      const int   slots[2] = {upper, lower};
      for (const int end : {0, 1})
        {
          const auto cell = moved(index, axis, end - 1);
          int        c    = whole.uncut;
          if (slots[end] >= 0)
            {
              const int p = whole.faces[slots[end]].first_piece;
              differences += whole.end_piece(slots[end]) != p + 1;
              c = whole.pieces[p].components[end];
              volume += dual.volumes[p];
            }
          else
            volume += grid.cell_volume(cell) / 2;
          differences += !joins(piece.components[end], cell, c);
        }
      differences += std::abs(piece.volume - volume) > 1e-14;
      differences += std::abs(faces.all()[first].measure - grid.face_area(axis, index)) > 1e-14;
    }

    const Immersed<dim>      &immersed;
    const FluidTopology<dim> &open;
    const MacGrid<dim>       &grid;
    const CutCells<dim>       whole;
    const DualVolumes<dim>    dual;
  };


  template <int dim>
  void
  compare_random(const std::string &name, const int count)
  {
    for (const Grid grid : {Grid::unit, Grid::graded})
      for (int number = 0; number < count; ++number)
        {
          INFO(dim << "D " << name << ' ' << number);
          Random                random(number);
          auto                  bodies    = bodies_of_kind<dim>(name, random);
          const auto            stretched = make_planes(bodies, grid, random);
          const Immersed<dim>   immersed(stretched.planes, bodies.surface(), bodies.nodes);
          const Comparison<dim> comparison(immersed, stretched.planes);
          CHECK(comparison.differences == 0);
          CHECK(dealii::Utilities::MPI::sum(comparison.cells, MPI_COMM_WORLD) > 0);
          CHECK(dealii::Utilities::MPI::sum(comparison.pieces, MPI_COMM_WORLD) > 0);
        }
  }


  /// Balls next to both ends of all axes.
  template <int dim>
  void
  compare_periodic_domain(const std::array<bool, dim> periodic)
  {
    auto bodies = ball<dim>(2, .8).shift(all_equal<dim>(.85));
    bodies.append(ball<dim>(2, .6).shift(all_equal<dim>(5.3)));
    bodies.append(
      ball<dim>(1, .6).shift(all_equal<dim>(.7) + 4.65 * dealii::Point<dim>::unit_vector(0)));
    typename MacGrid<dim>::Planes planes;
    for (unsigned int d = 0; d < dim; ++d)
      planes[d] = {0, 1, 2, 2.5, 3.5, 4.75, 6};
    const Immersed<dim>   immersed(planes, bodies.surface(), bodies.nodes, periodic);
    const Comparison<dim> comparison(immersed, planes);
    CHECK(comparison.differences == 0);
    CHECK(dealii::Utilities::MPI::sum(comparison.periodic_pieces, MPI_COMM_WORLD) > 0);
  }
} // namespace


TEST_CASE("Open parts in blocks are those of the whole grid", "[interface][mpi]")
{
  for (const auto &name : {"ball", "parallel sheets", "egg box", "touching boxes", "aligned box"})
    {
      compare_random<2>(name, 4);
      compare_random<3>(name, 2);
    }
}


TEST_CASE("Open parts across periodic sides", "[interface][mpi]")
{
  compare_periodic_domain<2>({{true, false}});
  compare_periodic_domain<2>({{false, true}});
  compare_periodic_domain<2>({{true, true}});
  compare_periodic_domain<3>({{true, false, false}});
  compare_periodic_domain<3>({{false, true, true}});
  compare_periodic_domain<3>({{true, true, true}});
}


TEST_CASE("All faces of divided cells are divided", "[interface][mpi]")
{
  auto              bodies = ball<3>(2, 1.7).shift(all_equal<3>(2.1));
  const Immersed<3> immersed({{{0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}}},
                             bodies.surface(),
                             bodies.nodes,
                             {{true, false, false}});
  const auto       &open = immersed.open();
  using Kind             = SubLattice<3>::Kind;
  int n                  = 0;
  for_each(immersed.grid.cells()->owned(), [&](const GridIndex<3> &cell) {
    if (open.cells.kind(cell) == Kind::divided)
      for (unsigned int axis = 0; axis < 3; ++axis)
        for (const int end : {0, 1})
          n += open.faces[axis].kind(moved(cell, axis, end)) != Kind::divided;
  });
  CHECK(n == 0);
}
