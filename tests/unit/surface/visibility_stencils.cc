// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/visibility_stencils.h>

#include <catch2/catch.hpp>
#include <surface/ball_and_sheet.h>

using namespace undine_tests;

namespace
{
  /// Random values at all points and parts, on what bodies left before they moved.
  template <int dim>
  Field<dim>
  random_field(const BallAndSheet<dim>                   &scene,
               const std::shared_ptr<const Lattice<dim>> &lattice,
               Random                                    &random)
  {
    Field<dim> field(lattice, scene.before.parts.open);
    for_each(field.owned(),
             [&](const GridIndex<dim> &index) { field(index) = random.between(-1, 1); });
    for (double &value : field.parts())
      value = random.between(-1, 1);
    field.exchange(scene.width);
    return field;
  }


  /// What there is to compare, over all ranks.
  struct Counts
  {
    int compared   = 0; ///< corners of which something is seen, or could be
    int hidden     = 0; ///< of which nothing is seen
    int clear      = 0; ///< cubes of which all is seen
    int wrong      = 0; ///< means of other samples than those that can be seen
    int overlooked = 0; ///< some of which could be seen and are not
  };


  /// The mean over a point's samples, or the nearest one, that no facet hides from the eye.
  template <int dim>
  std::optional<double>
  by_brute_force(const SampledPoints<dim>                       &points,
                 const typename VisibilityStencils<dim>::Values &values,
                 const SurfaceQueries<dim>                      &queries,
                 const GridIndex<dim>                           &index,
                 const dealii::Point<dim>                       &query,
                 const bool                                      only_nearest)
  {
    double sum = 0, total = 0, nearest = 1e10;
    points.for_each_sample(index, [&](const auto &sample) {
      const double distance = sample.place.point.distance(query);
      if (queries.first_hit(query, sample.place.point) <= 1 ||
          (only_nearest && distance >= nearest))
        return;
      if (only_nearest)
        sum = total = 0;
      nearest = distance;
      sum += sample.measure * values[sample.number];
      total += sample.measure;
    });
    return total > 0 ? std::optional<double>(sum / total) : std::nullopt;
  }


  template <int dim>
  bool
  knows_cube(const SampledPoints<dim> &points, const GridIndex<dim> &lower)
  {
    auto upper = lower;
    for (int &index : upper.values)
      ++index;
    return points.stored_points().contains(lower) && points.stored_points().contains(upper);
  }


  /// What is seen of a cube that is clear.
  template <int dim>
  typename VisibilityStencils<dim>::VisibilityStencil
  all_corners(const Field<dim> &field, const GridIndex<dim> &lower)
  {
    typename VisibilityStencils<dim>::VisibilityStencil stencil{
      {}, (1u << VisibilityStencils<dim>::n_corners) - 1};
    for (unsigned int corner = 0; corner < VisibilityStencils<dim>::n_corners; ++corner)
      {
        auto index = lower;
        for (unsigned int d = 0; d < dim; ++d)
          index[d] += (corner >> d) & 1;
        stencil.values[corner] = field(index);
      }
    return stencil;
  }


  template <int dim>
  void
  compare(const BallAndSheet<dim> &scene,
          const Field<dim>        &field,
          VisibilityStencils<dim> &cubes,
          Counts                  &counts)
  {
    const auto &lattice = field.lattice();
    const auto &points  = cubes.points();
    const auto  values  = points.values(field);
    Random      random(5 + scene.rank());
    for (int number = 0; number < 6000; ++number)
      {
        const bool at_speck = number % 10 == 0;
        const auto query = at_speck ? scene.place_at_speck(random) : scene.known_place(random, 1);
        GridIndex<dim> lower;
        for (unsigned int d = 0; d < dim; ++d)
          lower[d] = lattice.row(d).locate(query[d]).lower;
        if (!knows_cube(points, lower))
          continue;
        const auto own     = points.inside(lower);
        const bool has_own = number % 2 == 0;
        const auto corners =
          number % 3 == 0 ? 1u + random.below(VisibilityStencils<dim>::n_corners - 1) : -1u;
        const bool is_clear = cubes.is_clear(lower, query);
        const auto found =
          is_clear ? std::optional(all_corners(field, lower))
                   : cubes.stencil(values, lower, query, corners, has_own ? &own : nullptr);
        counts.clear += is_clear;
        for (unsigned int corner = 0; found && corner < VisibilityStencils<dim>::n_corners;
             ++corner)
          {
            auto index = lower;
            for (unsigned int d = 0; d < dim; ++d)
              index[d] += (corner >> d) & 1;
            const bool is_own = has_own && points.inside(index) == own;
            const auto exact  = by_brute_force(points, values, scene.queries, index, query, is_own);
            const bool seen   = found->corners >> corner & 1;
            if (!(corners >> corner & 1))
              {
                counts.wrong += seen && !is_clear;
                continue;
              }
            ++counts.compared;
            counts.hidden += !seen;
            counts.overlooked += exact && !seen;
            counts.wrong += seen && (!exact || std::abs(*exact - found->values[corner]) > 1e-12);
          }
      }
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("Views of cubes are those past all facets, one by one",
                       "[interface][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const bool periodic : {false, true})
    {
      INFO("periodic: " << periodic);
      const BallAndSheet<dim> scene(periodic_axes<dim>(periodic));
      Counts                  counts;
      for (unsigned int axis = 0; axis <= dim; ++axis)
        {
          const auto lattice = axis < dim ? scene.grid().faces(axis) : scene.grid().cells();
          Random     random(1);
          const auto field = random_field(scene, lattice, random);
          VisibilityStencils<dim> cubes(field, scene.width, scene.queries, scene.vicinity);
          compare(scene, field, cubes, counts);
          // The same cubes serve other fields.
          compare(scene, random_field(scene, lattice, random), cubes, counts);
        }
      CHECK(counts.wrong == 0);
      // What could be seen past a rim just outside the cells around may be.
      CHECK(counts.overlooked <= counts.hidden / 1000);
      CHECK(dealii::Utilities::MPI::sum(counts.compared, MPI_COMM_WORLD) > 1000);
      CHECK(dealii::Utilities::MPI::sum(counts.hidden, MPI_COMM_WORLD) > 300);
      CHECK(dealii::Utilities::MPI::sum(counts.clear, MPI_COMM_WORLD) > 1000);
    }
}
