// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/short_waves.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace undine
{
  namespace
  {
    /// Of one component of a flow, in one direction.
    template <int dim>
    class ShortWaves
    {
    public:
      ShortWaves(const FluidModel<dim> &model,
                 const Velocity<dim>   &flow,
                 const unsigned int     axis,
                 const unsigned int     direction)
        : flow(flow)
        , component(flow[axis])
        , lattice(component.lattice())
        , direction(direction)
        , first(lattice.owned().lower[direction] - 1)
        , stride_of_weights(direction == 0 ? 1 : 0)
      {
        set_weights(model.grid());
      }

      /// In the places `box`, with two fields on the places of the component for what is between.
      void
      damp(const double         dt,
           const IndexBox<dim> &box,
           Field<dim>          &velocity,
           Field<dim>          &differences,
           Field<dim>          &fluxes) const
      {
        if (lattice.row(direction).size() < 3)
          return;
        set_differences(differences);
        differences.exchange(1);
        set_fluxes(differences, dt, fluxes);
        fluxes.exchange(1);
        for (const int shift : {-1, 0, 1})
          for_each_row(having_difference(box, shift),
                       [&](const GridIndex<dim> &begin, const int n) {
                         const double *flux   = fluxes.data(moved<dim>(begin, direction, shift));
                         const double *weight = at(changes[shift + 1], begin);
                         double       *v      = velocity.data(begin);
                         for (int i = 0; i < n; ++i)
                           v[i] += weight[stride_of_weights * i] * flux[i];
                       });
      }

    private:
      void
      set_weights(const MacGrid<dim> &grid)
      {
        const auto &row   = lattice.row(direction);
        const int   last  = lattice.owned().upper[direction];
        const auto  width = [&](const int i) {
          return direction == lattice.normal_axis() ? grid.dual_width(direction, i)
                                                     : grid.cell_width(direction, i);
        };
        for (int i = first; i <= last; ++i)
          {
            const bool   has_one  = row.periodic() || (i > 0 && i < row.size() - 1);
            const bool   is_point = row.periodic() || (i >= 0 && i < row.size());
            const double up       = has_one ? row.position(i + 1) - row.position(i) : 1;
            const double down     = has_one ? row.position(i) - row.position(i - 1) : 1;
            above.push_back(has_one ? 2 * down / (up + down) : 0);
            below.push_back(has_one ? 2 * up / (up + down) : 0);
            widths.push_back(is_point ? width(i) : 1);
          }
        for (std::size_t k = 0; k < widths.size(); ++k)
          {
            changes[0].push_back(k > 0 ? -above[k - 1] / widths[k] : 0);
            changes[1].push_back((above[k] + below[k]) / widths[k]);
            changes[2].push_back(k + 1 < widths.size() ? -below[k + 1] / widths[k] : 0);
          }
      }

      /// The weights of the places of a row that begins at `begin`.
      const double *
      at(const std::vector<double> &weights, const GridIndex<dim> &begin) const
      {
        return weights.data() + (begin[direction] - first);
      }

      /// The places of a box that have a second difference `shift` places further on.
      IndexBox<dim>
      having_difference(IndexBox<dim> box, const int shift = 0) const
      {
        const auto &row = lattice.row(direction);
        if (!row.periodic())
          {
            box.lower[direction] = std::max(box.lower[direction], 1 - shift);
            box.upper[direction] = std::min(box.upper[direction], row.size() - 1 - shift);
          }
        return box;
      }

      /// D_f [m/s]; not a number where there is none.
      void
      set_differences(Field<dim> &result) const
      {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        for (const int end : {0, lattice.row(direction).size() - 1})
          {
            auto layer             = lattice.owned();
            layer.lower[direction] = std::max(layer.lower[direction], end);
            layer.upper[direction] = std::min(layer.upper[direction], end + 1);
            for_each(layer, [&](const GridIndex<dim> &place) { result(place) = none; });
          }
        const auto next = component.stride(direction);
        for_each_row(having_difference(lattice.owned()),
                     [&](const GridIndex<dim> &begin, const int n) {
                       const double *v          = component.data(begin);
                       const double *to_above   = at(above, begin);
                       const double *from_below = at(below, begin);
                       double       *d          = result.data(begin);
                       for (int i = 0; i < n; ++i)
                         d[i] = to_above[stride_of_weights * i] * (v[i + next] - v[i]) -
                                from_below[stride_of_weights * i] * (v[i] - v[i - next]);
                     });
        if (const auto *divided = component.divided())
          for_each(having_difference(lattice.owned()), [&](const GridIndex<dim> &place) {
            for (const int shift : {-1, 0, 1})
              if (divided->kind(moved<dim>(place, direction, shift)) !=
                  SubLattice<dim>::Kind::whole)
                result(place) = none;
          });
      }

      /// The difference of w_m K_m T_m dt below and above each place, w_m being the width of the
      /// volume of a middle [m^2/s].
      void
      set_fluxes(const Field<dim> &differences, const double dt, Field<dim> &result) const
      {
        constexpr double    share = 1. / 60, most = 1. / (128 * dim);
        const auto          next = differences.stride(direction);
        std::vector<double> below(lattice.owned().upper[0] - lattice.owned().lower[0]);
        std::vector<double> above(below);
        const auto flux = [dt](const double third, const double speed, const double width) {
          const bool has_one = third == third;
          return has_one ? std::min(share * dt * speed, most * width) * third : 0.;
        };
        for_each_row(having_difference(lattice.owned()),
                     [&](const GridIndex<dim> &begin, const int n) {
                       set_speeds(begin, n, below);
                       set_speeds(moved<dim>(begin, direction, 1), n, above);
                       const double *d     = differences.data(begin);
                       const double *width = at(widths, begin);
                       double       *q     = result.data(begin);
                       for (int i = 0; i < n; ++i)
                         {
                           const double *w = width + stride_of_weights * i;
                           q[i] = flux(d[i] - d[i - next], below[i], (w[-1] + w[0]) / 2) -
                                  flux(d[i + next] - d[i], above[i], (w[0] + w[1]) / 2);
                         }
                     });
      }

      /// |u| in the direction, in the middles below the places of a row [m/s].
      void
      set_speeds(const GridIndex<dim> &begin, const int n, std::vector<double> &speeds) const
      {
        const auto   &along = flow[direction];
        const double *here  = along.data(begin);
        const double *other = along.data(moved<dim>(begin, lattice.normal_axis(), -1));
        for (int i = 0; i < n; ++i)
          speeds[i] = std::abs(here[i] + other[i]) / 2;
      }

      const Velocity<dim> &flow;
      const Field<dim>    &component;
      const Lattice<dim>  &lattice;
      const unsigned int   direction;
      const int            first;             ///< place of the first weight in the direction
      const int            stride_of_weights; ///< from a place of a row to the next one

      std::vector<double> above, below;           ///< D_f = above (v_f+ - v_f) - below (v_f - v_f-)
      std::vector<double> widths;                 ///< of volumes [m]
      std::array<std::vector<double>, 3> changes; ///< by the fluxes of g-, g and g+ [1/m]
    };
  } // namespace


  template <int dim>
  void
  damp_short_waves(const FluidModel<dim> &model,
                   const Velocity<dim>   &flow,
                   const double           dt,
                   Velocity<dim>         &velocity)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto inside = velocity[axis].owned();
        if (!model.grid().periodic(axis))
          {
            inside.lower[axis] = std::max(inside.lower[axis], 1);
            inside.upper[axis] = std::min(inside.upper[axis], model.grid().cells_along()[axis]);
          }
        Field<dim> differences(flow[axis].shared_lattice()), fluxes(flow[axis].shared_lattice());
        for (unsigned int direction = 0; direction < dim; ++direction)
          ShortWaves<dim>(model, flow, axis, direction)
            .damp(dt, inside, velocity[axis], differences, fluxes);
      }
  }


  template void
  damp_short_waves(const FluidModel<2> &, const Velocity<2> &, const double, Velocity<2> &);
  template void
  damp_short_waves(const FluidModel<3> &, const Velocity<3> &, const double, Velocity<3> &);
} // namespace undine
