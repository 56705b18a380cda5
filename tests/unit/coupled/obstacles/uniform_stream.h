// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_uniform_stream_h
#define undine_tests_uniform_stream_h

#include <coupled/obstacle_run.h>

namespace undine_tests
{
  /// A uniform stream through a domain of [0, 2] x [0, 1]^(dim - 1).
  template <int dim>
  struct UniformStream
  {
    dealii::Tensor<1, dim> velocity;
    double                 dt;
    std::string            boundaries  = "";
    std::string            more_domain = ""; ///< further keys

    UniformStream(const std::array<double, 3> &components, const double dt)
      : dt(dt)
    {
      for (unsigned int d = 0; d < dim; ++d)
        velocity[d] = components[d];
    }

    std::string
    vector(const std::string &factor = "1") const
    {
      std::string result;
      for (unsigned int d = 0; d < dim; ++d)
        result += fmt::format("{}{:.17g}*{}", d == 0 ? "" : "; ", velocity[d], factor);
      return result;
    }

    /// In at the lower sides, out at the upper ones.
    UniformStream
    through() const
    {
      auto result = *this;
      result.boundaries =
        boundary("in",
                 plane_or_space<dim>("left, bottom", "left, bottom, back"),
                 "inflow",
                 "set Velocity = " + vector()) +
        boundary("out", plane_or_space<dim>("right, top", "right, top, front"), "outflow");
      return result;
    }

    /// Out at these sides and in again at the opposite ones; the others are walls.
    UniformStream
    around(const std::string &sides) const
    {
      auto result       = *this;
      result.boundaries = boundary("round", sides, "periodic");
      return result;
    }

    /// Cells whose widths differ by up to a factor of three.
    UniformStream
    graded() const
    {
      auto result = *this;
      for (unsigned int d = 0; d < dim; ++d)
        result.more_domain +=
          fmt::format("set Grading {} = x + {}*sin(2*pi*x)\n", "xyz"[d], d == 0 ? .08 : -.07);
      return result;
    }

    /// One cell is 1/8 long, or so in the mean.
    std::string
    fluid() const
    {
      return section("Domain",
                     plane_or_space<dim>("set Upper corner = 2, 1\nset Cells = 16, 8\n",
                                         "set Upper corner = 2, 1, 1\nset Cells = 16, 8, 8\n") +
                       more_domain) +
             section("Fluid",
                     "set Density = 1000\nset Initial velocity = " + vector() + "\n" +
                       section("Boundaries", boundaries));
    }
  };


  /// A stream in which everything moves along stays what it is.
  template <int dim>
  void
  check_translation(const UniformStream<dim> &stream,
                    const std::string        &shape,
                    const std::string        &keys,
                    const std::string        &form = convection())
  {
    INFO(shape << " " << keys << ", in " << stream.vector() << ", " << stream.boundaries
               << stream.more_domain);
    ObstacleRun<dim> run(
      stream.fluid(),
      obstacle("thing", shape, keys + "\nset Displacement = " + stream.vector("t")),
      form + section("scalar transport",
                     section("smoke", "set Initial value = 1\nset Inflow value = 1")),
      stream.dt);
    const double speed = stream.velocity.norm();
    for (unsigned int n = 0; n < 12; ++n)
      {
        run.step();
        REQUIRE(run.column("Flagged cells") == 0);
        REQUIRE(largest_on_faces(run.state.fluid.velocity,
                                 [&](const double value, const auto &, const unsigned int axis) {
                                   return std::abs(value - stream.velocity[axis]);
                                 }) <= 1e-12 * speed);
        // The pressure that would stop the stream within one cell and step.
        REQUIRE(largest_in_cells(run.state.fluid.pressure, [](const double value, const auto &) {
                  return std::abs(value);
                }) <= 1e-12 * 1000 * speed / 8 / stream.dt);
        REQUIRE(run.column("Fluid divergence") <= 1e-12);
        REQUIRE(largest_in_cells(
                  run.state.fluid.scalars.at("smoke"),
                  [](const double value, const auto &) { return std::abs(value - 1); }) <= 1e-12);
      }
  }
} // namespace undine_tests

#endif
