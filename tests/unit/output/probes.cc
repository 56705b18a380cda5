// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/probe.h>

#include <catch2/catch.hpp>

#include "sample_scene.h"

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  text_of(const dealii::Point<dim> &point)
  {
    return write_value(static_cast<const dealii::Tensor<1, dim> &>(point));
  }


  /// A started probe "here" with the given keys.
  template <int dim>
  std::unique_ptr<Probe<dim>>
  started_probe(const SampleScene<dim> &scene, const std::string &kind, const std::string &keys)
  {
    const auto options =
      options_of("subsection Probes\n subsection here\n" + keys + "\n end\nend\n")
        .section("Probes")
        .section("here");
    auto probe = Registry<Probe<dim>>::instance().make(kind);
    probe->add_options(options);
    probe->start("here", options, scene.models);
    return probe;
  }


  double
  value(const Columns &columns, const std::string &name)
  {
    for (const auto &column : columns)
      if (column.name == name)
        return column.value;
    throw std::runtime_error("no column '" + name + "'");
  }


  template <int dim>
  std::vector<dealii::Point<dim>>
  places()
  {
    dealii::Point<dim> inside, corner, centre;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        inside[axis] = 0.37 + 0.2 * axis;
        corner[axis] = 1;
        centre[axis] = 0.5;
      }
    return {inside, corner, centre};
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("body point: exact for linear fields, inside and on the boundary",
                       "[probe][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  const auto             state = scene.linear_state();
  for (const auto &place : places<dim>())
    {
      const auto probe =
        started_probe(scene, "body point", "set Body = block\nset Point = " + text_of(place));
      const auto columns = probe->columns(scene.models, state);
      REQUIRE(columns.size() == 2 * dim);
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const std::string name(1, 'x' + axis);
          CHECK(value(columns, "here displacement " + name) ==
                Approx(linear_displacement(place)[axis]));
          CHECK(value(columns, "here velocity " + name) == Approx(linear_velocity(place)[axis]));
        }
    }
}


TEMPLATE_TEST_CASE_SIG(
  "fluid point: exact for linear fields", "[probe][mpi]", ((int dim), dim), 2, 3)
{
  const SampleScene<dim> scene(MPI_COMM_WORLD);
  const auto             state = scene.linear_state();
  for (const auto &place : places<dim>())
    {
      const auto columns = started_probe(scene, "fluid point", "set Point = " + text_of(place))
                             ->columns(scene.models, state);
      REQUIRE(columns.size() == dim + 1 + 2);
      CHECK(value(columns, "here pressure") == Approx(linear_scalar(place)));
      if (place[0] < 1)
        {
          CHECK(value(columns, "here smoke") == Approx(linear_scalar(place, 5)));
          CHECK(value(columns, "here velocity x") == Approx(linear_velocity(place)[0]));
        }
    }
}


TEST_CASE("probes that look at nothing are refused with section, key and what is allowed",
          "[probe][mpi]")
{
  const SampleScene<2> scene(MPI_COMM_WORLD);
  using Catch::Contains;
  CHECK_THROWS_WITH(started_probe(scene, "body point", "set Body = ball\nset Point = 0, 0"),
                    Contains("Probes/here") && Contains("'Body'") && Contains("block"));
  CHECK_THROWS_WITH(started_probe(scene, "body point", "set Body = block\nset Point = 1.1, 0"),
                    Contains("Probes/here") && Contains("'Point'"));
  CHECK_THROWS_WITH(started_probe(scene, "fluid point", "set Point = 0, -0.1"),
                    Contains("Probes/here") && Contains("'Point'") && Contains("outside"));
  CHECK_THROWS_AS(started_probe(scene, "body point", "set Body = block"), InputError);
}
