// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/remap.h>
#include <undine/fluid/grid/cell_links.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/divergence.h>
#include <undine/fluid/scalars/scalar_flow.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// Of cells and components on a topology [m^dim].
    template <int dim>
    Field<dim>
    volumes_on(const MacGrid<dim> &grid, const std::shared_ptr<const FluidTopology<dim>> &topology)
    {
      Field<dim> result(grid.cells(), topology);
      set_volumes(result, grid);
      return result;
    }
  } // namespace


  template <int dim>
  ScalarFlow<dim>::ScalarFlow(const CharacteristicTracer<dim> &tracer, Projection<dim> &projection)
    : tracer(tracer)
    , flow(tracer.velocity())
  {
    const auto &grid   = model().grid();
    const auto &before = tracer.velocity()[0].topology();
    const auto  end    = volumes_on(grid, topology());
    begin_volumes      = end;
    if (before != topology())
      {
        transfer.emplace(grid, before, topology(), tracer.vicinity());
        begin_volumes = transfer->transfer(volumes_on(grid, before));
        for (unsigned int axis = 0; axis < dim; ++axis)
          flow[axis] = remapped(tracer, flow[axis], VelocityCondition<dim>(axis));
      }
    auto growth = end;
    add(growth, -1., begin_volumes);
    add(growth, 1 / duration() - 1, Field<dim>(growth));
    fit(projection, growth);
    outflow       = divergence(model(), flow);
    start_volumes = end;
    add(start_volumes, duration(), outflow);
    // Where the flow does not fit.
    for_each_value(start_volumes, [](double &volume, const auto &, const auto &) {
      volume = std::max(0., volume);
    });
  }


  /// To rounding, for what does not fit is not conserved: the flow itself is divergence-free but
  /// for a tolerance. What closed regions cannot take remains.
  template <int dim>
  void
  ScalarFlow<dim>::fit(Projection<dim> &projection, const Field<dim> &growth)
  {
    constexpr double rounding = 1e-13;
    const double     middle   = begin() + duration() / 2;
    double           last     = std::numeric_limits<double>::infinity();
    set_boundary_velocity(flow, model().boundaries(), middle);
    exchange(flow);
    while (true)
      {
        auto defect = divergence(model(), flow);
        add(defect, 1., growth);
        const double speed =
          largest_components(model(), flow).norm() + largest_divergence(model(), growth);
        const double size = largest_divergence(model(), defect);
        if (size <= rounding * speed || size > last / 2)
          return;
        last = size;
        n_iterations += projection.fit_to_growth(flow, growth, middle);
        exchange(flow);
      }
  }


  template <int dim>
  Field<dim>
  ScalarFlow<dim>::at_start(const Field<dim> &scalar) const
  {
    if (!transfer)
      return scalar;
    auto amounts = scalar;
    auto volumes = volumes_on(model().grid(), scalar.topology());
    for_each_cell_place(amounts, [&](const PressurePlace<dim> &place) {
      value_at(amounts, place) *= value_at(volumes, place);
    });
    auto result = transfer->transfer(amounts);
    for_each_cell_place(result, [&](const PressurePlace<dim> &place) {
      const double volume = value_at(begin_volumes, place);
      value_at(result, place) =
        volume > 0 ? value_at(result, place) / volume : std::numeric_limits<double>::quiet_NaN();
    });
    return result;
  }


  template <int dim>
  Field<dim>
  ScalarFlow<dim>::volumes(const double share) const
  {
    auto result = start_volumes;
    add(result, -share * duration(), outflow);
    return result;
  }


  template <int dim>
  std::size_t
  ScalarFlow<dim>::memory_consumption() const
  {
    return undine::memory_consumption(flow) + begin_volumes.memory_consumption() +
           start_volumes.memory_consumption() + outflow.memory_consumption();
  }


  template class ScalarFlow<2>;
  template class ScalarFlow<3>;
} // namespace undine
