// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <surface/ball_and_sheet.h>

#include <set>

using namespace undine_tests;

namespace
{
  /// Facets kept by cells against the tree of all facets.
  template <int dim>
  void
  compare_sight(const BallAndSheet<dim> &scene)
  {
    Random random(3 + scene.rank());
    int    hidden = 0, wrong = 0;
    for (const double reach : {.2, 1., 4.})
      for (int number = 0; number < 2000; ++number)
        {
          const auto   from  = scene.known_place(random, 1);
          const auto   to    = from + random_point<dim>(random, reach);
          const double exact = scene.queries.first_hit(from, to);
          const auto  &near  = scene.vicinity;
          const auto   begin = near.place(from), end = near.place(to);
          hidden += exact <= 1;
          wrong += near.is_hidden(begin, end) != (exact <= 1);
          const double found = near.first_hit(begin, end);
          wrong += exact <= 1 ? std::abs(found - exact) > 1e-12 : found <= 1;
        }
    CHECK(wrong == 0);
    CHECK(dealii::Utilities::MPI::sum(hidden, MPI_COMM_WORLD) > 100);
  }


  /// Is a cell whole, before and now? By its volumes.
  template <int dim>
  bool
  is_whole(const BallAndSheet<dim> &scene, const GridIndex<dim> &cell)
  {
    const auto whole = [&](const Immersed<dim> &immersed) {
      return immersed.open().cells.kind(cell) == SubLattice<dim>::Kind::whole;
    };
    return whole(scene.before) && whole(scene.after);
  }


  /// What is said to be clear holds whole cells only.
  template <int dim>
  void
  check_clear_boxes(const BallAndSheet<dim> &scene)
  {
    Random     random(5);
    const auto owned = scene.grid().cells()->owned();
    int        clear = 0, wrong = 0;
    for (int number = 0; number < 3000; ++number)
      {
        IndexBox<dim>  box;
        GridIndex<dim> begin, end;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const int n = owned.upper[d] - owned.lower[d];
            begin[d]    = owned.lower[d] + random.below(n);
            end[d] = std::clamp(begin[d] + random.below(5) - 2, owned.lower[d], owned.upper[d] - 1);
            box.lower[d] = std::min(begin[d], end[d]);
            box.upper[d] = std::max(begin[d], end[d]) + 1;
          }
        bool whole = true;
        for_each(box, [&](const GridIndex<dim> &cell) { whole = whole && is_whole(scene, cell); });
        const bool found = scene.vicinity.is_clear(begin, end);
        clear += found;
        wrong += found && !whole;
      }
    CHECK(wrong == 0);
    CHECK(dealii::Utilities::MPI::sum(clear, MPI_COMM_WORLD) > 300);
  }


  /// Of the points of a lattice around a place, how many are closed, cannot be seen from there or
  /// were swept.
  template <int dim>
  int
  lost_points(const BallAndSheet<dim>  &scene,
              const Lattice<dim>       &lattice,
              const SubLattice<dim>    &parts,
              const dealii::Point<dim> &place)
  {
    const auto     known = known_points(lattice);
    GridIndex<dim> lower;
    for (unsigned int d = 0; d < dim; ++d)
      lower[d] = lattice.row(d).locate(place[d]).lower;
    int  lost  = 0;
    auto upper = lower;
    for (int &index : upper.values)
      index += 2;
    for_each(IndexBox<dim>{lower, upper}, [&](const GridIndex<dim> &index) {
      const auto point = lattice.point(index);
      lost += scene.queries.first_hit(place, point) <= 1 ||
              scene.queries.is_freshly_cleared(point) ||
              (known.contains(index) && parts.kind(index) == SubLattice<dim>::Kind::closed);
    });
    return lost;
  }


  /// Far from bodies nothing is met; next to none the points of all lattices are seen.
  template <int dim>
  void
  check_distances(const BallAndSheet<dim> &scene)
  {
    const auto &open = *scene.after.parts.open;
    Random      random(11 + scene.rank());
    int         far = 0, apart = 0, wrong = 0;
    for (int number = 0; number < 5000; ++number)
      {
        const auto from = scene.known_place(random, 0), to = from + random_point<dim>(random, .8);
        const auto begin = scene.vicinity.place(from), end = scene.vicinity.place(to);
        if (!scene.vicinity.is_near(begin, end))
          {
            ++far;
            // Cells are at least 0.42 wide.
            const auto beside = from + random_point<dim>(random, 3 * .42 / std::sqrt(dim));
            wrong += scene.queries.first_hit(from, to) <= 1;
            wrong += scene.queries.first_hit(from, beside) <= 1;
          }
        if (!scene.vicinity.is_next_to_body(begin))
          {
            ++apart;
            wrong += lost_points(scene, *scene.grid().cells(), open.cells, from);
            for (unsigned int axis = 0; axis < dim; ++axis)
              wrong += lost_points(scene, *scene.grid().faces(axis), open.faces[axis], from);
          }
      }
    CHECK(wrong == 0);
    CHECK(dealii::Utilities::MPI::sum(far, MPI_COMM_WORLD) > 100);
    CHECK(dealii::Utilities::MPI::sum(apart, MPI_COMM_WORLD) >
          dealii::Utilities::MPI::sum(far, MPI_COMM_WORLD));
  }


  /// The points of a lattice that were swept, one by one and by facets.
  template <int dim>
  void
  compare_swept(const BallAndSheet<dim> &scene, const Lattice<dim> &lattice)
  {
    const auto    box = lattice.with_ghosts(scene.rank(), scene.width);
    std::set<int> found;
    scene.queries.for_each_freshly_cleared(lattice, box, [&](const GridIndex<dim> &index) {
      REQUIRE(box.contains(index));
      found.insert(box.position(index));
    });
    unsigned int wrong = 0;
    for_each(box, [&](const GridIndex<dim> &index) {
      const bool listed = found.count(box.position(index)) > 0;
      wrong += listed != scene.queries.is_freshly_cleared(lattice.point(index));
    });
    CHECK(wrong == 0);
    CHECK(dealii::Utilities::MPI::sum(found.size(), MPI_COMM_WORLD) > 4);
  }


  /// The facets of a box have all that ways in it meet, and ways beside their slab meet none.
  template <int dim>
  void
  compare_boxes(const BallAndSheet<dim> &scene)
  {
    Random random(13 + scene.rank());
    int    hits = 0, open = 0, wrong = 0;
    for (int number = 0; number < 500; ++number)
      {
        const auto               lower  = scene.known_place(random, 0);
        const dealii::Point<dim> upper  = lower + (all_equal<dim>(.6) - dealii::Point<dim>());
        const auto               images = scene.queries.facets_near(std::make_pair(lower, upper));
        const auto               slab   = scene.queries.patch(images).slab;
        for (int path = 0; path < 20; ++path)
          {
            dealii::Point<dim> from, to;
            for (unsigned int d = 0; d < dim; ++d)
              {
                from[d] = random.between(lower[d], upper[d]);
                to[d]   = random.between(lower[d], upper[d]);
              }
            double first = std::numeric_limits<double>::infinity();
            for (const auto &image : images)
              first = std::min(first, scene.queries.first_hit(image, from, to));
            const double exact = scene.queries.first_hit(from, to);
            wrong += exact <= 1 ? std::abs(first - exact) > 1e-12 : first <= 1;
            hits += exact <= 1;
            if (!images.empty() && slab.leaves_open(from, to))
              {
                ++open;
                wrong += exact <= 1;
              }
          }
      }
    CHECK(wrong == 0);
    CHECK(dealii::Utilities::MPI::sum(hits, MPI_COMM_WORLD) > 50);
    CHECK(dealii::Utilities::MPI::sum(open, MPI_COMM_WORLD) > 50);
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("The cells around bodies", "[interface][mpi]", ((int dim), dim), 2, 3)
{
  for (const bool periodic : {false, true})
    {
      INFO("periodic: " << periodic);
      const BallAndSheet<dim> scene(periodic_axes<dim>(periodic));
      compare_sight(scene);
      check_clear_boxes(scene);
      check_distances(scene);
      compare_boxes(scene);
      compare_swept(scene, *scene.grid().cells());
      for (unsigned int axis = 0; axis < dim; ++axis)
        compare_swept(scene, *scene.grid().faces(axis));
    }
}


TEST_CASE("Without bodies no place is near one", "[interface]")
{
  const BodyVicinity<2> vicinity{};
  const auto            here = vicinity.place({0, 0}), there = vicinity.place({1, 1});
  CHECK_FALSE(vicinity.is_near(here, there));
  CHECK_FALSE(vicinity.is_next_to_body(here));
  CHECK_FALSE(vicinity.is_hidden(here, there));
  CHECK(vicinity.first_hit(here, there) > 1);
  CHECK(vicinity.is_clear({}, {}));
}
