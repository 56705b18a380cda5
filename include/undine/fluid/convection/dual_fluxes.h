// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_convection_dual_fluxes_h
#define undine_fluid_convection_dual_fluxes_h

#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/model/fluid_model.h>

#include <boost/container/small_vector.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace undine
{
  /// The volume rates with which a flow leaves the dual volumes of the faces normal to one axis,
  /// which momentum along that axis is carried by (F13). A component c of the fluid, or a whole
  /// cell, shares its volume among the places f of its faces normal to the axis, in proportion to
  /// their areas, like DualVolumes: theta_f. With the flux F through every piece of a face
  ///
  ///  - the dual volumes of two components that meet in a piece of a face along the axis exchange
  ///    F in the shares theta of both, the lower places with the lower ones;
  ///  - within c the place f gets s_f F_f - theta_f sum_g s_g F_g, s = 1 above c and -1 below it,
  ///    from the others, which is what continuity asks for (F14).
  ///
  /// In whole cells these are the fluxes of Harlow and Welch (Phys. Fluids 8 (1965) 2182) in the
  /// form of Morinishi et al. (J. Comput. Phys. 143 (1998) 90): half of the sum of two fluxes.
  template <int dim>
  class DualFluxes
  {
  public:
    /// `flow`: the velocity that carries [m/s]; its topology is that of the fluid. The model must
    /// outlive this. Collective.
    DualFluxes(const FluidModel<dim> &model, const Velocity<dim> &flow, double time);

    /// As surfaces move (F15): the rates of dual volumes, and of components and cells [m^dim/s],
    /// which the flow must fit, and v^0 [m/s].
    struct Motion
    {
      DualHalves<dim> rates;
      Field<dim>      growth;
      Velocity<dim>   start;
    };
    /// `flow` has been made to fit the rates, `unfitted` is the flow before that [m/s].
    DualFluxes(const FluidModel<dim> &model,
               const Velocity<dim>   &flow,
               double                 time,
               const Motion          &motion,
               const Velocity<dim>   &unfitted);

    /// action(from, to, volume rate from `from` to `to` [m^dim/s]), each on one rank only, for the
    /// same places as long as the topology is the same. Places are owned, or next to owned ones.
    using Between =
      std::function<void(const FacePlace<dim> &, const FacePlace<dim> &, const double)>;
    void
    for_each_between(const unsigned int axis, const Between &action) const;

    /// The same volume rates where nothing is cut and nothing moves, from the faces normal to
    /// `axis` that follow `first` along the first direction to those next to them in `direction`.
    void
    rates_to_next(unsigned int          axis,
                  unsigned int          direction,
                  const GridIndex<dim> &first,
                  std::vector<double>  &rates) const;

    /// action(place, volume rate that enters it through a side of the domain [m^dim/s], velocity
    /// along the axis that it brings [m/s]) unless the place itself has a given velocity. What
    /// enters through an opening does so at right angles, as fast as the flow. (If it brought the
    /// velocity that it finds, convection would feed on itself there.) What only enters to fit the
    /// rates of dual volumes brings v^0.
    using Entering = std::function<void(const FacePlace<dim> &, const double, const double)>;
    void
    for_each_entering(const unsigned int axis, const Entering &action) const;

    /// action(place f, place g behind it, volume rate phi [m^dim/s]) where fluid that leaves
    /// through a side has the velocity along it that v_f and v_g lead to there: phi (v_f - v_g) is
    /// carried out besides (F13).
    using Extrapolated =
      std::function<void(const FacePlace<dim> &, const FacePlace<dim> &, const double)>;
    void
    for_each_extrapolated(unsigned int axis, const Extrapolated &action) const;

    /// action(place, volume rate with which fluid leaves it through a side of the domain
    /// [m^dim/s]), negative where fluid enters, whatever the side is.
    using Leaving = std::function<void(const FacePlace<dim> &, const double)>;
    void
    for_each_leaving(const unsigned int axis, const Leaving &action) const;

    /// v^0 if surfaces move [m/s], else nullptr.
    const Velocity<dim> *
    start() const
    {
      return motion ? &motion->start : nullptr;
    }

    /// The flow that carries before it was made to fit the rates of dual volumes, with a ghost
    /// layer [m/s].
    const Velocity<dim> &
    unfitted_flow() const
    {
      return motion ? unfitted : flow;
    }

    /// The topology of the fluid; nullptr: nothing is cut.
    const FluidTopology<dim> *
    topology() const
    {
      return flow.topology();
    }

  private:
    /// Of a component or a whole cell.
    struct Share
    {
      FacePlace<dim> place;
      unsigned int   end;   ///< 0: below it, 1: above
      double         share; ///< theta [1]
    };
    using Shares = boost::container::small_vector<Share, 4>;

    /// A whole cell, or a component by its number.
    struct CellPlace
    {
      GridIndex<dim> cell;
      int            component; ///< -1: the cell is whole
    };

    void
    set_widths();
    void
    collect_pieces();
    Shares
    shares(const CellPlace &place, unsigned int axis) const;
    double
    area(unsigned int axis, const FacePlace<dim> &place) const;
    double
    supply(unsigned int axis, const Share &of) const;
    double
    flux(unsigned int axis, const FacePlace<dim> &place) const;
    double
    entering_velocity(const Boundary<dim>  &boundary,
                      unsigned int          d,
                      const GridIndex<dim> &face,
                      unsigned int          axis) const;
    double
    genuine_share(unsigned int d, const FacePlace<dim> &place, double entering) const;
    bool
    is_whole(const GridIndex<dim> &cell, unsigned int axis) const;
    void
    within_whole_cell(const GridIndex<dim> &cell, unsigned int axis, const Between &action) const;
    void
    across_whole_face(const GridIndex<dim> &face,
                      unsigned int          d,
                      unsigned int          axis,
                      const Between        &action) const;
    void
    within(const Shares &shares, unsigned int axis, const Between &action) const;
    void
    across(const Shares &below, const Shares &above, double flux, const Between &action) const;

    template <class Action>
    void
    for_each_side(unsigned int axis, const Action &action) const;
    CellPlace
    beside(unsigned int axis, const FacePlace<dim> &place, unsigned int end) const;

    const FluidModel<dim> &model;
    const MacGrid<dim>    &grid;
    Velocity<dim>          flow;
    const double           time;
    /// Of cells in each direction, from the one before the first on [m]; 0: there is none.
    std::array<std::vector<double>, dim> widths;
    std::optional<Motion>                motion;   ///< none: nothing moves
    Velocity<dim>                        unfitted; ///< if anything moves
    /// Pieces of faces around each component, [axis][component][end].
    std::array<std::vector<std::array<std::vector<int>, 2>>, dim> pieces;
  };
} // namespace undine

#endif
