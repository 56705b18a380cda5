// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  constexpr double density = 700, radius = .3, step = .01;

  /// The pressure impulse of a cylinder or ball of speed 1 along x that starts in a fluid at rest,
  /// -rho phi (Lamb, Hydrodynamics, articles 68 and 92) [Pa s].
  template <int dim>
  double
  impulse(const dealii::Point<dim> &place)
  {
    return density * place[0] * std::pow(radius / place.norm(), dim) / (dim - 1);
  }


  /// Of the fluid around a body, rho times its added volume [kg].
  template <int dim>
  constexpr double added_mass =
    dim == 2 ? density *M_PI *radius *radius : 2. / 3 * M_PI *density *radius *radius *radius;


  struct Errors
  {
    double pressure; ///< root mean square over the surface, of the impulse
    double largest;  ///< at the surface
    double force;    ///< relative
  };


  /// A box of side 2 from `corner` on, on whose sides the exact pressure is given, and a ball at 0.
  template <int dim>
  Options
  scene(const unsigned int cells, const dealii::Point<dim> &corner)
  {
    const auto along_all = [](const std::string &separator, const auto &value) {
      std::string list;
      for (unsigned int d = 0; d < dim; ++d)
        list += (d == 0 ? "" : separator) + value(d);
      return list;
    };
    const auto number = [](const double value) { return fmt::format("{:.17g}", value); };
    const auto exact  = fmt::format(
      "{:.17g}*x/({})^({}/2)",
      density * std::pow(radius, dim) / (dim - 1) / step,
      along_all("+", [](const unsigned int d) { return std::string(1, "xyz"[d]) + "^2"; }),
      dim);
    const auto lower = along_all(", ", [&](const unsigned int d) { return number(corner[d]); });
    const auto upper = along_all(", ", [&](const unsigned int d) { return number(corner[d] + 2); });
    const auto count = along_all(", ", [&](const unsigned int) { return number(cells); });
    const auto zero  = along_all(", ", [&](const unsigned int) { return number(0); });
    return read_scene_text(
      section("Domain",
              "set Lower corner = " + lower + "\nset Upper corner = " + upper +
                "\nset Cells = " + count) +
      section(
        "Fluid",
        fmt::format("set Density = {}\n", density) +
          section("Boundaries",
                  boundary("far", every_side<dim>(), "pressure", "set Pressure = " + exact))) +
      section("Obstacles",
              obstacle("body",
                       "ball",
                       "set Centre = " + zero + "\nset Radius = " + number(radius) +
                         "\nset Refinements = " + (dim == 2 ? "8" : "4"))));
  }


  /// Of the pressure at the surface against the exact one.
  template <int dim>
  void
  measure_pressure(Errors &errors, const Field<dim> &pressure, const double spacing)
  {
    double n = 0;
    for_each_value(pressure, [&](const double p, const dealii::Point<dim> &place, const auto &) {
      if (place.norm() - radius > spacing / 2)
        return;
      const auto   at_surface = dealii::Point<dim>(radius / place.norm() * place);
      const double error      = p * step - impulse<dim>(at_surface);
      n += 1;
      errors.pressure += error * error;
      errors.largest = std::max(errors.largest, std::abs(error));
    });
    namespace mpi = dealii::Utilities::MPI;
    errors.pressure =
      std::sqrt(mpi::sum(errors.pressure, MPI_COMM_WORLD) / mpi::sum(n, MPI_COMM_WORLD)) /
      (density * radius);
    errors.largest = mpi::max(errors.largest, MPI_COMM_WORLD) / (density * radius);
  }


  /// The body starts with speed 1 along x.
  template <int dim>
  Errors
  start_impulsively(const unsigned int cells, const dealii::Point<dim> &corner)
  {
    const auto models   = make_models<dim>(scene<dim>(cells, corner));
    const auto nodes    = models.surface->positions({}, 0);
    auto       velocity = std::vector<dealii::Tensor<1, dim>>(nodes.size());
    for (auto &v : velocity)
      v[0] = 1;
    FluidGeometry<dim> geometry(models);
    geometry.place(nodes, nodes, velocity);
    auto            state = models.fluid->initial_state(geometry.bodies().topology);
    Projection<dim> projection(*models.fluid);
    projection.project(state, state.velocity, 0, step, geometry.swept_volume_flux(step));

    Errors errors{};
    measure_pressure(errors, state.pressure, 2. / cells);
    for (const auto &column : geometry.columns(state.pressure, {}, 0))
      if (column.name == "pressure force body x")
        errors.force = std::abs(column.value * step / added_mass<dim> + 1);
    return errors;
  }


  /// Mean over several places of the grid, which errors depend on.
  template <int dim>
  Errors
  mean_errors(const unsigned int cells)
  {
    Errors             mean{};
    constexpr unsigned n_places = dim == 2 ? 5 : 2;
    for (unsigned int place = 0; place < n_places; ++place)
      {
        dealii::Point<dim> corner;
        for (unsigned int d = 0; d < dim; ++d)
          corner[d] = -1 + .11 * std::sin(1. + 3 * place + 5 * d);
        const auto errors = start_impulsively<dim>(cells, corner);
        mean.pressure += errors.pressure / n_places;
        mean.largest += errors.largest / n_places;
        mean.force += errors.force / n_places;
      }
    return mean;
  }


  /// What a pressure has that is exact at the centres of cells and taken for that at the surface,
  /// as far as half a cell away: along the normal the impulse grows by rho times the body's normal
  /// velocity. The root mean square is that of distances which are spread evenly. The force is an
  /// integral of these errors, in which they cancel up to second order.
  template <int dim>
  void
  check_errors(const Errors &errors, const unsigned int cells)
  {
    const double h = 2. / cells / radius;
    CHECK(errors.pressure < h / std::sqrt(12. * dim));
    CHECK(errors.largest < 1.1 * h / 2);
    CHECK(errors.force < .7 * h * h);
  }


  template <int dim>
  void
  check_orders(const unsigned int coarse, const unsigned int fine)
  {
    const auto   on_coarse = mean_errors<dim>(coarse), on_fine = mean_errors<dim>(fine);
    const double ratio = std::log(double(fine) / coarse);
    const auto   order = [&](const double a, const double b) { return std::log(a / b) / ratio; };
    const double of_pressure = order(on_coarse.pressure, on_fine.pressure);
    const double of_largest  = order(on_coarse.largest, on_fine.largest);
    const double of_force    = order(on_coarse.force, on_fine.force);
    INFO(fmt::format("{}D, {} and {} cells: pressure {:.2e} {:.2e} order {:.2f}, largest {:.2e} "
                     "{:.2e} order {:.2f}, force {:.2e} {:.2e} order {:.2f}",
                     dim,
                     coarse,
                     fine,
                     on_coarse.pressure,
                     on_fine.pressure,
                     of_pressure,
                     on_coarse.largest,
                     on_fine.largest,
                     of_largest,
                     on_coarse.force,
                     on_fine.force,
                     of_force));
    check_errors<dim>(on_coarse, coarse);
    check_errors<dim>(on_fine, fine);
    CHECK(of_pressure > .8);
    CHECK(of_largest > .6);
    CHECK(of_force > .8);
  }
} // namespace


TEST_CASE("Potential flow about a cylinder and a ball converges to the exact one", "[coupled]")
{
  SECTION("2D")
  {
    check_orders<2>(20, 80);
  }
  SECTION("3D")
  {
    check_orders<3>(12, 36);
  }
}
