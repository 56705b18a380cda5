// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/uniform_regions.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

#include <algorithm>

using namespace undine_tests;

namespace
{
  /// Zero but for some points on the left, whose values go from 1e-3 to 1.
  template <int dim>
  double
  speckled(const GridIndex<dim> &index)
  {
    int sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      sum = 31 * sum + 17 * index[d] + 5;
    return index[0] < 5 && sum % 7 == 0 ? std::pow(10., -(std::abs(sum) % 4)) : 0;
  }


  /// By looking at all points around: none differs more from a neighbour.
  template <int dim>
  bool
  is_quiet(const Field<dim>     &field,
           const GridIndex<dim> &index,
           const GridIndex<dim> &reach,
           const double          most)
  {
    IndexBox<dim> box{index, index};
    for (unsigned int d = 0; d < dim; ++d)
      box.upper[d] += 1;
    bool       result = true;
    const auto around = box.grown(reach).intersection(field.stored());
    for_each(around, [&](const GridIndex<dim> &other) {
      for (unsigned int d = 0; d < dim; ++d)
        for (const int step : {-1, 1})
          if (const auto next = moved<dim>(other, d, step); field.stored().contains(next))
            result = result && std::abs(field(next) - field(other)) <= most;
    });
    return result;
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "places are quiet where all around is alike", "[fields][mpi]", ((int dim), dim), 2, 3)
{
  typename MacGrid<dim>::Planes planes;
  for (unsigned int d = 0; d < dim; ++d)
    for (int i = 0; i <= 17 + int(d); ++i)
      planes[d].push_back(i);
  std::array<bool, dim> periodic{};
  periodic[1] = true;
  const MacGrid<dim> grid(MPI_COMM_WORLD, planes, periodic);
  for (const int most : {1, 2, 3})
    for (const double share : {0., .05, .5})
      {
        Field<dim> field(grid.cells());
        for_each(field.owned(),
                 [&](const auto &index) { field(index) = 2 + speckled<dim>(index); });
        GridIndex<dim> reach;
        for (unsigned int d = 0; d < dim; ++d)
          reach[d] = most - (d == 1);
        field.exchange(reach);
        const UniformRegions<dim> quiet({field}, reach, share);
        unsigned int              wrong = 0, found = 0;
        int                       path = 0;
        for (unsigned int d = 0; d < dim; ++d)
          path += 2 * reach[d];
        for_each(field.owned(), [&](const auto &index) {
          wrong += quiet.contains(index) != is_quiet(field, index, reach, share / path);
          found += quiet.contains(index);
        });
        CHECK(wrong == 0);
        unsigned int in_uniform_runs = 0, in_other_runs = 0;
        quiet.for_each_uniform_run([&](GridIndex<dim> index, const int n) {
          in_uniform_runs += n;
          for (int i = 0; i < n; ++i, ++index[0])
            wrong += !quiet.contains(index);
        });
        quiet.for_each_other_run([&](GridIndex<dim> index, const int n) {
          in_other_runs += n;
          for (int i = 0; i < n; ++i, ++index[0])
            wrong += quiet.contains(index);
        });
        CHECK(in_uniform_runs == found);
        CHECK(in_other_runs == field.owned().size() - found);
        CHECK(wrong == 0);
        found = dealii::Utilities::MPI::sum(found, MPI_COMM_WORLD);
        CHECK(found > 0);
        CHECK(found < grid.cells()->n_points());
      }
}


TEST_CASE("places are quiet for several fields where they are quiet for each", "[fields][mpi]")
{
  const MacGrid<2> grid(
    MPI_COMM_WORLD, {{{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {0, 1, 2, 3, 4, 5, 6}}}, {});
  const GridIndex<2>    reach = all_directions<2>(1);
  std::vector<Field<2>> fields(2, Field<2>(grid.cells()));
  for_each(fields[0].owned(), [&](const auto &index) {
    fields[0](index) = index[0] < 2;        // at the left
    fields[1](index) = 3. * (index[0] > 7); // at the right
  });
  for (auto &field : fields)
    field.exchange(reach);
  const UniformRegions<2> left({fields[0]}, reach, .1), right({fields[1]}, reach, .1);
  const UniformRegions<2> both(fields, reach, .1);
  unsigned int            wrong = 0, by_one = 0;
  for_each(fields[0].owned(), [&](const auto &index) {
    wrong += both.contains(index) != (left.contains(index) && right.contains(index));
    by_one += left.contains(index) != right.contains(index);
  });
  CHECK(wrong == 0);
  CHECK(dealii::Utilities::MPI::sum(by_one, MPI_COMM_WORLD) > 20);
}
